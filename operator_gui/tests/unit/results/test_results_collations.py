"""Comparison of times and texts is identical on every database and for every collation."""
# SPDX-License-Identifier: Apache-2.0
import itertools

import measured
import pytest
import sqlalchemy

from mtr_operator.domain.identity.identity import Equipment, Identity
from mtr_operator.domain.results.session_record import in_utc
from mtr_results.cli import main
from mtr_results.errors import StoreError
from mtr_results.store import reading
from mtr_results.store.database import engine_of
from mtr_results.store.period import first_moment, next_moment
from mtr_results.store.place import Place
from mtr_results.store.reading import Search

NUMBERS = itertools.count(1)
# Collations of the server: the two most common ones, and one that sorts digits by their value.
COLLATIONS = {"C": "", "en-US": "LOCALE_PROVIDER icu ICU_LOCALE 'en-US' TEMPLATE template0",
              "cs-CZ": "LOCALE_PROVIDER icu ICU_LOCALE 'cs-CZ' TEMPLATE template0",
              "numeric": "LOCALE_PROVIDER icu ICU_LOCALE 'en-US-u-kn-true' TEMPLATE template0"}


@pytest.fixture(params=["sqlite", *COLLATIONS])
def collated(request, place, tmp_path):
    """Return a store in a database with the collation."""
    if request.param == "sqlite":
        return place
    server, name = request.getfixturevalue("server"), f"collated{next(NUMBERS)}"
    engine = engine_of(server.format("postgres"))
    with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        connection.execute(sqlalchemy.text(f"CREATE DATABASE {name} {COLLATIONS[request.param]}"))
    engine.dispose()
    return Place(server.format(name), tmp_path / "files", tmp_path / "spool")


def test_periods_and_orders_are_the_same(collated, tmp_path):
    started = ("2026-11-01T00:00:00+00:00", "2026-11-01T23:59:59+00:00", "2026-11-02T00:00:00+00:00",
               "2026-10-31T23:30:00-01:00", "2025-12-31T23:59:59+00:00")
    names = ("a10", "A2", "a-1", "\u010dr", "_x", "b", "B")
    door = collated.door()
    for number, moment in enumerate(started, start=1):
        who = Identity(equipment=tuple(Equipment(name) for name in names))
        assert door.take(measured.in_folder(tmp_path / str(number), 5.0, mark=f"m{number}", started=moment,
                                            identity=who)).outcome == "added"
    with collated.open().reading() as connection:
        def found(**wanted):
            return [row["id"] for row in reading.find(connection, Search(**wanted))]
        assert found() == [3, 2, 4, 1, 5]
        assert found(since="2026-11-01", until="2026-11-01") == [2, 4, 1]
        assert found(until="2026-11-01T00:30") == [4, 1, 5] and found(until="2026-11-01T00:29") == [1, 5]
        assert found(since="2026-11-02") == [3] == found(since="2026-11-02T00:00:00Z")
        assert found(until="2026-11") == [3, 2, 4, 1, 5] and found(until="2025") == [5] == found(since="2025-12",
                                                                                                until="2025-12")
        assert found(since="2026-11-01T01:00+01:00") == [3, 2, 4, 1]
        assert [row["name"] for row in reading.test_row(connection, 1)["equipment"]] == sorted(names)


@pytest.mark.parametrize("text", ["yesterday", "2026-13-45", "2026-02-30", "0000", "9999", "2026-1-1",
                                  "2026-11-01T25:00", "2026-11-01T10", "x' OR 1=1 --", "~", "\u0662\u0660\u0662\u0666",
                                  "2026-11-01T00:00+99:00", 10 ** 5 * "9", "a\0b"])
def test_period_that_is_none_is_refused(place, capsys, text):
    with pytest.raises(StoreError, match="allowed is a day such as 2026-11-22"):
        first_moment("since", text)
    if "\0" in text or len(text) > 1000:
        return
    place.open().close()
    for name in ("--since", "--until"):
        assert main(["list", name, text, "--store", place.address]) == 2
        assert f"{name[2:]} is " in capsys.readouterr().err


@pytest.mark.parametrize("text, first, after", [
    ("2026", "2026-01-01T00:00:00", "2027-01-01T00:00:00"), ("2026-12", "2026-12-01T00:00:00", "2027-01-01T00:00:00"),
    ("2026-02-28", "2026-02-28T00:00:00", "2026-03-01T00:00:00"),
    ("2026-11-22 15:36", "2026-11-22T15:36:00", "2026-11-22T15:37:00"),
    ("2026-11-22T15:36:59", "2026-11-22T15:36:59", "2026-11-22T15:37:00"),
    ("2026-11-22T15:36:59.5Z", "2026-11-22T15:36:59", "2026-11-22T15:37:00"),
    ("2026-11-22T00:10-02:00", "2026-11-22T02:10:00", "2026-11-22T02:11:00")])
def test_period_counts_whole_and_in_utc(text, first, after):
    assert (first_moment("since", text), next_moment("until", text)) == (first, after)


@pytest.mark.parametrize("moment, utc", [
    ("2026-10-25T02:30:00+02:00", "2026-10-25T00:30:00+00:00"), ("2026-10-25T02:30:00", "2026-10-25T02:30:00+00:00"),
    ("2026-10-25T02:30:00Z", "2026-10-25T02:30:00+00:00"), ("0001-01-01T00:00:00+23:59", ""), ("today", ""), ("", ""),
    ("9999-12-31T23:59:59-12:00", "")])
def test_start_is_the_same_moment_on_every_computer(monkeypatch, moment, utc):
    for zone in ("Europe/Prague", "America/New_York"):
        monkeypatch.setenv("TZ", zone)
        assert in_utc(moment) == utc
