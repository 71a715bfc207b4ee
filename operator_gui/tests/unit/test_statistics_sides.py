"""Means over the lines of a side: common errors, passes at the same speeds, and one family of comparisons."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import random

import driven
import measured
import numpy as np
import pytest

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.history.estimate import Known, estimate
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.history.statistics.difference import Change, difference
from mtr_operator.history.statistics.multiplicity import holm
from mtr_operator.history.statistics.row import AREA, DISTANCE, SIDE
from mtr_operator.history.statistics.same_passes import Events, events_of, moved
from mtr_operator.history.statistics.side_means import mean_of
from mtr_operator.history.statistics.sides import sides_of

LEFT = range(11, 16)
# Noise of a fast and of a slow pass.
NOISES_M = (0.14, 0.1)


def rows(comparison, quantity=SIDE):
    return {f"{row.name.split(' (')[0]} {row.word}": row for row in comparison.rows if row.quantity == quantity}


def noisy(generator, weaker_m=0.0, shift_m=0.0, **changes):
    """Return a test with boundaries at 1.5 and 2.5 m, less weaker_m on the left side and shift_m everywhere."""
    def events_m(axis, word):
        border_m = {"unlock": 1.5, "lock": 2.5}[word] - (weaker_m if axis in LEFT else 0.0) - shift_m
        return [border_m + late_m + generator.gauss(0.0, noise_m) for late_m, noise_m in zip((-0.1, 0.0), NOISES_M)]
    return driven.side(events_m, **changes)


def drawn(generator, tests, lines=5, noises_m=NOISES_M, of_test_m=0.0):
    late_m = generator.normal(0.0, 0.3, len(noises_m))
    shifts_m = generator.normal(0.0, of_test_m, (tests, 1))
    return [[Events(2.0 + late_m + shifts_m + generator.normal(0.0, noises_m, (tests, len(noises_m))))
             for _ in range(lines)] for _ in range(2)]


def test_holm_with_weights_gives_a_part_its_share():
    assert holm([0.02, 0.01, 0.5, 0.5], [0.5, 0.1, 0.2, 0.2]) == pytest.approx([0.04, 0.05, 1.0, 1.0])
    chances = [0.01, 0.04, 0.03, 0.005]
    assert holm(chances, [7.0] * 4) == pytest.approx(holm(chances))


def test_all_quantities_are_one_family():
    found = compare_sets([measured.side(5.0, 5.0, 5.0, 5.0)], [measured.side(5.0, 5.0, 5.0, 3.85)])
    line = rows(found, DISTANCE)["radial 4 press"]
    assert line.adjusted == pytest.approx(line.difference.chance * (4 + 1) * 2, rel=1e-6)
    assert [row.is_leading for row in found.rows if row.quantity != DISTANCE] == [True, False]


def test_sides_are_those_through_which_lines_leave_the_car():
    found = {side.name: side.numbers for side in sides_of(driven.axes(), driven.CAR)}
    assert found == {"right side": (3, 4, 5, 6, 7), "left side": tuple(LEFT), "all lines": tuple(range(1, 17))}
    lines = SCENARIOS["key_press"].lines(measured.parameters(8), measured.CAR)
    found = {side.name: len(side.numbers) for side in sides_of(lines, measured.CAR)}
    assert found == {"right side": 3, "left side": 3, "all lines": 8}


def test_mean_keeps_what_lines_have_alike_and_averages_their_own():
    own, coherent = 0.2, 0.1
    half = 1.959964 * math.hypot(own, coherent)
    found = mean_of([Known(value, value, value, (value - half, value + half), coherent, 0.05, 0.02)
                     for value in (1.0, 2.0, 3.0, 4.0)])
    assert found.value == 2.5 and (found.coherent, found.shared, found.alike) == pytest.approx((0.1, 0.05, 0.02))
    assert found.ends[1] - 2.5 == pytest.approx(1.959964 * math.hypot(own / 2.0, coherent))
    assert mean_of([Known(None, 6.0, math.inf, (5.9, math.inf)), Known(5.0, 5.0, 5.0, (4.7, 5.3))]).ends[1] == math.inf


def test_what_both_sides_have_alike_leaves_their_difference():
    alone, alike = 0.1, 0.3
    half = 1.959964 * math.hypot(alone, alike)
    known = [Known(value, value, value, (value - half, value + half), alike, alike, alike) for value in (5.0, 5.5)]
    found = difference(*(estimate([each]) for each in known))
    assert found.high - 0.5 == pytest.approx(1.959964 * alone * math.sqrt(2.0))
    other = [dataclasses.replace(each, alike=0.0) for each in known]
    assert difference(*(estimate([each]) for each in other)).high - 0.5 == pytest.approx(half * math.sqrt(2.0))


@pytest.mark.parametrize("tests, split, noises_m", [(2, 1, NOISES_M), (2, 1, (0.05, 0.1, 0.3)), (6, 3, NOISES_M)])
def test_interval_of_same_passes_holds_in_95_of_100(tests, split, noises_m):
    generator = np.random.default_rng(8)
    held = 0
    for _ in range(1000):
        *_, found = moved(drawn(generator, tests, noises_m=noises_m), split, 0.0)
        held += found.low <= 0.0 <= found.high
    # If the spread of the sets replaces the noise of the passes by chance, slightly more intervals miss.
    assert 0.93 <= held / 1000 <= 0.97


def test_tests_of_a_set_that_differ_more_than_their_passes_count_by_their_spread():
    generator = np.random.default_rng(9)
    held = sum(found.low <= 0.0 <= found.high for found in (
        moved(drawn(generator, 10, of_test_m=0.2), 5, 0.0)[2] for _ in range(300)))
    assert held / 300 >= 0.9
    narrow = moved(drawn(generator, 10), 5, 0.0)[2]
    lasting = moved(drawn(generator, 10), 5, 0.5)[2]
    assert lasting.high - lasting.low > 1.959964 * 2.0 * 0.5 * math.sqrt(2.0) > narrow.high - narrow.low


def test_passes_are_compared_at_the_same_speeds_only():
    def result(speeds_mps, distances_m=(1.0, 2.0, 3.0)):
        made = driven.side(lambda _axis, _word: distances_m[:len(speeds_mps)], speeds_mps=speeds_mps)
        return made.progress.results[0]
    both = events_of([result((0.4, 0.13)), result((0.13, 0.39, 0.7))], "unlock")
    assert both.distances_m.tolist() == [[1.0, 2.0], [2.0, 1.0]]
    assert events_of([result((0.4, 0.13)), result((0.4, 0.2))], "unlock") is None
    # A pass in steps has no speed; a second pass at the same speed is not matched with the other test.
    assert events_of([result((0.4, 0.0)), result((0.4, 0.0))], "unlock") is None
    assert events_of([result((0.4, 0.4, 0.13)), result((0.4, 0.13))], "unlock").distances_m[0].tolist() == [1.0, 3.0]


def test_weaker_antenna_moves_its_side_and_no_other():
    generator = random.Random(2)
    found = compare_sets([noisy(generator) for _ in range(3)], [noisy(generator, weaker_m=0.2) for _ in range(3)])
    sides = rows(found)
    left = sides["left side unlock and lock"]
    assert left.change is Change.NEARER and left.is_different
    assert left.difference.value == pytest.approx(-0.2, abs=0.08)
    assert not sides["right side unlock and lock"].is_different


def test_chance_alone_makes_a_difference_in_at_most_5_of_100_comparisons_of_single_tests():
    generator = random.Random(11)
    different = sum(compare_sets([noisy(generator)], [noisy(generator)]).is_different for _ in range(100))
    # With an error rate of 5 %, 9 or more of 100 occur with a probability of 6 %.
    assert different <= 8


def test_outline_is_alike_for_the_same_car_only_and_as_far_as_it_was_mapped_alike():
    def width(second, name="left side unlock", quantity=SIDE):
        change_of = rows(compare_sets([noisy(random.Random(1))], [second]), quantity)[name].difference
        return change_of.high - change_of.low
    same = noisy(random.Random(2))
    other = noisy(random.Random(2), identity=Identity(car_model="Polo"))
    nobody = noisy(random.Random(2), identity=Identity())
    wider = noisy(random.Random(2), car=dataclasses.replace(driven.CAR, width=1.84))
    assert width(same) < width(wider) < width(other) and width(other) == pytest.approx(width(nobody))
    assert width(same, "axis 13 unlock", DISTANCE) < width(other, "axis 13 unlock", DISTANCE)


def test_area_has_the_timing_of_the_car_alike_on_all_lines():
    found = rows(compare_sets([noisy(random.Random(1))], [noisy(random.Random(2))]), AREA)["area unlock"].first
    # The area grows by at least its perimeter per metre, and the perimeter is longer than the one of the Car.
    assert (found.high - found.low) / 2.0 > 1.959964 * driven.COMMON_M * 2.0 * (4.5 + 1.8)


def test_side_that_is_farther_is_so_by_key_presses_too():
    found = rows(compare_sets([measured.side(*[5.0] * 8, lines=8)], [measured.side(*[5.6] * 8, lines=8)]))
    assert found["left side press"].change is Change.FARTHER and found["left side press"].is_different
    assert found["all lines press"].difference.value == pytest.approx(0.6)
