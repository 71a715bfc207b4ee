"""Copies of one test: the store accepts a copy that continues the other, and never drops measurements."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import shutil
import zlib

import measured
import pytest
from sqlalchemy import select, update

from mtr_operator.domain.results.journal import LINE, LINE_BEGUN, POINT
from mtr_operator.domain.results.progress import Progress
from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.storage.journal.journal_file import Entry, journal_path, line_of, read_journal
from mtr_operator.storage.progress_file import FILE_NAME
from mtr_results.model.tests import Test, Trial
from mtr_results.store import reading


def further(source, folder, *entries):
    """Copy a journalled test, append these entries, and return the path of its progress file."""
    shutil.copytree(source.parent, folder)
    path = folder / FILE_NAME
    number = len(read_journal(journal_path(path)).entries)
    with journal_path(path).open("ab") as file:
        file.writelines(line_of(Entry(number + index, *entry)) for index, entry in enumerate(entries, start=1))
    return path


def line(number, distance_m):
    return (LINE_BEGUN, {"line": number}), (POINT, measured.point("press 1", distance_m, True)), (
        LINE, {"result": measured.searched(number, distance_m).to_document(), "frame": None})


def kept(place):
    """Return lines, their distances and the number of points in the store."""
    with place.open().reading() as connection:
        parts = reading.parts(connection, 1)
    return ([(row["line"], row["first_m"]) for row in parts["measurements"] if row["is_current"]],
            len(parts["trials"]))


@pytest.mark.parametrize("nearer_first", [True, False])
def test_two_copies_that_went_on_apart_are_refused_and_nothing_is_dropped(any_place, tmp_path, nearer_first):
    begun = measured.journalled(tmp_path / "begun", [5.0])
    nearer = further(begun, tmp_path / "nearer", *line(2, 6.0))
    farther = further(begun, tmp_path / "farther", *line(3, 7.0), *line(4, 7.5))
    first, second = (nearer, farther) if nearer_first else (farther, nearer)
    door = any_place.door()
    assert [door.take(begun).outcome, door.take(first).outcome] == ["added", "extended"]
    before = kept(any_place)
    refused = door.take(second)
    assert refused.outcome == "refused" and "went on apart" in refused.sentence
    assert kept(any_place) == before
    assert [door.take(begun).outcome, door.take(first).outcome] == ["known", "known"]


def test_copies_with_other_points_of_a_line_without_result_are_two(any_place, tmp_path):
    begun = measured.journalled(tmp_path / "begun", [5.0])
    one, other = (further(begun, tmp_path / str(distance_m), *line(2, distance_m)[:2]) for distance_m in (6.0, 7.0))
    door = any_place.door()
    assert [door.take(path).outcome for path in (one, other, one)] == ["added", "refused", "known"]
    # An additional line does not compensate for a missing point.
    assert door.take(further(other, tmp_path / "more", line(2, 7.0)[2])).outcome == "refused"
    assert door.take(further(one, tmp_path / "one", line(2, 6.0)[2])).outcome == "extended"


@pytest.mark.parametrize("change", ["a distance", "no journal"])
def test_a_plain_file_takes_the_place_of_a_signed_test_only_where_it_continues_it(place, tmp_path, change):
    path = measured.journalled(tmp_path / "one", [5.0])
    bundle = tmp_path / "one.mtr.zip"
    measured_side = measured.side(measured.searched(1, 5.0))
    write_bundle(bundle, path, measured.SCENARIO, measured_side.progress, None, station=Station(tmp_path / "station"))
    door = place.door()
    assert door.take(bundle).outcome == "added"
    before = kept(place)
    document = json.loads(path.read_text(encoding="utf-8"))
    document["journal"]["entries"] += 1
    if change == "a distance":
        document["results"][0]["d50_m"] = 9.9
    forged = tmp_path / "forged.json"
    forged.write_text(json.dumps(document), encoding="utf-8")
    refused = door.take(forged)
    assert refused.outcome == "refused" and "the journal of this one is missing" in refused.sentence
    assert kept(place) == before
    assert door.take(further(path, tmp_path / "more", *line(2, 6.0))).outcome == "extended"


def test_copies_that_went_on_apart_wait_both_while_the_store_is_away(place, tmp_path):
    begun = measured.journalled(tmp_path / "begun", [5.0])
    away = type(place)(str(tmp_path / "disk" / "store.sqlite"), spool=tmp_path / "spool")
    for distance_m in (6.0, 7.0):
        away.door().take(further(begun, tmp_path / str(distance_m), *line(2, distance_m)[:2]))
    assert len([*(tmp_path / "spool").iterdir()]) == 2


def test_points_that_a_former_version_filed_otherwise_are_filed_anew(place, tmp_path):
    path = further(measured.journalled(tmp_path / "begun", [5.0]), tmp_path / "more", *line(2, 6.0))
    door = place.door()
    door.take(path)
    with place.open().writing() as connection:
        connection.execute(update(Trial).where(Trial.line == 2).values(line=1, number=9))
    assert [door.take(path).outcome, door.take(path).outcome] == ["extended", "known"]
    with place.open().reading() as connection:
        assert [trial["line"] for trial in reading.parts(connection, 1)["trials"]] == [1, 1, 1, 2]


GOLDEN = pathlib.Path(__file__).resolve().parent.parent / "written_before"


def golden_tests(tmp_path):
    """Return tests of earlier releases, and one with fewer parameters than in this release."""
    made = [shutil.copytree(folder, tmp_path / folder.name) / FILE_NAME for folder in sorted(GOLDEN.iterdir())]
    few = measured.in_folder(tmp_path / "few parameters", 5.0, 6.0)
    document = json.loads(few.read_text(encoding="utf-8"))
    document["parameters"] = dict(list(document["parameters"].items())[:3])
    few.write_text(json.dumps(document), encoding="utf-8")
    return [*made, few, measured.journalled(tmp_path / "journalled", [5.0, 6.0], mark="b2")]


def release_with_more(monkeypatch):
    """Simulate the next release, which has one more field in tests, parameters and results."""
    to_document = Progress.to_document

    def with_more(progress):
        document = to_document(progress)
        return {**document, "later": True, "parameters": {**document["parameters"], "later_m": 1.0},
                "results": [{**result, "later_m": None} for result in document["results"]]}
    monkeypatch.setattr(Progress, "to_document", with_more)


@pytest.mark.parametrize("stated", [True, False])
def test_parameter_that_a_file_does_not_state_may_have_had_another_default(any_place, tmp_path, stated):
    path = measured.in_folder(tmp_path / "one", 5.0)
    document = json.loads(path.read_text(encoding="utf-8"))
    name = next(name for name, value in document["parameters"].items() if isinstance(value, float))
    if not stated:
        del document["parameters"][name]
        path.write_text(json.dumps(document), encoding="utf-8")
    any_place.door().take(path)
    with any_place.open().writing() as connection:
        stored = json.loads(zlib.decompress(connection.execute(select(Test.document)).scalar_one()))
        stored["parameters"][name] += 0.125
        connection.execute(update(Test).values(digest="of then", document=zlib.compress(json.dumps(stored).encode())))
    assert any_place.door().take(path).outcome == ("refused" if stated else "known")


def test_tests_of_an_earlier_release_are_known_after_the_next_one(any_place, tmp_path, monkeypatch):
    paths = golden_tests(tmp_path)
    door = any_place.door()
    assert {door.take(path).outcome for path in paths} == {"added"}
    before = kept(any_place)
    release_with_more(monkeypatch)
    found = [door.take(path) for path in paths]
    assert [(each.outcome, each.sentence) for each in found if each.outcome != "known"] == []
    assert kept(any_place) == before


@pytest.mark.parametrize("change", [
    lambda document: document["parameters"].update(interval_m=9.0),
    lambda document: document["session"].update(robot="another"),
    lambda document: document["results"].pop(), lambda document: document["results"][0].update(status="invalid"),
    lambda document: document.update(car=None)])
def test_test_that_was_changed_is_refused_after_the_next_release_too(any_place, tmp_path, monkeypatch, change):
    path = measured.in_folder(tmp_path / "one", 5.0, 6.0)
    door = any_place.door()
    door.take(path)
    release_with_more(monkeypatch)
    document = json.loads(path.read_text(encoding="utf-8"))
    change(document)
    path.write_text(json.dumps(document), encoding="utf-8")
    assert door.take(path).outcome in ("refused", "failed")
