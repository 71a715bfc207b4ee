"""Tests of before: found in folders and read once, searched, and compared without calling chance a difference."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import json
import math
import os
import random

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import JournalMark, Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_operator.history.circumstances import circumstances
from mtr_operator.history.comparison import Change, compare
from mtr_operator.history.comparison_text import comparison_document, comparison_lines
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


def test_same_test_shows_no_difference():
    compared = compare(side(5.0, 6.0), side(5.0, 6.0))
    assert [difference.change for difference in compared.differences] == 2 * [Change.NOT_SHOWN]
    assert [difference.value_m for difference in compared.differences] == [0.0, 0.0]
    assert compared.expected_by_chance == pytest.approx(0.1)


def test_difference_is_shown_from_where_its_interval_leaves_zero():
    # Two intervals of half width 0.3 m make one of 0.3 * sqrt(2), and a little more for what both have in common.
    for by_m, change in ((0.40, Change.NOT_SHOWN), (0.55, Change.FARTHER), (-0.55, Change.NEARER)):
        difference = compare(side(5.0), side(5.0 + by_m)).differences[0]
        assert difference.change is change, by_m
        assert difference.low_m < by_m < difference.high_m
        assert difference.high_m - difference.low_m >= 2.0 * HALF_M * math.sqrt(2.0)


def test_no_more_differences_than_chance_allows_where_there_is_none():
    rng = random.Random(1)
    shown = 0
    for _ in range(400):
        first, second = (side(rng.gauss(5.0, HALF_M / SIGMAS_OF_LEVEL)) for _ in range(2))
        shown += compare(first, second).differences[0].change is not Change.NOT_SHOWN
    # 5 % of 400 are 20; the common errors, counted in full for both, make it fewer.
    assert shown <= 30


def test_without_intervals_nothing_is_called_different_whatever_the_figures():
    scan = parameters("scan")
    results = [KeyPressResult(1, 0.0, LineStatus.OK, distance_m, distance_m + 0.5, 0.01, 9, 1.0, "")
               for distance_m in (3.0, 6.0)]
    sides = [Side(SCENARIO, scan, dataclasses.replace(progress([result]), parameters=scan.to_mapping()))
             for result in results]
    difference = compare(*sides).differences[0]
    assert difference.change is Change.NOT_KNOWN
    assert difference.reason == "Test 1 does not say how sure this distance is."


def test_invalid_line_and_a_key_that_may_have_slept_are_not_compared():
    bad = KeyPressResult(1, 0.0, LineStatus.INVALID, None, None, None, 0, None, "lifted", method="adaptive")
    invalid = Side(SCENARIO, parameters(), progress([bad]))
    assert compare(side(5.0), invalid).differences[0].reason == "It is invalid in test 2."
    dead = KeyPressResult(1, 0.0, LineStatus.NOT_REACHED, None, 3.0, None, 9, None, "", method="adaptive",
                          reach="nearer", d50_high_m=3.2)
    silent = Side(SCENARIO, parameters(), progress([dead]))
    assert compare(silent, side(5.0)).differences[0].change is Change.NOT_KNOWN
    # Where it worked on another line, the border of this one is known from one side.
    awake = Side(SCENARIO, parameters(), progress([dead, searched(2, 5.0)]))
    difference = compare(awake, side(5.0, 5.0)).differences[0]
    assert difference.change is Change.FARTHER and difference.high_m == math.inf and difference.value_m is None


def test_lines_are_paired_by_their_place_and_the_rest_is_named():
    eighths = Side(SCENARIO, parameters(angle_between_radials_rad=QUARTER / 2.0), dataclasses.replace(
        progress([searched(number, 5.0) for number in range(1, 9)]),
        parameters=parameters(angle_between_radials_rad=QUARTER / 2.0).to_mapping()))
    compared = compare(side(5.0, 5.0), eighths)
    assert [(pair.pair.number, pair.pair.second.number) for pair in compared.differences] == [(1, 1), (2, 3)]
    assert compared.only_first == () and len(compared.only_second) == 6
    assert compared.only_second[0].startswith("radial 2 (")


def test_tests_of_two_scenarios_or_without_a_line_are_refused():
    with pytest.raises(OperatorError, match="Key press and one of Autolock cannot be compared"):
        compare(side(5.0), Side(SCENARIOS["autolock"], SCENARIOS["autolock"].parameters_type(), progress()))
    with pytest.raises(OperatorError, match="has measured nothing"):
        compare(side(5.0), side())


def test_what_else_differs_is_told():
    first = side(5.0, identity=Identity("A", key_battery_v=3.0))
    second = side(5.0, identity=Identity("B", key_battery_v=2.8))
    second.progress.session["robot software"] = "0.3.0"
    rows = {row.name: (row.first, row.second) for row in circumstances(first, second)}
    assert rows == {"Car's VIN": ("A", "B"), "Key's battery": ("3 V", "2.8 V"), "robot software": ("", "0.3.0")}


def test_comparison_as_text_and_as_values():
    compared = compare(side(5.0, 5.0), side(6.0, 5.1))
    text = "\n".join(comparison_lines(compared))
    assert "farther" in text and "+1.00" in text and "by chance alone about 0.1 would differ." in text
    document = json.loads(json.dumps(comparison_document(compared), allow_nan=False))
    assert [each["change"] for each in document["differences"]] == ["farther", "no difference shown"]


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
