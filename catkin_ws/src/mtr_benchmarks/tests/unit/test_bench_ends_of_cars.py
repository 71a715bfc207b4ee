"""Short form of the benchmark of the Car's ends, with its random Cars and its counts."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binom

from mtr_benchmarks.localization.ends.bodies import FRONT_INSET_M, REAR_INSET_M, drawn_car
from mtr_benchmarks.localization.ends.coverage import SIDES, EndErrors, by_kind, ends_of_seed, rows
from mtr_benchmarks.localization.ends.views import cast, view_of

# These seeds were chosen before the first fit. Every random number depends on the seed, so that the counts are the same
# in each run.
SEEDS = range(40001, 40037)
EXACT = EndErrors(1, "both bumpers; nothing known", *4 * (0.0,), *4 * (0.01,))


@pytest.fixture(scope="module")
def found():
    return [ends_of_seed(seed) for seed in SEEDS]


def test_every_car_is_located(found):
    assert all(each is not None for each in found)


@pytest.mark.parametrize("side", SIDES)
def test_intervals_hold_95_percent_of_the_sides(found, side):
    """Fewer covered sides than the limit occur by chance in one of ten thousand consistent samples."""
    held = sum(each.is_held(side) for each in found)
    assert held >= binom.ppf(1e-4, len(found), 0.95)


@pytest.mark.parametrize("side", ("front", "rear"))
def test_sigmas_of_the_ends_are_not_larger_than_the_errors_are(found, side):
    """With sigmas that are twice too large, normalised errors have a mean square of 0.25."""
    squares = [(each.error_m(side) / each.sigma_m(side)) ** 2 for each in found]
    assert 0.4 < np.mean(squares) < 1.6


def test_known_size_and_axles_tell_both_ends_to_a_centimetre(found):
    known = [each for each in found if "size and axles known" in each.kind]
    assert len(known) >= 5
    assert max(each.sigma_m(side) for each in known for side in ("front", "rear")) < 0.012


def test_distances_are_never_too_short_from_ends_that_no_data_sheet_tells(found):
    plain = [each for each in found if each.kind == "both bumpers; nothing known"]
    assert plain and max(each.error_m(side) for each in plain for side in ("front", "rear")) < 0.01


def test_cars_are_drawn_with_ends_that_have_nothing_to_do_with_each_other():
    cars = [drawn_car(seed) for seed in range(1, 601)]
    insets_m = np.array([(car.front_inset_m, car.rear_inset_m) for car in cars])
    assert np.all(insets_m >= 0.0) and np.all(insets_m <= (FRONT_INSET_M[1], REAR_INSET_M[1]))
    # The correlation of independent values has a standard deviation of 0.04.
    assert abs(np.corrcoef(insets_m.T)[0, 1]) < 0.16
    assert len({(car.front_seen, car.rear_seen, bool(car.sheet.known_length_m), bool(car.sheet.front_overhang_m))
                for car in cars}) == 16
    assert all(car.length_m - car.wheelbase_m - car.front_overhang_m >= 0.4 for car in cars)


def test_bumper_is_seen_where_it_is_drawn():
    car = next(car for car in map(drawn_car, range(1, 100)) if car.front_seen and car.rear_seen)
    points = view_of(car.segments, car.length_m, car.width_m, 1).close_up.points
    middle = points[np.abs(points[:, 1]) < 0.1, 0]
    assert np.median(middle[middle > 0.0]) == pytest.approx(0.5 * car.length_m - car.front_inset_m, abs=0.005)
    assert np.median(middle[middle < 0.0]) == pytest.approx(car.rear_inset_m - 0.5 * car.length_m, abs=0.005)


def test_beam_meets_the_nearest_segment_or_none():
    wall = np.array([[2.0, -1.0, 2.0, 1.0], [3.0, -1.0, 3.0, 1.0]])
    directions = np.array([[1.0, 0.0], [-1.0, 0.0], [math.sqrt(0.5), math.sqrt(0.5)]])
    assert cast(np.zeros(2), directions, wall) == pytest.approx([2.0, math.inf, math.inf])


def table(*cars):
    return {row.requirement.name.partition(": ")[2]: row for row in rows(cars)}


def test_rows_are_met_by_intervals_that_are_neither_too_narrow_nor_too_wide():
    missed = replace(EXACT, front_error_m=0.02)
    honest = table(*[EXACT] * 95, *[missed] * 5)
    assert honest["front in its 95 % interval"].is_met and honest["front, not too wide"].is_met
    assert not honest["rear, not too wide"].is_met and honest["left, not too wide"].is_met
    assert not table(*[EXACT] * 92, *[missed] * 8)["front in its 95 % interval"].is_met
    assert not table(*[EXACT] * 97, None, None, None)["located"].is_met
    assert not any(row.is_met for name, row in table().items() if not name.startswith(("left", "right")))


def test_figures_are_those_of_each_kind_of_car():
    figures = by_kind([EXACT, replace(EXACT, kind="wheels; size known", rear_error_m=0.03)])
    assert figures["both bumpers; nothing known"]["rear"] == {"held": 1.0, "median_sigma_m": 0.01, "rms_error_m": 0.0}
    assert figures["wheels; size known"]["rear"]["held"] == 0.0
