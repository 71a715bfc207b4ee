"""A test and its measurements, in SI units and the Car coordinate system; angles as in results.csv."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Optional

from sqlalchemy import ForeignKey, ForeignKeyConstraint, LargeBinary
from sqlalchemy.orm import Mapped, deferred, mapped_column

from .base import Base

# On Python 3.9, the mapping evaluates annotations at run time, which does not support X | None.
Number = Optional[float]
Reference = Optional[int]
# A table stored in the order of its key requires half the space.
DENSE = {"sqlite_with_rowid": False}


class Test(Base):
    """One test, as far as it was measured at the time of the import.

    Attributes:
        test_key: identical in each copy of the test. entries, has_journal: reach of the imported copy.
        digest: SHA-256 of the measurements; it detects other contents under the same key.
        started: as in the record; started_utc: ISO, in UTC, for sorting and searching.
        done, total, invalid: numbers of lines. verdict: of the test, empty without limits.
        words: lower-case text for the search.
        document: progress document as compressed JSON, so that no recorded data is lost, whatever the tables hold.
    """

    # Without this, pytest would collect the class because of its name.
    __test__ = False
    __tablename__ = "test"
    id: Mapped[int] = mapped_column(primary_key=True)
    test_key: Mapped[str] = mapped_column(unique=True)
    entries: Mapped[int]
    has_journal: Mapped[bool]
    digest: Mapped[str]
    campaign_id: Mapped[Reference] = mapped_column(ForeignKey("campaign.id"), index=True)
    car_id: Mapped[int] = mapped_column(ForeignKey("car.id"), index=True)
    key_id: Mapped[int] = mapped_column(ForeignKey("key.id"), index=True)
    scenario: Mapped[str] = mapped_column(index=True)
    started: Mapped[str]
    started_utc: Mapped[str] = mapped_column(index=True)
    imported_utc: Mapped[str]
    operator: Mapped[str]
    place: Mapped[str]
    weather: Mapped[str]
    notes: Mapped[str]
    key_battery_v: Mapped[Number]
    car_profile: Mapped[str]
    robot: Mapped[str]
    software: Mapped[str]
    robot_software: Mapped[str]
    car_length_m: Mapped[Number]
    car_width_m: Mapped[Number]
    done: Mapped[int]
    total: Mapped[int]
    invalid: Mapped[int]
    is_complete: Mapped[bool]
    verdict: Mapped[str] = mapped_column(index=True)
    words: Mapped[str]
    document: Mapped[bytes] = deferred(mapped_column(LargeBinary, nullable=False))


class Line(Base):
    """Geometry and result of one line. height_m: of the key, if the line has its own height."""

    __tablename__ = "line"
    __table_args__ = DENSE
    test_id: Mapped[int] = mapped_column(ForeignKey("test.id", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    place: Mapped[str]
    origin_x_m: Mapped[float]
    origin_y_m: Mapped[float]
    direction_x: Mapped[float]
    direction_y: Mapped[float]
    height_m: Mapped[Number]
    reason: Mapped[str]
    holes_m: Mapped[str]


class Measurement(Base):
    """One distance of a line in one revision of its result; is_current marks the valid one.

    Attributes:
        revision: from 1, in the order of the results of the line: first an attempt, then its revision by the joint
            evaluation of all lines.
        kind, first_m, second_m: reported value, see Figure. low_m, high_m: 95 % interval of the boundary with all
            errors, NULL for an open end; has_interval: the method provides one.
        own_sigma_m, common_sigma_m, expanded_m: uncertainty budget, for the current distance only.
        coverage: share of a zone's area in which at least half of the attempts succeed, with its 95 % interval.
    """

    __tablename__ = "measurement"
    __table_args__ = (ForeignKeyConstraint(["test_id", "line"], ["line.test_id", "line.number"], ondelete="CASCADE"),
                      DENSE)
    test_id: Mapped[int] = mapped_column(primary_key=True)
    line: Mapped[int] = mapped_column(primary_key=True)
    word: Mapped[str] = mapped_column(primary_key=True)
    revision: Mapped[int] = mapped_column(primary_key=True)
    is_current: Mapped[bool]
    status: Mapped[str]
    kind: Mapped[str]
    first_m: Mapped[Number]
    second_m: Mapped[Number]
    sigma_m: Mapped[Number]
    has_interval: Mapped[bool]
    low_m: Mapped[Number]
    high_m: Mapped[Number]
    own_sigma_m: Mapped[Number]
    common_sigma_m: Mapped[Number]
    expanded_m: Mapped[Number]
    coverage: Mapped[Number]
    coverage_low: Mapped[Number]
    coverage_high: Mapped[Number]


class Trial(Base):
    """One point (a press, a pass or a request), in the order of the test; all points are stored.

    Attributes:
        attempt: number of the attempt on the line. status: ok if the Car reacted. x_m, y_m: position of the key, if
        only
            the position is recorded. cause: reason of the reaction, as reported by the Car.
    """

    __tablename__ = "trial"
    __table_args__ = (ForeignKeyConstraint(["test_id", "line"], ["line.test_id", "line.number"], ondelete="CASCADE"),
                      DENSE)
    test_id: Mapped[int] = mapped_column(primary_key=True)
    line: Mapped[int] = mapped_column(primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True)
    attempt: Mapped[int]
    word: Mapped[str]
    status: Mapped[str]
    distance_m: Mapped[Number]
    sigma_m: Mapped[Number]
    x_m: Mapped[Number]
    y_m: Mapped[Number]
    height_m: Mapped[Number]
    speed_mps: Mapped[Number]
    robot_time_s: Mapped[Number]
    cause: Mapped[str]


class Verdict(Base):
    """Verdict of a limit on a line; line is 0 for the whole test."""

    __tablename__ = "verdict"
    __table_args__ = DENSE
    test_id: Mapped[int] = mapped_column(ForeignKey("test.id", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    line: Mapped[int]
    requirement: Mapped[str]
    verdict: Mapped[str]
    reason: Mapped[str]


class File(Base):
    """A file of a test; its content is stored in the file folder of the store, under its check sum."""

    __tablename__ = "file"
    __table_args__ = DENSE
    test_id: Mapped[int] = mapped_column(ForeignKey("test.id", ondelete="CASCADE"), primary_key=True)
    name: Mapped[str] = mapped_column(primary_key=True)
    sha256: Mapped[str]
    size: Mapped[int]
