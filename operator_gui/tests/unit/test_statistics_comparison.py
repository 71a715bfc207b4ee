"""Comparison of tests: no difference without support by its interval; open ends remain open."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import json
import math
import random

import measured
import numpy as np
import pytest

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.history.estimate import Known, estimate
from mtr_operator.history.line_pairs import Side
from mtr_operator.history.same_lines import Tests
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.history.statistics.difference import Change
from mtr_operator.history.statistics.documents import pair_document
from mtr_operator.history.statistics.multiplicity import chance, holm
from mtr_operator.history.statistics.row import AREA
from mtr_operator.history.statistics.texts import comparison_lines

HALF_M = measured.HALF_M


def rows(comparison, quantity="distance"):
    return [row for row in comparison.rows if row.quantity == quantity]


def noisy(generator, true_m, lines=8):
    """Return a test whose intervals cover the true value in 95 of 100 cases."""
    return measured.side(*(generator.gauss(true_m, HALF_M / 1.96) for _ in range(lines)), lines=lines)


def test_chance_is_that_of_the_interval():
    assert chance(1.96, 0.0, 3.92) == pytest.approx(0.05, abs=1e-4)
    assert chance(-1.96, -3.92, 0.0) == pytest.approx(0.05, abs=1e-4)
    assert chance(0.0, -1.0, 1.0) == 1.0
    assert chance(None, 0.1, math.inf) == pytest.approx(0.05) and chance(None, -0.1, math.inf) == 1.0
    assert chance(1.0, 0.0, 2.0, freedom=3.0) == pytest.approx(0.05, abs=1e-6)


def test_holm_is_that_of_the_paper():
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    assert holm([]) == [] and holm([0.7, 0.9]) == [1.0, 1.0]


def test_chance_alone_makes_a_difference_among_all_in_at_most_one_of_twenty_comparisons():
    generator = random.Random(3)
    pairs = [(noisy(generator, 5.0), noisy(generator, 5.0)) for _ in range(20)]
    found = [compare_sets([first], [second]) for first, second in pairs]
    assert sum(each.is_different for each in found) <= 3
    assert sum(row.change is not Change.NOT_SHOWN for each in found for row in rows(each)) > 0


def test_weaker_antenna_is_found_also_by_repetitions_without_intervals():
    generator = random.Random(4)
    weaker = compare_sets([noisy(generator, 5.0)], [noisy(generator, 4.2)])
    assert weaker.is_different and weaker.counts()[Change.NEARER] >= 6
    assert rows(weaker, AREA)[0].change is Change.NEARER
    known = [Known(value, value, value, None) for value in (5.0, 5.1, 4.9, 5.0)]
    assert estimate(known[:1]).reason and not estimate(known).reason
    found = estimate(known)
    assert (found.value, found.low, found.high) == pytest.approx((5.0, 4.870, 5.130), abs=1e-3)


def test_mean_of_repetitions_holds_the_truth_and_what_they_share():
    generator = np.random.default_rng(5)
    held = 0
    for _ in range(400):
        known = [Known(value, value, value, None) for value in generator.normal(5.0, 0.2, 4)]
        found = estimate(known)
        held += found.low <= 5.0 <= found.high
    assert 0.92 <= held / 400 <= 0.98
    wider = estimate([Known(value, value, value, None, shared=0.3) for value in (5.0, 5.1, 4.9, 5.0)])
    assert wider.high - 5.0 == pytest.approx(math.hypot(0.130, 1.96 * 0.3), abs=1e-3)


def test_open_interval_is_an_end_and_no_value():
    first = measured.side(measured.at_least(1, 6.0), 5.0, 5.0, 5.0)
    row = rows(compare_sets([first], [measured.side(5.0, 5.0, 5.0, 5.0)]))[0]
    assert row.first.value is None and row.first.high == math.inf
    assert row.change is Change.NEARER and row.difference.high < -0.6 and row.difference.low == -math.inf
    # The confidence beyond 95 % is unknown, which is not sufficient among many rows.
    assert not row.is_different and row.adjusted == pytest.approx(0.5)
    both = compare_sets([first], [first])
    assert rows(both)[0].change is Change.NOT_KNOWN and rows(both, AREA)[0].difference.high == math.inf
    mixed = estimate([Known(None, 6.0, math.inf, (5.9, math.inf)), Known(5.0, 5.0, 5.0, (4.7, 5.3))])
    assert mixed.value is None and mixed.high == math.inf and mixed.low < 5.5


def test_area_is_that_of_the_polygon_and_its_interval_grows_with_what_lines_share():
    square = rows(compare_sets([measured.side(5.0, 5.0, 5.0, 5.0)], [measured.side(6.0, 6.0, 6.0, 6.0)]), AREA)[0]
    assert (square.first.value, square.second.value) == pytest.approx((50.0, 72.0))
    # First order: 10 m2 per m of a line, four independent ones of 0.3 m.
    assert square.first.high - 50.0 == pytest.approx(5.0 * 2 * HALF_M / 2 * 2, rel=0.15)
    assert square.difference.low > 10.0 and square.is_different
    few = measured.side(5.0, 5.0)
    assert rows(compare_sets([few], [few]), AREA) == []


def test_sets_of_different_scenarios_or_without_tests_are_refused():
    with pytest.raises(OperatorError, match="has no test"):
        compare_sets([], [measured.side(5.0)])
    with pytest.raises(OperatorError, match="measured nothing"):
        Tests([measured.side()])


def test_lines_that_only_one_side_has_are_named():
    found = compare_sets([measured.side(5.0, 5.0, 5.0, 5.0)], [measured.side(5.0, 5.0)])
    assert [name for name in found.only_first] == ["radial 3 (180\N{DEGREE SIGN})", "radial 4 (270\N{DEGREE SIGN})"]
    assert len(rows(found)) == 2 and found.only_second == ()
    other = compare_sets([measured.side(5.0, 5.0, 5.0, 5.0)], [measured.side(*[5.0] * 8, lines=8)])
    assert len(other.only_second) == 4 and len(rows(other)) == 4


def test_holes_and_verdicts_stand_beside_each_other():
    holed = measured.searched(1, 5.0, holes_m="3.10")
    found = compare_sets([measured.side(holed, 5.0, 5.0, 5.0)], [measured.side(5.0, 5.0, 5.0, 5.0)] * 2)
    assert found.holes == (("radial 1 (0\N{DEGREE SIGN})", "3.10", ""),)
    assert found.verdicts == ({"not_set": 1}, {"not_set": 2})


def compared(first, second):
    return compare_sets([first], [second])


def test_same_test_shows_no_difference():
    found = compared(measured.side(5.0, 6.0), measured.side(5.0, 6.0))
    assert [(row.change, row.difference.value) for row in found.distances] == 2 * [(Change.NOT_SHOWN, 0.0)]
    assert found.expected_by_chance == pytest.approx(0.1)


@pytest.mark.parametrize("by_m, change", [(0.40, Change.NOT_SHOWN), (0.55, Change.FARTHER), (-0.55, Change.NEARER)])
def test_difference_is_shown_from_where_its_interval_leaves_zero(by_m, change):
    row, = compared(measured.side(5.0), measured.side(5.0 + by_m)).distances
    assert row.change is change and row.difference.low < by_m < row.difference.high
    # Two intervals of half width 0.3 m make one of 0.3 * sqrt(2), and a little more for errors in common.
    assert row.difference.high - row.difference.low >= 2.0 * HALF_M * math.sqrt(2.0)


def test_no_more_differences_than_chance_allows_where_there_is_none():
    rng = random.Random(1)
    rows_of_lines = [compared(*(measured.side(rng.gauss(5.0, HALF_M / 1.96)) for _ in range(2))).distances[0]
                     for _ in range(400)]
    # 5 % of 400 are 20; the common errors, counted in full for both, make it fewer.
    assert 0 < sum(row.change is not Change.NOT_SHOWN for row in rows_of_lines) <= 30


def test_without_intervals_nothing_is_called_different_whatever_the_figures():
    parameters = dataclasses.replace(measured.parameters(), method="scan")
    sides = [Side(measured.SCENARIO, parameters, Progress("key_press", parameters.to_mapping(), {}, measured.CAR, [
        KeyPressResult(1, 0.0, LineStatus.OK, distance_m, distance_m + 0.5, 0.01, 9, 1.0, "")]))
        for distance_m in (3.0, 6.0)]
    row, = compared(*sides).distances
    assert row.change is Change.NOT_KNOWN and not row.is_different
    assert row.difference.reason == "Side 1: One test that does not say how sure it is."


@pytest.mark.parametrize("changes, reason", [
    ({"status": LineStatus.INVALID}, "The line is invalid."),
    ({"status": LineStatus.NOT_REACHED, "reach": "nearer"},
     "The key worked on no line of this test; it may have been asleep.")])
def test_invalid_line_and_a_key_that_may_have_slept_are_not_compared(changes, reason):
    unknown = measured.side(dataclasses.replace(measured.searched(1, 5.0), d50_m=None, d50_low_m=None, **changes))
    row, = compared(measured.side(5.0), unknown).distances
    assert (row.change, row.difference.reason) == (Change.NOT_KNOWN, f"Side 2: {reason}")
    row, = compared(unknown, measured.side(5.0)).distances
    assert (row.change, row.difference.reason) == (Change.NOT_KNOWN, f"Side 1: {reason}")
    several = compare_sets([unknown, unknown], [measured.side(5.0)])
    assert several.distances[0].difference.reason == "Side 1: No test measured it."


def test_line_that_was_not_reached_is_known_from_one_side_if_the_key_worked_elsewhere():
    dead = KeyPressResult(1, 0.0, LineStatus.NOT_REACHED, None, 3.0, None, 9, None, "", method="adaptive",
                          reach="nearer", d50_high_m=3.2)
    row = compared(measured.side(dead, 5.0), measured.side(5.0, 5.0)).distances[0]
    assert row.change is Change.FARTHER and row.difference.high == math.inf and row.difference.value is None


def test_lines_are_paired_by_their_place():
    found = compared(measured.side(5.0, 5.0), measured.side(*[5.0] * 8, lines=8))
    assert [(row.line, found.tests.results[1][row.line].number) for row in found.distances] == [(1, 1), (2, 3)]
    assert found.only_first == () and len(found.only_second) == 6
    assert found.only_second[0].startswith("radial 2 (")


def test_tests_of_two_scenarios_are_refused():
    with pytest.raises(OperatorError, match="scenarios Autolock and Key press cannot be looked at together"):
        compared(measured.side(5.0), Side(SCENARIOS["autolock"], SCENARIOS["autolock"].parameters_type(),
                                          measured.progress()))


def test_comparison_as_text_and_as_values():
    found = compared(measured.side(5.0, 5.0), measured.side(6.0, 5.1))
    text = "\n".join(comparison_lines(found))
    assert "farther *" in text and "+1.00" in text and "Different among all (Holm): radial 1" in text
    document = json.loads(json.dumps(pair_document(found), allow_nan=False))
    assert [(each["change"], each["is_different"]) for each in document["differences"]] == [
        ("farther", True), ("no difference shown", False)]
    assert {"scenario", "started", "differs", "differences", "only_first", "only_second",
            "expected_by_chance"} <= set(document)
    assert {"line", "line_second", "place", "what", "first", "second", "difference_m", "low_m", "high_m", "change",
            "reason"} <= set(document["differences"][0])
