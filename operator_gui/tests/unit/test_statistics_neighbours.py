"""Adjacent lines that have moved together: error rate and power of the test."""
# SPDX-License-Identifier: Apache-2.0
import math
import random

import driven
import numpy as np
import pytest

from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.history.statistics.difference import Change
from mtr_operator.history.statistics.neighbours import moved_most
from mtr_operator.history.statistics.row import NEIGHBOURS, SIDE
from mtr_operator.history.statistics.same_passes import Events

# Five axes of Autolock on each long side.
SIDES = (tuple(range(3, 8)), tuple(range(11, 16)))
# Noise of a fast and of a slow pass, by word.
NOISES_M = ((0.14, 0.1), (0.19, 0.15))


def events(generator, tests=2, moved_m=None, *, split=1, of_test_m=0.0, lines=range(1, 17)):
    """Return events of all axes. moved_m: shift of the second set, by line."""
    shifts_m = generator.normal(0.0, of_test_m, (tests, 1)) if of_test_m else np.zeros((tests, 1))
    second = (np.arange(tests) >= split)[:, None]
    return {line: [Events(2.0 + shifts_m + second * (moved_m or {}).get(line, 0.0)
                          + generator.normal(0.0, noises_m, (tests, 2))) for noises_m in NOISES_M] for line in lines}


@pytest.mark.parametrize("tests, split", [(2, 1), (6, 3)])
def test_largest_of_all_runs_is_called_different_in_5_of_100_where_nothing_moved(tests, split):
    generator = np.random.default_rng(3)
    found = [moved_most(events(generator, tests), SIDES, split, 0.0) for _ in range(600)]
    assert 0.03 <= np.mean([each.difference.chance <= 0.05 for each in found]) <= 0.07
    assert all((each.low > 0.0 or each.high < 0.0) == (each.chance < 0.05) for each in (
        one.difference for one in found) if abs(each.chance - 0.05) > 1e-3)


def test_lines_that_moved_together_are_found_where_the_mean_of_their_side_hides_them():
    generator = np.random.default_rng(4)
    weaker = {12: -0.3, 13: -0.2, 14: -0.25}
    found = [moved_most(events(generator, moved_m=weaker), SIDES, 1, 0.0) for _ in range(100)]
    assert sum(each.difference.chance <= 0.04 for each in found) >= 80
    assert sum(each.numbers == (12, 13, 14) for each in found) >= 40
    assert all(set(each.numbers) & set(weaker) for each in found if each.difference.chance <= 0.04)


def test_all_lines_together_are_a_run():
    generator = np.random.default_rng(5)
    found = moved_most(events(generator, moved_m={line: 0.3 for line in range(1, 17)}), SIDES, 1, 0.0)
    assert found.numbers == tuple(range(1, 17)) and found.difference.chance < 0.001
    assert found.second.value - found.first.value == pytest.approx(found.difference.value)


def test_lines_on_both_sides_of_one_that_is_not_known_are_no_neighbours():
    known = [line for line in range(1, 17) if line != 13]
    found = moved_most(events(np.random.default_rng(6), moved_m={12: -0.9, 14: -0.9}, lines=known), SIDES, 1, 0.0)
    assert found.numbers in ((11, 12), (14, 15))
    one = events(np.random.default_rng(6), lines=[4])
    assert moved_most(one, SIDES, 1, 0.0) is None
    assert moved_most({}, SIDES, 1, 0.0) is None


def test_what_a_test_has_alike_for_all_lines_counts_beside_the_noise():
    generator = np.random.default_rng(7)
    apart = [moved_most(events(generator, 8, of_test_m=0.2, split=4), SIDES, 4, 0.0) for _ in range(200)]
    assert np.mean([each.difference.chance <= 0.05 for each in apart]) <= 0.1
    same = events(generator)
    narrow, wide = (moved_most(same, SIDES, 1, lasting) for lasting in (0.0, 0.5))
    assert wide.difference.high - wide.difference.low > 2.0 * 1.959964 * 0.5 * math.sqrt(2.0) > narrow.difference.high


def test_comparison_names_the_lines_and_gives_them_most_of_the_family_s_chance():
    generator = random.Random(11)

    def side(weaker_m):
        return driven.side(lambda axis, word: [
            {"unlock": 1.5, "lock": 2.5}[word] - (weaker_m if axis in (12, 13, 14) else 0.0) + generator.gauss(0.0, 0.1)
            for _ in range(2)])
    found = compare_sets([side(0.0)], [side(0.5)])
    (row,) = (row for row in found.rows if row.quantity == NEIGHBOURS)
    assert row.name.startswith("most moved together: axis 12") and "axis 14" in row.name
    assert row.word == "unlock and lock"
    assert row.is_different and row.change is Change.NEARER
    assert [each.is_leading for each in found.rows].count(True) == 1 and row.is_leading
    # Three fifths of the 5 %; the factor is smaller if other rows come first in Holm's order.
    assert row.difference.chance < row.adjusted <= row.difference.chance / 0.6 + 1e-9
    assert any(each.quantity == SIDE for each in found.rows)
