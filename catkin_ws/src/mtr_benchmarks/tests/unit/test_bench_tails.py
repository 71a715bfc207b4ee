"""Comparison of delays with and without a condition."""
# SPDX-License-Identifier: Apache-2.0
import random

import pytest

from mtr_benchmarks.harness.tails import Turn, percentile, ratio_of


def turns(factor, busy=lambda _: 1.0, count=10):
    chance = random.Random(5)
    return [Turn([busy(turn) * chance.uniform(1.0, 2.0) for _ in range(50)],
                 [factor * busy(turn) * chance.uniform(1.0, 2.0) for _ in range(50)]) for turn in range(count)]


def test_what_costs_nothing_is_told_from_one_that_costs_three_times_as_much():
    nothing, much = ratio_of(turns(1.0)), ratio_of(turns(3.0))
    assert nothing.low <= 1.0 <= nothing.high < 1.2 and much.value == pytest.approx(3.0, rel=0.1)
    assert much.low > 2.5 and much.with_s > 2.5 * much.without_s


def test_busy_machine_falls_on_both_and_widens_the_interval():
    busy = ratio_of(turns(1.0, lambda turn: 10.0 if turn % 3 == 0 else 1.0))
    assert busy.value == pytest.approx(1.0, rel=0.15) and busy.low <= 1.0 <= busy.high


def test_percentile_of_nothing_is_refused():
    assert percentile([3.0, 1.0, 2.0], 0.99) == 3.0
    with pytest.raises(ValueError):
        percentile([], 0.5)
