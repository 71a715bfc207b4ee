"""Capability, components and trend: intervals hold as often as they state; open ends remain open."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import measured
import numpy as np
import pytest

from mtr_operator.domain.estimation.components import Component, Spread, components
from mtr_operator.history.estimate import Known
from mtr_results.statistics.capability import capability
from mtr_results.statistics.documents import capability_document
from mtr_results.statistics.trend import trend

HALF_M = measured.HALF_M


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
