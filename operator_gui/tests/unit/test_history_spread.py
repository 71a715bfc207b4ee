"""Repeated tests: mean and standard deviation of each distance, and which tests are repetitions of one."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import random
import statistics

import measured
import pytest

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.estimation.components import components
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.history.index import Index
from mtr_operator.history.reading import read_entry
from mtr_operator.history.search import repetitions
from mtr_operator.history.spread import spread_of

GOLF = Identity("WVW1", "Golf", key_serial="0042")


def test_mean_and_deviation_of_a_line_are_those_of_its_values():
    values = 5.0, 5.2, 4.9, 5.3
    found = spread_of([measured.side(value, 7.0) for value in values])
    first, second = found.distances
    assert (first.line.number, first.word, first.values_m, first.without) == (1, "press", values, 0)
    assert first.mean.value == pytest.approx(statistics.mean(values))
    assert first.sigma_m == pytest.approx(statistics.stdev(values))
    # Student's t with three degrees of freedom, and wider by what no repetition shows.
    least = 3.1824 * statistics.stdev(values) / 2.0
    assert least < first.mean.value - first.mean.low < 2.0 * least
    assert first.sigma_ends_m == (components(values, {}).components[0].low, components(values, {}).components[0].high)
    low, high = first.sigma_ends_m
    assert 0.0 < low < first.sigma_m < high < math.inf
    assert (second.sigma_m, second.sigma_ends_m, second.spread.reason) == (0.0, None, "All tests have the same value.")
    assert found.differing == () and found.of("press") == [first, second]


def test_interval_of_the_deviation_holds_the_true_one_in_ninety_five_of_a_hundred():
    generator = random.Random(7)
    held = 0
    for _ in range(400):
        one = components([generator.gauss(5.0, 0.1) for _ in range(6)], {}).components[0]
        held += one.low <= 0.1 <= one.high
    # Two sigmas of the count are 9.
    assert 366 <= held <= 394


def test_two_tests_have_a_deviation_and_no_interval_of_it():
    [distance] = spread_of([measured.side(5.0), measured.side(5.2)]).distances
    assert distance.sigma_m == pytest.approx(0.2 / math.sqrt(2.0)) and distance.sigma_ends_m is None
    assert distance.spread.reason == "2 tests have a value here; 3 are the fewest."
    assert distance.mean.low < 5.1 - 12.7 * 0.1 and math.isfinite(distance.mean.low)


def test_open_end_and_invalid_line_have_no_value_and_are_counted():
    invalid = dataclasses.replace(measured.searched(1, 5.0), status=LineStatus.INVALID, d50_m=None)
    sides = [measured.side(5.0), measured.side(5.2), measured.side(4.8), measured.side(measured.at_least(1, 6.0)),
             measured.side(invalid, 5.0)]
    [distance] = spread_of(sides).distances
    assert (distance.values_m, distance.without) == ((5.0, 5.2, 4.8), 2)
    assert distance.sigma_m == pytest.approx(0.2)
    # What is known of the mean is an end: one test lies beyond 6 m.
    assert distance.mean.value is None and math.isinf(distance.mean.high) and math.isfinite(distance.mean.low)


def test_tests_say_in_what_they_differ():
    found = spread_of([measured.side(5.0, identity=GOLF),
                       measured.side(5.1, identity=dataclasses.replace(GOLF, key_serial="0043"))])
    assert found.differing == ("Key's serial number",)


def test_tests_of_two_scenarios_or_without_results_are_refused():
    with pytest.raises(OperatorError, match="has measured nothing"):
        spread_of([measured.side(5.0), measured.side()])


def test_repetitions_are_of_the_same_car_key_and_parameters_oldest_first(tmp_path):
    def written(name, *results, day=1, **changes):
        return measured.in_folder(tmp_path / name, *results, mark=name,
                                  started=f"2026-11-0{day}T10:00:00+01:00", **changes)
    golf = written("golf", 5.0, 5.0, 5.0, 5.0, identity=GOLF, day=2)
    written("again", 5.1, 5.0, identity=GOLF, day=1)
    written("other_key", 5.0, identity=dataclasses.replace(GOLF, key_serial="0043"))
    written("nobody_said", 5.0)
    written("nothing_measured", identity=GOLF)
    written("other_lines", 5.0, identity=GOLF, lines=8)
    (tmp_path / "broken").mkdir()
    (tmp_path / "broken" / "progress.json").write_bytes(b"{")
    entries = Index([tmp_path]).refresh()
    entry = read_entry(golf)
    assert len(entries) == 7
    assert [each.file.parent.name for each in repetitions(entries, entry)] == ["again", "golf"]


def test_parameters_that_are_left_at_their_defaults_are_the_same_as_if_they_were_given(tmp_path):
    path = measured.in_folder(tmp_path / "one", 5.0)
    before = read_entry(path)
    text = path.read_text(encoding="utf-8")
    assert '"self_check": true' in text
    path.write_text(text.replace('"self_check": true,', "", 1), encoding="utf-8")
    assert read_entry(path).parameters == before.parameters != ""
