"""Comparison of tests: no difference without support by its interval; open ends remain open."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
from dataclasses import replace

import measured
import numpy as np
import pytest

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.estimation.components import Component, Spread, components
from mtr_operator.history.comparison import compare
from mtr_operator.history.estimate import Known, estimate
from mtr_operator.history.same_lines import Tests
from mtr_results.statistics.capability import capability
from mtr_results.statistics.comparison import AREA, NEARER, NOT_SHOWN, compare_sets
from mtr_results.statistics.documents import capability_document
from mtr_results.statistics.multiplicity import chance, holm
from mtr_results.statistics.trend import trend

HALF_M = measured.HALF_M


def rows(comparison, quantity="distance"):
    return [row for row in comparison.rows if row.quantity == quantity]


def noisy(generator, true_m, lines=8):
    """Return a test whose intervals cover the true value in 95 of 100 cases."""
    return measured.side(*(generator.gauss(true_m, HALF_M / 1.96) for _ in range(lines)), lines=lines)


def test_two_tests_differ_by_what_the_application_says_of_them():
    first, second = measured.side(5.0, 5.0, 5.0, 5.0), measured.side(5.0, 5.3, 4.2, 6.0)
    theirs = compare(first, second).differences
    mine = rows(compare_sets([first], [second]))
    assert [(row.change.value, row.change.low, row.change.high) for row in mine] == [
        (each.value_m, each.low_m, each.high_m) for each in theirs]
    assert [row.verdict for row in mine] == [each.change.value for each in theirs]


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
    assert sum(row.verdict != NOT_SHOWN for each in found for row in rows(each)) > 0


def test_weaker_antenna_is_found_also_by_repetitions_without_intervals():
    generator = random.Random(4)
    weaker = compare_sets([noisy(generator, 5.0)], [noisy(generator, 4.2)])
    assert weaker.is_different and weaker.counts()[NEARER] >= 6
    assert rows(weaker, AREA)[0].verdict == NEARER
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
    assert row.verdict == NEARER and row.change.high < -0.6 and row.change.low == -math.inf
    # The confidence beyond 95 % is unknown, which is not sufficient among many rows.
    assert not row.is_different and row.adjusted == pytest.approx(0.5)
    both = compare_sets([first], [first])
    assert rows(both)[0].verdict == "not known" and rows(both, AREA)[0].change.high == math.inf
    mixed = estimate([Known(None, 6.0, math.inf, (5.9, math.inf)), Known(5.0, 5.0, 5.0, (4.7, 5.3))])
    assert mixed.value is None and mixed.high == math.inf and mixed.low < 5.5


def test_area_is_that_of_the_polygon_and_its_interval_grows_with_what_lines_share():
    square = rows(compare_sets([measured.side(5.0, 5.0, 5.0, 5.0)], [measured.side(6.0, 6.0, 6.0, 6.0)]), AREA)[0]
    assert (square.first.value, square.second.value) == pytest.approx((50.0, 72.0))
    # First order: 10 m2 per m of a line, four independent ones of 0.3 m.
    assert square.first.high - 50.0 == pytest.approx(5.0 * 2 * HALF_M / 2 * 2, rel=0.15)
    assert square.change.low > 10.0 and square.is_different
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


def test_components_of_a_balanced_table_are_those_of_its_mean_squares():
    generator = np.random.default_rng(6)
    table = 5.0 + generator.normal(0.0, 0.3, (4, 1)) + generator.normal(0.0, 0.1, (4, 5))
    within = table.var(axis=1, ddof=1).mean()
    between = (5.0 * table.mean(axis=1).var(ddof=1) - within) / 5.0
    found = components(table.ravel(), {"key": [key for key in "abcd" for _ in range(5)], "place": ["hall"] * 20,
                                       "operator": [key for key in "wxyz" for _ in range(5)]})
    key, repeat = found.components
    assert (key.sigma ** 2, repeat.sigma ** 2) == pytest.approx((between, within), rel=1e-3)
    assert found.repeatability == repeat.sigma and found.mean == pytest.approx(table.mean())
    assert found.reproducibility == pytest.approx(math.sqrt(between + within), rel=1e-3)
    assert repeat.low < 0.1 < repeat.high and key.low < 0.3 < key.high
    assert [sentence.split(":")[0] for sentence in found.left_out] == ["place", "operator"]


def test_factor_without_effect_is_zero_with_an_upper_end_and_few_tests_are_no_spread():
    values = [5.0, 5.1, 4.9, 5.0, 4.9, 5.1]
    found = components(values, {"key": list("aabbcc")})
    assert found.components[0].sigma == 0.0 == found.components[0].low < found.components[0].high
    assert components([5.0, 5.1], {}).reason and components([5.0] * 4, {}).reason


def test_capability_counts_to_the_nearer_limit_in_three_sigmas():
    spread = Spread(30, 2.0, (Component("key", 3, 0.08, 0.0, 0.2), Component("repeat", 30, 0.06, 0.04, 0.09)))
    found = capability(spread, 1.5, 3.0)
    assert found.within.value == pytest.approx(0.5 / 0.18) and found.overall.value == pytest.approx(0.5 / 0.3)
    assert capability(spread, None, 2.3).overall.value == pytest.approx(1.0)
    assert capability(spread, 2.1, None).overall.value == pytest.approx(-0.1 / 0.3)
    assert capability(spread, None, None) is None and capability(components([5.0] * 4, {}), 1.0, None) is None


def test_interval_of_an_index_holds_about_as_often_as_it_says():
    generator = np.random.default_rng(3)
    held = 0
    for _ in range(400):
        values = generator.normal(2.0, 0.1, 20)
        index = capability(components(values, {}), 1.6, None).overall
        held += index.low <= 0.4 / 0.3 <= index.high
    assert 0.92 <= held / 400 <= 0.98


def test_interval_of_ppk_knows_how_few_cars_there_were():
    generator, held = np.random.default_rng(5), 0
    for _ in range(200):
        cars_m = np.repeat(generator.normal(0.0, 1.0, 3), 5)
        spread = components(cars_m + generator.normal(0.0, 0.3, 15), {"car": np.repeat(list("abc"), 5)})
        index = capability(spread, -4.0, None).overall
        held += index.low <= 4.0 / (3.0 * math.hypot(1.0, 0.3)) <= index.high
    assert held / 200 >= 0.9


def test_end_that_the_components_do_not_bound_is_open():
    spread = Spread(4, 2.0, (Component("key", 2, 0.1, 0.0, math.inf), Component("repeat", 4, 0.0, 0.0, 0.1)))
    assert capability(spread, 1.0, None) is None
    spread = replace(spread, components=(spread.components[0], Component("repeat", 4, 0.01, 0.0, 0.1)))
    overall = capability(spread, 1.0, None).overall
    assert overall.low < overall.value < overall.high and math.isfinite(overall.low)
    assert capability(spread, 1.0, None).within.high == math.inf
    assert capability_document(capability(spread, 1.0, None))["cpk"]["high"] is None


def test_trend_marks_what_is_beyond_its_limits_and_only_that():
    values = [5.0, 5.1, 4.9, 5.05, 4.95, 5.0]
    known = [Known(value, value, value, None) for value in values]
    assert trend(known).beyond == [] and trend(known).centre == pytest.approx(5.0)
    later = [*known, Known(6.0, 6.0, 6.0, None), None, *(Known(None, low, math.inf, None) for low in (6.0, 4.0))]
    found = trend(later, baseline=6)
    assert found.beyond == [6, 8] and found.high == pytest.approx(5.0 + 2.66 * np.mean(np.abs(np.diff(values))))
    assert trend(known[:3]).reason
