"""Tests of before: found in folders and read once, searched, and compared without calling chance a difference."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import os

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import JournalMark, Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_operator.history.circumstances import circumstances_of_sets
from mtr_operator.history.entry import TestEntry, entry_from
from mtr_operator.history.index import Index
from mtr_operator.history.line_pairs import Side, open_side
from mtr_operator.history.reading import read_entry
from mtr_operator.history.search import matching, problems_of, values_of
from mtr_operator.storage.progress_file import save_progress

SCENARIO = SCENARIOS["key_press"]
CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
QUARTER = math.pi / 2.0
HALF_M = 0.3
HEAD = '{"format": "mtr-operator history", "version": 2, "tests": '


def parameters(method="adaptive", **changes):
    return SCENARIO.parameters_type(method=method, **{"angle_between_radials_rad": QUARTER, **changes})


def searched(number, distance_m, half_m=HALF_M, **changes):
    """A radial of a search with this border and half width of its interval."""
    return KeyPressResult(number, 90.0 * (number - 1), LineStatus.OK, distance_m, distance_m + 0.5, 0.01, 9, 1.0, "",
                          method="adaptive", reach="measured", d50_m=distance_m, d50_sigma_m=half_m / SIGMAS_OF_LEVEL,
                          d50_low_m=distance_m - half_m, d50_high_m=distance_m + half_m, **changes)


def progress(results=(), started="2026-11-22T15:36:43+01:00", mark="a1", **changes):
    return Progress(SCENARIO.name, parameters().to_mapping(), {"started": started, "software": "mtr-operator 0.2.0"},
                    CAR, list(results), kept=JournalMark(mark, 10 + len(results)), **changes)


def written(path, *args, **changes):
    path.parent.mkdir(parents=True, exist_ok=True)
    save_progress(path, progress(*args, **changes))
    return path


def side(*distances_m, half_m=HALF_M, **changes):
    results = [searched(number, distance_m, half_m) for number, distance_m in enumerate(distances_m, start=1)]
    return Side(SCENARIO, parameters(), progress(results, **changes))


ALL = [searched(number, 5.0) for number in (1, 2, 3, 4)]


def test_entry_says_whose_test_it_is_how_far_it_came_and_its_verdict(tmp_path):
    who = Identity("WVW1", "Golf", key_serial="0042", operator="Nov\u00e1k", place="Hall 2", notes="Doors SHUT")
    limits = limits_from({"limits": [{"what": "press", "at_least_m": 6.0}]})
    entry = read_entry(written(tmp_path / "one.json", ALL, identity=who, limits=limits))
    assert (entry.car, entry.key, entry.operator, entry.place) == ("Golf WVW1", "0042", "Nov\u00e1k", "Hall 2")
    assert (entry.done, entry.total, entry.is_complete, entry.verdict) == (4, 4, True, "fail")
    assert entry.moment == "2026-11-22 15:36" and not entry.problem
    assert matching([entry], "golf shut 2026-11") == [entry] and matching([entry], "golf open") == []
    assert matching([entry], verdict="fail") == [entry] and matching([entry], "fail", car="Golf") == []
    assert values_of([entry], "key") == ["0042"]
    assert entry_from(json.loads(json.dumps(entry.to_document()))) == entry


def test_tests_are_found_as_files_and_in_folders_each_once_newest_first(tmp_path):
    written(tmp_path / "progress" / "b.json", ALL[:2], mark="b", started="2026-11-20T10:00:00+01:00")
    original = written(tmp_path / "progress" / "a.json", ALL, mark="a", started="2026-11-21T10:00:00+01:00")
    written(tmp_path / "results" / "a" / "progress.json", ALL, mark="a", started="2026-11-21T10:00:00+01:00")
    (tmp_path / "results" / "nothing").mkdir()
    (tmp_path / "results" / "results.csv").write_text("", encoding="utf-8")
    index = Index([tmp_path / "results", tmp_path / "progress", tmp_path / "gone"])
    entries = index.refresh()
    assert [(entry.test_id, entry.is_complete) for entry in entries] == [("a", True), ("b", False)]
    assert entries[0].file == original


def test_broken_record_is_named_in_one_sentence_and_the_others_are_listed(tmp_path):
    written(tmp_path / "good.json", ALL)
    (tmp_path / "bad.json").write_bytes(b"{")
    (tmp_path / "other.json").write_text('{"format": "something else"}', encoding="utf-8")
    (tmp_path / "deep.json").write_text(50_000 * "[", encoding="utf-8")
    entries = Index([tmp_path]).refresh()
    assert [entry.problem == "" for entry in entries] == [True, False, False, False]
    problems = problems_of(entries)
    for name, problem in zip(("bad", "deep", "other"), problems):
        assert f"{name}.json" in problem and problem.endswith(".") and "\n" not in problem
    assert matching(entries) == entries[:1]


def test_only_what_is_new_or_changed_is_read_also_by_the_next_start(tmp_path, monkeypatch):
    for number in range(3):
        written(tmp_path / "tests" / f"{number}.json", ALL, mark=str(number))
    cache = tmp_path / "cache" / "history.json"
    index = Index([tmp_path / "tests"], cache)
    assert len(index.refresh()) == 3 and index.read == 3
    assert len(index.refresh()) == 3 and index.read == 0
    later = Index([tmp_path / "tests"], cache)
    assert later.refresh() == index.entries and later.read == 0
    changed = written(tmp_path / "tests" / "1.json", ALL[:1], mark="1")
    os.utime(changed, ns=(1, 1))
    (tmp_path / "tests" / "2.json").unlink()
    assert [entry.done for entry in sorted(later.refresh(), key=lambda entry: entry.test_id)] == [4, 1]
    assert later.read == 1
    # A journal that goes on is a change too.
    (tmp_path / "tests" / "0.journal").write_bytes(b"torn")
    later.refresh()
    assert later.read == 1


@pytest.mark.parametrize("content", ["", "[]", "{}", HEAD + "5}", HEAD + '[[[1], {"path": 5}]]}'])
def test_damaged_cache_costs_time_only(tmp_path, content):
    written(tmp_path / "tests" / "a.json", ALL)
    cache = tmp_path / "history.json"
    cache.write_text(content, encoding="utf-8")
    index = Index([tmp_path / "tests"], cache)
    assert [entry.done for entry in index.refresh()] == [4] and index.read == 1
    cache.unlink()
    cache.mkdir()
    assert len(Index([tmp_path / "tests"], cache).refresh()) == 1


def test_reading_can_be_cancelled_and_goes_on_later(tmp_path):
    for number in range(4):
        written(tmp_path / f"{number}.json", ALL, mark=str(number))
    index = Index([tmp_path])
    answers = iter([False, False, True])
    assert len(index.refresh(is_cancelled=lambda: next(answers))) == 2
    assert len(index.refresh()) == 4 and index.read == 2


def test_what_is_found_is_told_while_it_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr("mtr_operator.history.index.TOLD_PERIOD_S", 0.0)
    for number in range(3):
        written(tmp_path / f"{number}.json", ALL, mark=str(number))
    told = []
    Index([tmp_path]).refresh(lambda entries: told.append(len(entries)))
    assert told == [1, 2, 3]


def test_what_else_differs_is_told():
    first = side(5.0, identity=Identity("A", key_battery_v=3.0))
    second = side(5.0, identity=Identity("B", key_battery_v=2.8))
    second.progress.session["robot software"] = "0.3.0"
    rows = {row.name: (row.first, row.second) for row in circumstances_of_sets([first], [second])}
    assert rows == {"Car's VIN": ("A", "B"), "Key's battery": ("3 V", "2.8 V"), "robot software": ("", "0.3.0")}


def test_command_line_lists_and_compares(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("mtr_operator.cli.history.cache_path", lambda folders: tmp_path / "cache.json")
    written(tmp_path / "tests" / "one" / "progress.json", ALL, mark="1", identity=Identity("WVW1"))
    written(tmp_path / "tests" / "two" / "progress.json", [searched(1, 7.0)], mark="2")
    (tmp_path / "tests" / "bad.json").write_bytes(b"{")
    assert main(["history", "--folder", str(tmp_path / "tests"), "wvw1"]) == 0
    out, err = capsys.readouterr()
    assert out.count("key_press") == 1 and "4/4" in out and "bad.json" in err
    assert main(["history", "--folder", str(tmp_path / "tests"), "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)) == 2
    assert main(["compare", str(tmp_path / "tests" / "one"), str(tmp_path / "tests" / "two" / "progress.json")]) == 0
    assert "radial 1" in capsys.readouterr().out
    assert main(["compare", str(tmp_path / "tests" / "one"), str(tmp_path / "tests" / "bad.json")]) == 2
    assert "bad.json" in capsys.readouterr().err


def test_opened_side_is_what_was_written(tmp_path):
    path = written(tmp_path / "a.json", ALL)
    assert open_side(path).progress.results == ALL
    assert isinstance(read_entry(path), TestEntry)
