"""Queries of the store: tests that match a search, and all data of one test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

from sqlalchemy import Connection, Select, func, literal, select

from mtr_operator.history.line_pairs import Side

from ..errors import StoreError
from ..intake.record import side_of
from ..model.subjects import Campaign, Car, Equipment, Key, TestEquipment
from ..model.tests import File, Line, Measurement, Test, Trial, Verdict
from .period import first_moment, next_moment
from .text_order import ByCodePoint, ordering

Row = dict[str, Any]
PAGE = 100
# Columns of a list of tests, in order; columns of other tables are added.
LISTED = ("id", "test_key", "started", "scenario", "done", "total", "invalid", "is_complete", "verdict", "operator",
          "place", "car_profile")
_CAR = func.trim(Car.model + literal(" ") + Car.vin).label("car")
_SPECIAL = str.maketrans({char: f"\\{char}" for char in "\\%_"})


@dataclass(frozen=True)
class Search:
    """Criteria of a search; an empty criterion matches all tests.

    Attributes:
        text: words that must all occur. car: model and VIN as listed; software: of the Car.
        since, until: years, months, days or moments, UTC; until is inclusive. limit: 0 for all.
    """

    text: str = ""
    scenario: str = ""
    car: str = ""
    software: str = ""
    key: str = ""
    verdict: str = ""
    campaign: str = ""
    place: str = ""
    since: str = ""
    until: str = ""
    limit: int = PAGE
    offset: int = 0


def find(connection: Connection, search: Search, further: Sequence[str] = ()) -> list[Row]:
    """Return matching tests, newest first; StoreError for an invalid period.

    further: additional columns of the table of tests.
    """
    columns = [getattr(Test, name) for name in (*LISTED, *further)]
    found = select(*columns, _CAR, Car.software.label("car_software"), Key.serial.label("key"),
                   Campaign.name.label("campaign"))
    newest_first = ByCodePoint(Test.started_utc).desc(), Test.id.desc()
    ordered = _fitting(found, search).order_by(*newest_first).offset(search.offset)
    rows = connection.execute(ordered.limit(search.limit) if search.limit else ordered)
    return [{**row, "campaign": row["campaign"] or ""} for row in rows.mappings()]


def count(connection: Connection, search: Search) -> int:
    """Return the number of matching tests on all pages."""
    return int(connection.execute(_fitting(select(func.count(Test.id)), search)).scalar_one())


def values_of(connection: Connection) -> dict[str, list[str]]:
    """Return the existing values of each search criterion, sorted."""
    wanted = {"scenario": Test.scenario, "car": _CAR, "software": Car.software, "key": Key.serial,
              "verdict": Test.verdict, "campaign": Campaign.name, "place": Test.place}
    found = {name: connection.execute(_joined(select(column).distinct())).scalars() for name, column in wanted.items()}
    return {name: sorted({value for value in values if value}) for name, values in found.items()}


def number_of(connection: Connection, word: str) -> int:
    """Return the number of a test given by its number or the beginning of its key; StoreError if it is not unique."""
    if word.isdecimal() and len(word) < 10:
        by_number = connection.execute(select(Test.id).where(Test.id == int(word))).scalar()
        if by_number is not None:
            return int(by_number)
    keys = select(Test.id).where(Test.test_key.startswith(word.translate(_SPECIAL), escape="\\")).limit(2)
    found = connection.execute(keys).scalars().all() if word else []
    if len(found) != 1:
        what = "no test" if not found else "more than one test"
        raise StoreError(f"{word or 'An empty name'} is {what} of the store; mtr-results list shows their numbers.")
    return int(found[0])


def number_by_key(connection: Connection, test_key: str) -> int | None:
    """Return the number of the test with this key; None if it is not in the store."""
    found = connection.execute(select(Test.id).where(Test.test_key == test_key)).scalar()
    return None if found is None else int(found)


def side(connection: Connection, number: int) -> Side:
    """Return a test as the application represents it; StoreError if there is none with this number."""
    document = connection.execute(select(Test.document).where(Test.id == number)).scalar()
    if document is None:
        raise StoreError(f"There is no test {number} in the store; mtr-results list shows their numbers.")
    return side_of(document)


def test_row(connection: Connection, number: int) -> Row:
    """Return the row of a test with its car, key, campaign and equipment."""
    columns = [column for column in Test.__table__.c if column.name not in ("document", "words")]
    wanted = _joined(select(*columns, Car.vin, Car.model, Car.software.label("car_software"),
                            Key.serial.label("key_serial"), Key.type.label("key_type"),
                            Campaign.name.label("campaign"))).where(Test.id == number)
    found = connection.execute(wanted).mappings().one_or_none()
    if found is None:
        raise StoreError(f"There is no test {number} in the store; mtr-results list shows their numbers.")
    equipment = connection.execute(select(Equipment.name, Equipment.serial, Equipment.calibrated, Equipment.valid_until)
                                   .join(TestEquipment, TestEquipment.equipment_id == Equipment.id)
                                   .where(TestEquipment.test_id == number)
                                   .order_by(*ordering((Equipment.name, Equipment.serial, Equipment.calibrated,
                                                        Equipment.valid_until))))
    return {**found, "campaign": found["campaign"] or "", "equipment": [dict(row) for row in equipment.mappings()]}


def parts(connection: Connection, number: int) -> dict[str, list[Row]]:
    """Return lines, measurements, trials, verdicts and files of a test, each in its order."""
    return {name: _rows(connection, table, number) for name, table in (
        ("lines", Line), ("measurements", Measurement), ("trials", Trial), ("verdicts", Verdict), ("files", File))}


def files(connection: Connection, number: int) -> dict[str, str]:
    """Return the check sum of each file of a test, by its name."""
    found = connection.execute(select(File.name, File.sha256).where(File.test_id == number))
    return {name: sha256 for name, sha256 in found}


def _rows(connection: Connection, table: Any, number: int) -> list[Row]:
    wanted = select(table.__table__).where(table.test_id == number).order_by(*ordering(table.__table__.primary_key))
    return [{name: value for name, value in row.items() if name != "test_id"}
            for row in connection.execute(wanted).mappings()]


def _joined(wanted: Select[Any]) -> Select[Any]:
    return (wanted.select_from(Test).join(Car, Test.car_id == Car.id).join(Key, Test.key_id == Key.id)
            .outerjoin(Campaign, Test.campaign_id == Campaign.id))


def _fitting(wanted: Select[Any], search: Search) -> Select[Any]:
    found = _joined(wanted)
    for column, value in ((Test.scenario, search.scenario), (_CAR, search.car), (Car.software, search.software),
                          (Key.serial, search.key), (Test.verdict, search.verdict), (Campaign.name, search.campaign),
                          (Test.place, search.place)):
        if value:
            found = found.where(column == value)
    for word in _words(search.text):
        found = found.where(Test.words.like(f"%{word}%", escape="\\"))
    started = ByCodePoint(Test.started_utc)
    if search.since:
        found = found.where(started >= first_moment("since", search.since))
    if search.until:
        # A test without a known start does not belong to any period.
        found = found.where(started < next_moment("until", search.until), Test.started_utc != "")
    return found


def _words(text: str) -> Sequence[str]:
    return [word.translate(_SPECIAL) for word in text.lower().split()]
