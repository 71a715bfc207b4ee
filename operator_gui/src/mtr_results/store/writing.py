"""A test into the store: whole or not at all, once, and again only when more of it is known."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import enum
import functools
from typing import Any, Sequence

from sqlalchemy import Connection, Dialect, bindparam, delete, insert, select, update
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.exc import IntegrityError

from ..errors import OtherContents, StoreError
from ..intake.record import TestRecord
from ..intake.trials import Row
from ..model.base import Base
from ..model.subjects import Campaign, Car, Equipment, Key, TestEquipment
from ..model.tables import OF_A_TEST
from ..model.tests import File, Line, Measurement, Test, Trial, Verdict
from .database import Database
from .kept_files import KeptFiles

# Another program may enter the same test between the look and the entry; then it is there.
_ATTEMPTS = 3
# Rows of one statement: databases take some ten thousand values at once.
_ROWS = 500


class Outcome(enum.Enum):
    """What became of a test that was to go in."""

    ADDED = "added"
    EXTENDED = "extended"
    KNOWN = "known"


def add(database: Database, files: KeptFiles | None, record: TestRecord, campaign: str = "") -> Outcome:
    """Enter a test. OtherContents when something else is there under its name, StoreAway when it has to wait.

    files: where contents are kept, None for nowhere. campaign: empty leaves it as it is.
    """
    # Contents first: a row must not name what is not there. What a failure leaves behind is found again by its name.
    kept = [] if files is None else files.keep(record.files)
    for _ in range(_ATTEMPTS):
        try:
            with database.writing() as connection:
                return _add(connection, record, kept, campaign)
        except IntegrityError:
            continue
    raise StoreError(f"The test {record.test['test_key']} cannot be entered: it contradicts what is there.")


def _add(connection: Connection, record: TestRecord, files: Sequence[Row], campaign: str) -> Outcome:
    known = connection.execute(select(Test.id, Test.entries, Test.has_journal, Test.digest)
                               .where(Test.test_key == record.test["test_key"]).with_for_update()).one_or_none()
    place = {} if not campaign else {"campaign_id": _number_of(connection, Campaign, {"name": campaign})}
    if known is None:
        number = connection.execute(insert(Test).returning(Test.id),
                                    [{**_columns(connection, record), **place}]).scalar_one()
        _enter(connection, number, record, files)
        return Outcome.ADDED
    reach = (known.entries, known.has_journal)
    if record.test["entries"] == known.entries and record.test["digest"] != known.digest:
        raise OtherContents(f"The test {record.test['test_key']} is in the store with other contents; one of the "
                            "two was changed. The store is as it was.")
    if record.reach > reach:
        _replace(connection, known.id, record, files, place)
        return Outcome.EXTENDED
    if place:
        connection.execute(update(Test).where(Test.id == known.id).values(**place))
    return Outcome.KNOWN


def _replace(connection: Connection, number: int, record: TestRecord, files: Sequence[Row], place: Row) -> None:
    for table in OF_A_TEST:
        connection.execute(delete(table).where(table.__table__.c.test_id == number))
    connection.execute(update(Test).where(Test.id == number).values(**_columns(connection, record), **place))
    _enter(connection, number, record, files)


def _columns(connection: Connection, record: TestRecord) -> Row:
    now = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds")
    return {**record.test, "imported_utc": now, "car_id": _number_of(connection, Car, record.car),
            "key_id": _number_of(connection, Key, record.key)}


def _enter(connection: Connection, number: int, record: TestRecord, files: Sequence[Row]) -> None:
    instruments = {_number_of(connection, Equipment, row) for row in record.equipment}
    for table, rows in ((TestEquipment, [{"equipment_id": instrument} for instrument in instruments]),
                        (Line, record.lines), (Measurement, record.measurements), (Trial, record.trials),
                        (Verdict, record.verdicts), (File, files)):
        for start in range(0, len(rows), _ROWS):
            part = [{"test_id": number, **row} for row in rows[start:start + _ROWS]]
            if _is_remote(connection):
                # A server answers each statement: one with many rows is quicker there.
                _insert_at_once(connection, table, part)
            else:
                connection.execute(insert(table), part)


def _insert_at_once(connection: Connection, table: type[Base], rows: Sequence[Row]) -> None:
    """Rows with the same columns in few statements, whose texts are made once: SQLAlchemy keeps none of many rows."""
    start = 0
    while start < len(rows):
        # Powers of two, so that there are few texts.
        count = 1 << ((len(rows) - start).bit_length() - 1)
        text, order = _text_of(table, tuple(rows[start]), count, connection.dialect)
        values = {f"{name}_{index}": value for index, row in enumerate(rows[start:start + count])
                  for name, value in row.items()}
        connection.exec_driver_sql(text, tuple(values[name] for name in order))
        start += count


@functools.lru_cache(maxsize=256)
def _text_of(table: type[Base], columns: tuple[str, ...], count: int, dialect: Dialect) -> tuple[str, tuple[str, ...]]:
    """Statement for the driver, and the order of its values, each named COLUMN_ROW."""
    rows: list[Row] = [{name: bindparam(f"{name}_{index}") for name in columns} for index in range(count)]
    compiled: Any = insert(table).values(rows).compile(dialect=dialect)
    return str(compiled), tuple(compiled.positiontup)


def _is_remote(connection: Connection) -> bool:
    return connection.dialect.name == "postgresql"


def _number_of(connection: Connection, table: type[Base], values: Row) -> int:
    """Of the row with these values, which is entered when it is not there; two programs at once enter one."""
    columns: Any = table.__table__.c
    wanted = select(columns.id).where(*(columns[name] == value for name, value in values.items()))
    found = connection.execute(wanted).scalar()
    if found is None:
        dialect = postgresql if _is_remote(connection) else sqlite
        connection.execute(dialect.insert(table).values(**values).on_conflict_do_nothing())
        found = connection.execute(wanted).scalar_one()
    return int(found)
