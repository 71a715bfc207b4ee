"""The store in the application's history: listed next to the folders, and exported to files."""
# SPDX-License-Identifier: Apache-2.0
import hashlib
import importlib.metadata
import pathlib

import measured
import pytest

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.identity.identity import Identity, Photo
from mtr_operator.history.chosen import brought, compared, side_of, spread_of_chosen
from mtr_operator.history.laboratory import GROUP, file_of, kept_entries, laboratory
from mtr_operator.history.line_pairs import open_side
from mtr_operator.history.reading import read_entry
from mtr_operator.history.search import listed, repetitions
from mtr_results.laboratory import ResultsLaboratory, open_laboratory
from mtr_results.store import place as usual
from mtr_results.store.place import ADDRESS_VARIABLE, Place

PYPROJECT = pathlib.Path(__file__).resolve().parents[3] / "pyproject.toml"
GOLF = Identity("WVW1", "Golf", key_serial="0042", operator="Nov\u00e1k", place="Lot")


def point(value="mtr_results.laboratory:open_laboratory"):
    return importlib.metadata.EntryPoint("results", value, GROUP)


@pytest.fixture
def named(place, monkeypatch):
    """Return the store from the environment, without any other store."""
    monkeypatch.setenv(ADDRESS_VARIABLE, place.address)
    monkeypatch.setattr("mtr_operator.history.laboratory._installed", lambda: [point()])
    return place


def test_application_names_no_store_but_the_one_that_is_declared():
    assert f'[project.entry-points."{GROUP}"]\nresults = "{point().value}"' in PYPROJECT.read_text(encoding="utf-8")


def test_tests_of_the_store_are_entries_like_those_of_files(any_place, tmp_path):
    path = measured.in_folder(tmp_path / "one", 5.0, 5.5, 6.5, identity=GOLF)
    any_place.door().take(path)
    entry, = ResultsLaboratory(any_place).entries()
    of_file = read_entry(path)
    for name in ("test_id", "entries", "started", "scenario", "car", "key", "operator", "place", "done", "total",
                 "invalid", "is_complete", "verdict", "words"):
        assert getattr(entry, name) == getattr(of_file, name), name
    assert entry.store and "PASSWORD" not in entry.store and entry.path == "1"
    assert listed([entry, of_file]) == [of_file]


def test_test_of_the_store_is_the_same_test_as_a_file(any_place, tmp_path):
    path = measured.journalled(tmp_path / "one", [5.0, 5.5])
    any_place.door().take(path)
    shelf = ResultsLaboratory(any_place)
    entry, = shelf.entries()
    copy = tmp_path / "copy.json"
    shelf.fetch(entry, copy)
    assert open_side(copy) == open_side(path)
    assert copy.with_suffix(".journal").read_bytes() == path.with_suffix(".journal").read_bytes()


def test_content_that_was_lost_leaves_what_was_measured(place, tmp_path):
    path = measured.journalled(tmp_path / "one", [5.0, 5.5])
    place.door().take(path)
    for content in place.kept_files().folder.rglob("*"):
        if content.is_file():
            content.write_bytes(b"other")
    shelf, copy = ResultsLaboratory(place), tmp_path / "copy.json"
    shelf.fetch(shelf.entries()[0], copy)
    assert open_side(copy).progress.results == open_side(path).progress.results
    assert not copy.with_suffix(".journal").exists()


def test_photos_come_with_their_test(place, tmp_path):
    photo = Photo("car.jpg", hashlib.sha256(b"picture").hexdigest())
    path = measured.in_folder(tmp_path / "one", 5.0, identity=Identity("WVW1", photos=(photo,)))
    (path.parent / "photos").mkdir()
    (path.parent / "photos" / "car.jpg").write_bytes(b"picture")
    place.door().take(path)
    shelf = ResultsLaboratory(place)
    shelf.fetch(shelf.entries()[0], tmp_path / "copy.json")
    assert (tmp_path / "copy.photos" / "car.jpg").read_bytes() == b"picture"


def test_without_a_store_there_is_none_and_none_is_made(tmp_path, monkeypatch):
    monkeypatch.delenv(ADDRESS_VARIABLE, raising=False)
    monkeypatch.setattr(usual.platformdirs, "user_data_path", lambda *_, **__: tmp_path)
    assert open_laboratory() is None and kept_entries([point()]) == []
    assert not list(tmp_path.iterdir())


def test_package_that_is_not_installed_is_no_store():
    assert laboratory([point("no_such_package:open")]) is None


@pytest.mark.parametrize(("address", "said"), [
    ("gone.sqlite", "is away: there is no such file"), ("empty.sqlite", "holds no store yet"),
    ("other.sqlite", "the file is none of a store"), ("mysql://root:secret@host/x", "is no address of a store")])
def test_store_that_cannot_be_read_is_one_sentence_and_nothing_is_made(tmp_path, monkeypatch, address, said):
    (tmp_path / "empty.sqlite").write_bytes(b"")
    (tmp_path / "other.sqlite").write_bytes(b"something else, and long enough to be looked at" * 50)
    monkeypatch.setenv(ADDRESS_VARIABLE, address if "://" in address else str(tmp_path / address))
    entry, = kept_entries([point()])
    assert said in entry.problem and "secret" not in entry.problem
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty.sqlite", "other.sqlite"]


def test_tests_of_the_store_are_compared_repeated_and_spread(named, tmp_path):
    door = named.door()
    for number, distance_m in enumerate((5.0, 5.1, 5.2), start=1):
        door.take(measured.in_folder(tmp_path / str(number), distance_m, distance_m, identity=GOLF,
                                     started=f"2026-11-2{number}T10:00:00+01:00", mark=f"m{number}"))
    door.take(measured.in_folder(tmp_path / "other", 5.0, identity=GOLF, lines=8, mark="m9"))
    entries = [entry for entry in listed(kept_entries()) if entry.done]
    alike = next(entry for entry in entries if entry.test_id == "m1")
    first, second = (next(entry for entry in entries if entry.test_id == mark) for mark in ("m1", "m2"))
    assert compared(first, second).distances[0].difference.value == pytest.approx(0.1)
    assert side_of(first).parameters == measured.parameters()
    tests = repetitions(entries, alike)
    assert len(tests) == 4
    found = spread_of_chosen(tests, alike, lambda: False)
    assert [side.progress.kept.id for side in found.tests.sides] == ["m1", "m2", "m3"]


def test_opened_test_is_copied_beside_the_others_and_overwrites_none(named, tmp_path):
    named.door().take(measured.in_folder(tmp_path / "one", 5.0, identity=GOLF))
    entry, = kept_entries()
    folder = tmp_path / "progress"
    first, second = brought(entry, folder), brought(entry, folder)
    assert first.name == "key_press_2026-11-22_15-36-43.json" and second.name.endswith("_2.json")
    assert open_side(first) == open_side(second)


def test_store_that_has_gone_since_is_a_sentence(named, tmp_path):
    named.door().take(measured.in_folder(tmp_path / "one", 5.0))
    entry, = kept_entries()
    pathlib.Path(named.address).unlink()
    with pytest.raises(OperatorError, match="no such file"), file_of(entry):
        pass


def test_place_shows_no_password():
    assert "secret" not in Place("postgresql://me:secret@host/tests").shown
