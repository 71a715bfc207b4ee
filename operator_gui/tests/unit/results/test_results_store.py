"""The store: each test once and complete, concurrent writers, and no loss while the store is unavailable."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import errno
import json
import os
import shutil
import sqlite3
import threading
import time
from types import SimpleNamespace

import measured
import pytest
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Engine, event, text
from sqlalchemy.exc import OperationalError

import mtr_results.migrations
from mtr_operator.domain.identity.identity import Equipment, Identity
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_operator.history.line_pairs import open_side
from mtr_results.cli import main
from mtr_results.errors import StoreAway, StoreError
from mtr_results.intake.record import read_record
from mtr_results.model.tables import EXPORTED, METADATA
from mtr_results.store import reading
from mtr_results.store.reading import Search
from mtr_results.store.sentences import told
from mtr_results.store.spool import Spool
from mtr_results.store.writing import Outcome, add

GOLF = Identity("WVW1", "Golf", "SW 7", key_serial="0042", operator="Nov\u00e1k", notes="Doors SHUT 100%",
                equipment=(Equipment("LiDAR", "S1"),))


def contents(database):
    """Return all rows without the times of import."""
    with database.reading() as connection:
        return {model.__tablename__: sorted(
            [str({name: value for name, value in row.items() if name != "imported_utc"})
             for row in connection.execute(model.__table__.select()).mappings()]) for model in EXPORTED}


def test_import_twice_is_import_once_and_the_test_comes_out_as_it_went_in(any_place, tmp_path):
    limits = limits_from({"limits": [{"what": "press", "at_least_m": 6.0}]})
    path = measured.in_folder(tmp_path / "one", 5.0, 5.5, 6.5, 7.0, identity=GOLF, limits=limits)
    door = any_place.door()
    assert door.take(path, "winter").outcome == "added"
    database = any_place.open()
    before = contents(database)
    assert door.take(path).outcome == "known" and contents(database) == before
    with database.reading() as connection:
        row, = reading.find(connection, Search())
        number, parts = row["id"], reading.parts(connection, row["id"])
        assert reading.side(connection, number).progress == open_side(path).progress
    assert (row["car"], row["car_software"], row["key"], row["verdict"], row["campaign"]) == (
        "Golf WVW1", "SW 7", "0042", "fail", "winter")
    assert [line["number"] for line in parts["lines"]] == [1, 2, 3, 4]
    assert [(trial["status"], trial["distance_m"]) for trial in parts["trials"] if trial["line"] == 1] == [
        ("ok", 3.0), ("ok", 3.5), ("ok", 4.9), ("not_reached", 5.4), ("not_reached", 5.8)]
    assert {row["verdict"] for row in parts["verdicts"]} >= {"fail"}
    kept = {file["name"]: any_place.kept_files().read(file["sha256"]) for file in parts["files"]}
    assert kept["results.csv"] == (path.parent / "results.csv").read_bytes() and len(kept) == 2


def test_every_point_of_every_attempt_is_kept(any_place, tmp_path):
    path = measured.journalled(tmp_path / "one", [5.0, 5.5], ends=False)
    any_place.door().take(path)
    with any_place.open().reading() as connection:
        first = reading.parts(connection, 1)
    assert [trial["attempt"] for trial in first["trials"]] == [1, 1, 1, 2, 2, 2]
    assert [(row["revision"], row["is_current"]) for row in first["measurements"]] == [(1, True)]
    assert any_place.door().take(measured.journalled(tmp_path / "one", [5.0, 5.5])).outcome == "extended"
    with any_place.open().reading() as connection:
        second = reading.parts(connection, 1)
    assert [trial["distance_m"] for trial in second["trials"]] == pytest.approx([3.0, 4.9, 5.4, 3.0, 5.4, 5.9])
    assert [(row["revision"], row["is_current"], row["first_m"]) for row in second["measurements"]] == [
        (1, False, 5.0), (2, True, 5.5)]


def test_points_of_a_line_that_has_no_result_yet_are_kept(place, tmp_path):
    assert place.door().take(measured.journalled(tmp_path / "one", [5.0], ends=False)).outcome == "added"
    with place.open().reading() as connection:
        parts = reading.parts(connection, 1)
    assert (len(parts["trials"]), len(parts["lines"]), len(parts["measurements"])) == (3, 1, 0)


def test_copy_without_its_journal_takes_nothing_away(place, tmp_path):
    path = measured.journalled(tmp_path / "one", [5.0])
    copy = tmp_path / "copy.json"
    copy.write_bytes(path.read_bytes())
    door = place.door()
    assert [door.take(copy).outcome, door.take(path).outcome, door.take(copy).outcome] == ["added", "extended", "known"]
    with place.open().reading() as connection:
        assert len(reading.parts(connection, 1)["trials"]) == 3


def test_test_that_is_there_with_other_contents_is_refused_and_nothing_changed(any_place, tmp_path):
    path = measured.in_folder(tmp_path / "one", 5.0)
    any_place.door().take(path)
    before = contents(any_place.open())
    document = json.loads(path.read_text(encoding="utf-8"))
    document["session"]["robot"] = "another"
    path.write_text(json.dumps(document), encoding="utf-8")
    found = any_place.door().take(path)
    assert found.outcome == "refused" and "a1 is in the store with other contents" in found.sentence
    assert contents(any_place.open()) == before


@pytest.mark.parametrize("spoil", [lambda path: path.write_bytes(path.read_bytes()[:300]),
                                   lambda path: path.write_text("{}"), lambda path: path.unlink()])
def test_damaged_file_is_a_sentence_and_the_next_one_goes_in(place, tmp_path, spoil):
    bad, good = measured.in_folder(tmp_path / "bad", 5.0), measured.in_folder(tmp_path / "good", 5.0)
    spoil(bad)
    door = place.door()
    refused = door.take(bad)
    assert refused.outcome == "refused" and refused.sentence.endswith(".")
    assert door.take(good).outcome == "added"


def test_two_cells_writing_at_once_lose_nothing_and_enter_nothing_twice(any_place, tmp_path):
    records = [read_record(measured.in_folder(tmp_path / str(number), 5.0 + number, mark=f"m{number}", identity=GOLF))
               for number in range(8)]
    place, outcomes = any_place, []
    place.open()
    both = threading.Barrier(2)

    def cell():
        database = place.open()
        both.wait(10.0)
        outcomes.extend(add(database, None, record) for record in records)

    cells = [threading.Thread(target=cell) for _ in range(2)]
    for each in cells:
        each.start()
    for each in cells:
        each.join(30.0)
    assert sorted(outcome.value for outcome in outcomes) == ["added"] * 8 + ["known"] * 8
    found = contents(place.open())
    assert [len(found[name]) for name in ("test", "line", "car", "key", "equipment")] == [8, 8, 1, 1, 1]


def test_two_programs_that_make_a_store_at_once_make_one(any_place):
    problems, both = [], threading.Barrier(2)

    def make():
        both.wait(10.0)
        try:
            any_place.open()
        except Exception as error:
            problems.append(error)

    makers = [threading.Thread(target=make) for _ in range(2)]
    for each in makers:
        each.start()
    for each in makers:
        each.join(30.0)
    assert not problems


def test_store_that_another_program_is_making_is_waited_for(place, monkeypatch):
    other = sqlite3.connect(place.address, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    clock = SimpleNamespace(monotonic=time.monotonic, sleep=lambda _: other.commit())
    monkeypatch.setattr("mtr_results.store.database.time", clock)
    with place.open().reading() as connection:
        assert connection.execute(text("PRAGMA journal_mode")).scalar() == "wal"
    other.close()


def test_migrations_make_what_the_models_say(any_place):
    with any_place.open().reading() as connection:
        assert compare_metadata(MigrationContext.configure(connection), METADATA) == []
    config = Config()
    config.set_main_option("script_location", mtr_results.migrations.__path__[0])
    assert ScriptDirectory.from_config(config).get_heads() == [mtr_results.migrations.HEAD]


@pytest.mark.parametrize(("version", "words"), [("0000", "mtr-results upgrade"), ("9999", "install the newer program")])
def test_store_of_another_version_is_refused_with_what_to_do(place, version, words):
    with place.open().writing() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = :version"), {"version": version})
    with pytest.raises(StoreError, match=words):
        place.open()


def test_tables_of_another_program_and_files_that_are_no_store_are_left_alone(place, tmp_path):
    with place.open().writing() as connection:
        connection.execute(text("DROP TABLE alembic_version"))
    with pytest.raises(StoreError, match="another program"):
        place.open()
    other = tmp_path / "other.sqlite"
    other.write_bytes(b"no database at all, whatever its name says" * 100)
    with pytest.raises(StoreError, match="none of a store"):
        type(place)(str(other)).open()


def test_what_comes_while_the_store_is_away_waits_and_goes_in_later(tmp_path, place):
    disk = tmp_path / "disk"
    away = type(place)(str(disk / "store.sqlite"), spool=tmp_path / "spool")
    paths = [measured.in_folder(tmp_path / "one", 5.0), measured.journalled(tmp_path / "two", [5.0], mark="b2")]
    found = [away.door().take(path, "winter") for path in [*paths, *paths]]
    assert {each.outcome for each in found} == {"spooled"} and "connect its disk" in found[0].sentence
    assert len([*(tmp_path / "spool").iterdir()]) == 2
    disk.mkdir()
    assert [each.outcome for each in away.door().take_waiting()] == ["added", "added"]
    assert [each.outcome for each in away.door().take_waiting()] == [] == [*(tmp_path / "spool").iterdir()]
    with away.open().reading() as connection:
        assert [row["campaign"] for row in reading.find(connection, Search())] == ["winter", "winter"]
        assert {len(reading.parts(connection, number)["files"]) for number in (1, 2)} == {2}


@contextlib.contextmanager
def full_disk():
    """Context in which an opened store cannot grow."""
    def limit(connection, _record):
        # SQLite does not accept less than the present size.
        connection.execute("PRAGMA max_page_count = 1")
    event.listen(Engine, "connect", limit)
    try:
        yield
    finally:
        event.remove(Engine, "connect", limit)


def test_full_store_is_away_and_takes_what_waits_when_there_is_room(place, tmp_path):
    place.open().close()
    with full_disk():
        found = place.door().take(measured.in_folder(tmp_path / "one", *[5.0] * 40, lines=40))
        assert found.outcome == "spooled" and "its disk is full; make room" in found.sentence
        with place.open().reading() as connection:
            assert reading.find(connection, Search()) == []
    assert [each.outcome for each in place.door().take_waiting()] == ["added"]


@pytest.mark.parametrize("address", ["postgresql://me:secret@127.0.0.1:1/lab", "disk/store.sqlite"])
def test_test_that_waits_for_one_store_goes_into_no_other(place, tmp_path, monkeypatch, capsys, address):
    monkeypatch.chdir(tmp_path)
    away, path = type(place)(address, spool=place.spool), measured.in_folder(tmp_path / "one", 5.0)
    assert [away.door().take(path, "winter").outcome for _ in range(2)] == ["spooled", "spooled"]
    assert place.door().take(measured.in_folder(tmp_path / "two", 6.0, mark="b2")).outcome == "added"
    assert list(place.door().take_waiting()) == []
    with place.open().reading() as connection:
        assert len(reading.find(connection, Search())) == 1
    assert main(["spool", "--spool", str(place.spool), "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)
    assert row["campaign"] == "winter" and "secret" not in str(row)
    assert row["store"] == ("postgresql://127.0.0.1:1/lab" if "://" in address else str(tmp_path / address))
    assert "secret" not in "".join(file.read_text() for file in place.spool.rglob(".store"))


def test_test_waits_for_its_store_by_whatever_path_it_is_named(place, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    type(place)("disk/store.sqlite", spool=place.spool).door().take(measured.in_folder(tmp_path / "one", 5.0))
    (tmp_path / "disk").mkdir()
    monkeypatch.chdir(tmp_path / "disk")
    again = type(place)("store.sqlite", spool=place.spool)
    assert [each.outcome for each in again.door().take_waiting()] == ["added"]


@pytest.mark.parametrize(("one", "other", "is_same"), [
    ("postgresql://a:b@host/lab", "postgresql://c@host:5432/lab", True),
    ("postgresql://host/lab", "postgresql://host/x", False),
    ("postgresql://host/lab", "postgresql://host:5433/lab", False),
    ("postgresql:///lab", "postgresql://localhost/lab", True)])
def test_server_and_database_say_which_store_it_is(place, one, other, is_same):
    assert (type(place)(one).target == type(place)(other).target) is is_same


def test_test_that_waits_for_an_unknown_store_is_named_and_goes_nowhere(place, tmp_path, capsys):
    away = type(place)(str(tmp_path / "disk" / "store.sqlite"), spool=place.spool)
    away.door().take(measured.in_folder(tmp_path / "one", 5.0))
    (waiting,) = place.spool.iterdir()
    (waiting / ".store").unlink()
    (found,) = place.door().take_waiting()
    assert found.outcome == "refused" and str(waiting) in found.sentence and waiting.is_dir()
    assert main(["spool", "--spool", str(place.spool)]) == 0
    assert "nobody knows" in capsys.readouterr().out


def test_nothing_is_left_of_a_test_that_cannot_wait_on_a_full_disk(tmp_path, monkeypatch):
    def copy_part(source, target):
        target.write_bytes(source.read_bytes()[:100])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    monkeypatch.setattr(shutil, "copyfile", copy_part)
    path, spool = measured.in_folder(tmp_path / "one", 5.0), Spool(tmp_path / "spool")
    with pytest.raises(StoreError, match="No space left on device. It is where it was; import it again."):
        spool.put(read_record(path), path)
    assert [*spool.folder.iterdir()] == []


def test_store_that_cannot_be_read_on_a_full_disk_says_so():
    # Error of SQLite if the disk is too full for the file that readers share.
    with pytest.raises(StoreAway, match="its disk is full, or has errors"), told("lab"):
        raise OperationalError("SELECT 1", {}, sqlite3.OperationalError("disk I/O error"))


def test_locked_store_is_away_and_says_so(place, tmp_path, monkeypatch):
    monkeypatch.setattr("mtr_results.store.database.BUSY_S", 0.01)
    door, database = place.door(), place.open()
    with database.writing():
        found = door.take(measured.in_folder(tmp_path / "one", 5.0))
    assert found.outcome == "spooled" and "another program has been writing" in found.sentence


def test_server_that_is_away_or_refuses_is_told_apart_without_its_password(postgresql_address, place, tmp_path):
    away = type(place)("postgresql://me:secret@127.0.0.1:1/lab", spool=tmp_path / "spool")
    found = away.door().take(measured.in_folder(tmp_path / "one", 5.0))
    assert found.outcome == "spooled" and "secret" not in found.sentence
    assert "no database server answers" in found.sentence
    wrong = postgresql_address.replace("of%20the%20test", "secret")
    with pytest.raises(StoreError, match="refuses this user or password"):
        type(place)(wrong).door()


def test_tests_are_searched_by_words_and_by_what_is_listed(any_place, tmp_path):
    database = any_place.open()
    for number, identity in ((1, GOLF), (2, Identity("", "Up", key_serial="7"))):
        record = read_record(measured.in_folder(tmp_path / str(number), 5.0, mark=f"m{number}",
                                                started=f"2026-11-2{number}T23:30:00-02:00", identity=identity))
        assert add(database, None, record) is Outcome.ADDED
    with database.reading() as connection:
        def found(**wanted):
            return [row["id"] for row in reading.find(connection, Search(**wanted))]
        assert found() == [2, 1] and found(limit=1) == [2] and found(limit=1, offset=1) == [1]
        assert found(text="golf shut") == [1] == found(text="100%") and found(text="1_0%") == []
        assert found(car="Up") == [2] and found(key="0042") == [1] and found(software="SW 7") == [1]
        assert found(since="2026-11-23") == [2] and found(until="2026-11-22") == [1]
        assert reading.values_of(connection)["car"] == ["Golf WVW1", "Up"]
        assert reading.number_of(connection, "m2") == 2 == reading.number_of(connection, "2")
        for word in ("m", "9", ""):
            with pytest.raises(StoreError, match="mtr-results list"):
                reading.number_of(connection, word)
