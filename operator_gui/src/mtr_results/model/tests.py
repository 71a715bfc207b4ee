"""A test and what it measured, in SI units and the Car coordinate system, angles as in results.csv."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Optional

from sqlalchemy import ForeignKey, ForeignKeyConstraint, LargeBinary
from sqlalchemy.orm import Mapped, deferred, mapped_column

from .base import Base

# On Python 3.9 the mapping reads its annotations when it is made: X | None is not understood there.
Number = Optional[float]
Reference = Optional[int]
# A table whose rows lie in the order of their key takes half the room.
DENSE = {"sqlite_with_rowid": False}


class Test(Base):
    """One test, as far as it was measured when it was imported.

    Attributes:
        test_key: the same in each copy of the test. entries, has_journal: how far the imported copy reaches.
        digest: SHA-256 of what was measured, by which another content under the same key is noticed.
        started: as in the record; started_utc: ISO, in UTC, by which tests are ordered and searched.
        done, total, invalid: lines. verdict: word of the test's verdict, empty without limits.
        words: all that a search looks at, in small letters.
        document: the progress document as compressed JSON: nothing that was recorded is lost, whatever the tables hold.
    """

    # The name would make pytest collect it.
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
    """One line: where it lies, and what became of it. height_m: of the key on a line that has one of its own."""

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
    """One distance of a line as one attempt measured it; is_current marks the one that counts.

    Attributes:
        revision: from 1, in the order in which the results of the line came: an attempt, then what all lines together
            made of it.
        kind, first_m, second_m: what may be said of it, see Figure. low_m, high_m: 95 % interval of the boundary with
            all its errors, NULL where an end is open; has_interval: the method gives one.
        own_sigma_m, common_sigma_m, expanded_m: of the budget, of what counts alone.
        coverage: part of a zone's area where at least half of the attempts work, with its 95 % interval.
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
    """One point: a press, a pass or a request, in the order in which they were made; none is left out.

    Attributes:
        attempt: how often the line had been begun. status: ok when the Car reacted. x_m, y_m: where the key was, where
            only that is recorded. cause: what the Car says made it react.
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
    """What a limit says of a line; line is 0 for the whole test."""

    __tablename__ = "verdict"
    __table_args__ = DENSE
    test_id: Mapped[int] = mapped_column(ForeignKey("test.id", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    line: Mapped[int]
    requirement: Mapped[str]
    verdict: Mapped[str]
    reason: Mapped[str]


class File(Base):
    """A file of a test; its content lies in the store's folder of files under its check sum."""

    __tablename__ = "file"
    __table_args__ = DENSE
    test_id: Mapped[int] = mapped_column(ForeignKey("test.id", ondelete="CASCADE"), primary_key=True)
    name: Mapped[str] = mapped_column(primary_key=True)
    sha256: Mapped[str]
    size: Mapped[int]
