"""Key press: a radial with a hole inside its range is no radial with one boundary beyond the hole."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import expit

from mtr_operator.domain.estimation.press.campaign import Campaign
from mtr_operator.domain.estimation.press.likelihood import Press
from mtr_operator.domain.estimation.press.one_boundary import Uneven, are_uneven, parts_m, uneven
from mtr_operator.domain.estimation.press.plan import SearchPlan
from mtr_operator.domain.estimation.press.radial_estimate import estimate
from mtr_operator.domain.estimation.press.radial_search import RadialSearch
from mtr_operator.domain.estimation.press.transition import WIDTH_PER_SCALE
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.scenarios.line_search.campaign import with_estimate

PLAN = SearchPlan(3.0, 18.5, interval_m=0.3, half_wavelength_m=0.173, checked_m=12.0)
EDGES = parts_m(3.0, 18.5)
RESULT = KeyPressResult(1, 0.0, LineStatus.OK, 5.0, 6.0, 0.002, 24, 1.0, "", method="adaptive", place_sigma_m=0.002)


def falling(width_m, d50_m=11.0):
    return lambda place_m: expit((d50_m - place_m) * WIDTH_PER_SCALE / width_m)


def holed(hole_m, island_m, share):
    """Works up to a hole, and by a share on an island from there to its end."""
    return lambda place_m: (0.98 if place_m < hole_m[0] else 0.01 if place_m < hole_m[1]
                            else share if place_m < island_m else 0.0)


def measured(share_at, seed, plan=PLAN, campaign=None, radial=1):
    chance, grid = np.random.default_rng(seed), plan.hypotheses()
    search = RadialSearch(plan, grid, campaign or Campaign(grid), radial, plan.maximum_m)
    while not search.is_finished():
        place_m = search.next_place_m()
        search.add(Press(place_m, bool(chance.random() < share_at(place_m))))
    return search


def test_each_part_in_which_a_hole_is_possible_gets_a_press_within_those_allowed():
    search = measured(falling(1.0), 1)
    pressed = [press.distance_m for press in search.presses]
    assert all(any(low_m <= place_m < high_m for place_m in pressed)
               for low_m, high_m in zip(EDGES, EDGES[1:]) if low_m < PLAN.checked_m)
    assert len(pressed) <= PLAN.attempts_limit


def test_where_no_hole_is_possible_none_is_looked_for():
    plain = measured(falling(1.0), 1, replace(PLAN, checked_m=0.0))
    assert len(plain.presses) < len(measured(falling(1.0), 1).presses)
    assert plain.uneven() is None


@pytest.mark.parametrize(("hole_m", "island_m", "share"), [
    ((5.0, 8.0), 12.0, 0.3), ((5.0, 8.0), 14.0, 0.5), ((6.0, 8.0), 12.0, 0.4), ((4.5, 7.0), 11.0, 0.35)])
def test_interval_of_a_radial_with_a_hole_holds_the_nearest_boundary(hole_m, island_m, share):
    """Several radials of one Car, as a null of the ground makes them."""
    grid = PLAN.hypotheses()
    campaign = Campaign(grid)
    searches = [measured(holed(hole_m, island_m, share), seed, campaign=campaign, radial=seed) for seed in range(4)]
    for search in searches:
        search.uneven()
    told = [with_estimate(PLAN, RESULT, estimate(PLAN, search)) for search in searches]
    assert all((result.d50_low_m or 0.0) <= hole_m[0] <= (result.d50_high_m or 99.0) for result in told)
    assert share < 0.5 or all(result.boundaries == "several" and result.findings for result in told)


@pytest.mark.parametrize("width_m", [0.4, 1.0, 2.2, 4.0])
def test_falling_radial_has_one_boundary(width_m):
    searches = [measured(falling(width_m), seed) for seed in range(6)]
    assert sum(search.uneven() is not None for search in searches) <= 1


@pytest.mark.parametrize(("probabilities", "is_uneven"), [
    ([], False), ([0.01], False), ([0.01, 0.02], True), ([0.01, 0.5, 0.5], False), ([0.01, 0.05] + 8 * [0.5], True),
    ([0.01, 0.05] + 9 * [0.5], False), ([1.0] * 8, False)])
def test_several_rare_radials_show_that_no_radial_of_the_car_falls(probabilities, is_uneven):
    assert are_uneven(probabilities) is is_uneven


def test_hole_is_told_from_the_last_press_that_worked_before_it_to_the_first_beyond():
    presses = [*(Press(place_m, True) for place_m in (3.2, 4.1, 5.3, 9.2, 10.4)),
               *(Press(place_m, False) for place_m in (6.2, 7.1, 8.4, 12.0, 13.0, 15.0))]
    found = uneven(presses, EDGES)
    assert found.hole_m == (5.3, 9.2) and found.low_m < 5.5 and found.high_m > 9.2
    assert uneven([Press(4.0, False), Press(9.2, True)], EDGES).hole_m == (None, 9.2)
    wide = uneven(presses, EDGES, 3.0)
    assert wide.low_m <= found.low_m and wide.high_m >= found.high_m


def test_limit_at_least_is_not_passed_by_an_island_and_d95_tells_no_lower_end():
    search = measured(falling(1.0), 1)
    found = replace(estimate(PLAN, search), uneven=Uneven(5.0, 12.0, (5.1, 8.0)))
    told = with_estimate(PLAN, RESULT, found)
    assert told.d50_low_m == pytest.approx(5.0, abs=0.01) and told.d50_high_m == pytest.approx(12.0, abs=0.01)
    assert (told.d95_m, told.d95_low_m) == (None, None)
    assert (told.boundaries, told.hole_from_m, told.hole_to_m) == ("several", 5.1, 8.0)
    assert "a hole from 5.10 to 8.00 m" in told.findings[0]
    open_end = with_estimate(PLAN, RESULT, replace(found, uneven=Uneven(3.0, 18.5, None)))
    assert (open_end.d50_low_m, open_end.d50_high_m, open_end.hole_to_m) == (None, None, None)


@pytest.mark.parametrize(("mhz", "height_m", "end_m"), [(433.92, 1.0, 5.79), (868.0, 1.0, 11.58), (315.0, 1.0, 4.20),
                                                        (868.0, 0.5, 5.79)])
def test_holes_are_looked_for_up_to_the_outermost_null_of_the_ground(mhz, height_m, end_m):
    plan = KeyPressParameters(key_frequency_hz=1e6 * mhz, key_height_m=height_m).search_plan
    assert plan.checked_m == pytest.approx(end_m, abs=0.01)
