"""Atomic write of a test to the store, and replacement by a more complete copy."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import enum
import json
import math
from typing import Any, Sequence

from sqlalchemy import Connection, delete, insert, select, text, update
from sqlalchemy import Row as Known
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.exc import IntegrityError

from ..errors import OtherContents, StoreError
from ..intake.record import TestRecord
from ..intake.same_content import states_the_same
from ..intake.trials import Row
from ..model.base import Base
from ..model.subjects import Campaign, Car, Equipment, Key, TestEquipment
from ..model.tables import OF_A_TEST
from ..model.tests import File, Line, Measurement, Test, Trial, Verdict
from .continuing import Findings, stored_findings
from .database import Database
from .kept_files import KeptFiles

# Another program may enter the same test between the query and the insert; a retry then finds it.
_ATTEMPTS = 3


class Outcome(enum.Enum):
    """Result of adding a test."""

    ADDED = "added"
    EXTENDED = "extended"
    KNOWN = "known"


def add(database: Database, files: KeptFiles | None, record: TestRecord, campaign: str = "") -> Outcome:
    """Add a test. OtherContents if the store has other contents under its key, StoreAway if the store is unavailable.

    files: storage of contents, or None. campaign: empty leaves it unchanged.
    """
    # Store contents first: rows must not refer to missing contents. Contents left by a failure are reused by name.
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
    if _is_more(connection, known, record):
        _replace(connection, known.id, record, files, place)
        return Outcome.EXTENDED
    if place:
        connection.execute(update(Test).where(Test.id == known.id).values(**place))
    return Outcome.KNOWN


def _is_more(connection: Connection, known: Known[Any], record: TestRecord) -> bool:
    """Return True if the copy replaces the one in the store.

    Raises OtherContents if it is not a copy of the same test, or if the shorter copy has measurements that the longer
    one lacks.
    """
    reach, name = (known.entries, known.has_journal), f"The test {record.test['test_key']}"
    if record.test["entries"] == known.entries and not _is_same(connection, known, record):
        raise OtherContents(f"{name} is in the store with other contents; one of the two was changed. The store is as "
                            "it was.")
    there, here = stored_findings(connection, known.id), Findings(record.measurements, record.trials)
    if record.reach < reach:
        if not there.hold(here):
            raise OtherContents(f"{name} is in the store farther than in this copy, which has measurements that the "
                                "store lacks: the two went on apart, or one was changed. The store is as it was.")
        return False
    if not here.hold(there):
        raise OtherContents(f"{name} is in the store with measurements that this copy lacks: the two went on apart, "
                            "one was changed, or the journal of this one is missing. The store is as it was.")
    # An older version of this program may have assigned the same points to other lines or attempts.
    return record.reach > reach or here.trials != there.trials


def _is_same(connection: Connection, known: Known[Any], record: TestRecord) -> bool:
    """Return True if two copies with equal reach have equal contents; a digest also depends on the version."""
    if record.test["digest"] == known.digest:
        return True
    stored = connection.execute(select(Test.document).where(Test.id == known.id)).scalar_one()
    return states_the_same(record.own, stored)


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
        if not rows:
            continue
        entered = [{"test_id": number, **row} for row in rows]
        if _is_remote(connection):
            _insert_as_one_value(connection, table, entered)
        else:
            connection.execute(insert(table), entered)


def _insert_as_one_value(connection: Connection, table: type[Base], rows: Sequence[Row]) -> None:
    """Insert rows with the same columns as one JSON value.

    A server takes longer to parse a statement with thousands of values than to insert them.
    """
    quote, columns = connection.dialect.identifier_preparer.quote, table.__table__.c
    names = ", ".join(map(quote, rows[0]))
    kinds = ", ".join(f"{quote(name)} {columns[name].type.compile(connection.dialect)}" for name in rows[0])
    document = json.dumps([{name: _in_json(value) for name, value in row.items()} for row in rows])
    connection.execute(text(f"INSERT INTO {quote(table.__tablename__)} ({names}) SELECT {names} FROM "
                            f"json_to_recordset(CAST(:rows AS json)) AS entered({kinds})"), {"rows": document})


def _in_json(value: Any) -> Any:
    """Convert infinity to a text, which the database accepts; JSON has no infinity."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _is_remote(connection: Connection) -> bool:
    return connection.dialect.name == "postgresql"


def _number_of(connection: Connection, table: type[Base], values: Row) -> int:
    """Return the id of the row with these values, and insert it if necessary; concurrent programs insert one row."""
    columns: Any = table.__table__.c
    wanted = select(columns.id).where(*(columns[name] == value for name, value in values.items()))
    found = connection.execute(wanted).scalar()
    if found is None:
        dialect = postgresql if _is_remote(connection) else sqlite
        connection.execute(dialect.insert(table).values(**values).on_conflict_do_nothing())
        found = connection.execute(wanted).scalar_one()
    return int(found)
