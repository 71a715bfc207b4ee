"""Key press: posterior of distance, width and lapse, the choice of the next press, and what is recorded."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import expit, ndtr, ndtri

from mtr_operator.domain.estimation.interval import UNKNOWN, Interval, difference_holds, interval_of
from mtr_operator.domain.estimation.press.campaign import Campaign
from mtr_operator.domain.estimation.press.hypotheses import hypotheses_for
from mtr_operator.domain.estimation.press.information import PressInformation
from mtr_operator.domain.estimation.press.lattice import Lattice
from mtr_operator.domain.estimation.press.likelihood import Press, PressLikelihood
from mtr_operator.domain.estimation.press.plan import RobotTimes, SearchPlan
from mtr_operator.domain.estimation.press.posterior import RadialPosterior
from mtr_operator.domain.estimation.press.radial_estimate import Reach, estimate
from mtr_operator.domain.estimation.press.radial_search import RadialSearch
from mtr_operator.domain.estimation.press.transition import WIDTH_PER_SCALE
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

PLAN = SearchPlan(3.0, 10.0, interval_m=0.3)
LATTICE = Lattice(0.0, 0.35)


def measured(plan, works, campaign=None, radial=1):
    """A radial measured to its end; works: of a distance and the number of the press."""
    grid = plan.hypotheses()
    search = RadialSearch(plan, grid, campaign or Campaign(grid), radial, plan.maximum_m)
    while not search.is_finished():
        place_m = search.next_place_m()
        search.add(Press(place_m, works(place_m, len(search.presses))))
    return search


def posterior_of(plan, presses):
    grid = plan.hypotheses()
    likelihood, campaign = PressLikelihood(grid, plan.lattice), Campaign(grid)
    for press in presses:
        likelihood.add(press)
    return RadialPosterior(grid, likelihood.log, campaign.log_shape_prior(1), campaign.log_place_prior(1))


def test_interval_of_even_weights_leaves_one_fortieth_at_each_end():
    interval = interval_of(np.linspace(2.0, 6.0, 9), np.ones(8))
    assert (interval.value_m, interval.low_m, interval.high_m) == pytest.approx((4.0, 2.1, 5.9))
    assert interval.sigma_m == pytest.approx(4.0 / math.sqrt(12.0))


@pytest.mark.parametrize("weights", [[0.0, 0.0], [math.nan, 1.0], [math.inf, 1.0]])
def test_interval_without_a_finite_weight_is_unknown_and_holds_nothing(weights):
    interval = interval_of(np.array([0.0, 1.0, 2.0]), np.array(weights))
    assert math.isnan(interval.value_m) and not interval.holds(1.0)
    assert not difference_holds(UNKNOWN, Interval(1.0, 0.0, 2.0, 0.5))


def test_one_press_counts_as_the_curve_whatever_the_fading():
    grid = hypotheses_for(3.0, 10.0, 0.1)
    likelihood = PressLikelihood(grid, LATTICE)
    likelihood.add(Press(5.95, True))
    width_m = grid.width_m[12]
    curve = expit((grid.d50_m - 5.95) * WIDTH_PER_SCALE / width_m)
    for shared in (0, 1):
        assert np.exp(likelihood.log[shared, 0, 12]) == pytest.approx(np.maximum(curve, 1e-6), abs=2e-7)


@pytest.mark.parametrize("d50_m", [5.0, 6.5, 8.0])
def test_presses_at_one_place_share_its_fading(d50_m):
    """Against a simulation of the fading: eight successes in a place are far likelier than eight independent ones."""
    grid = hypotheses_for(3.0, 10.0, 0.05)
    likelihood = PressLikelihood(grid, LATTICE)
    for _ in range(8):
        likelihood.add(Press(5.95, True))
    column = int(np.argmin(abs(grid.width_m - 3.0)))
    row = int(np.argmin(abs(grid.d50_m - d50_m)))
    shared = grid.shared[1]
    mean = expit((grid.d50_m[row] - 5.95) * WIDTH_PER_SCALE / grid.width_m[column])
    faded = np.sqrt(shared) * np.random.default_rng(1).standard_normal(200_000)
    simulated = np.mean(ndtr((ndtri(mean) + faded) / np.sqrt(1.0 - shared)) ** 8)
    assert np.exp(likelihood.log[1, 0, column, row]) == pytest.approx(simulated, abs=0.03)
    assert np.exp(likelihood.log[0, 0, column, row]) == pytest.approx(max(mean ** 8, 1e-48), rel=1e-3)


def test_presses_half_a_wavelength_apart_are_independent():
    grid = hypotheses_for(3.0, 10.0, 0.1)
    both, first, second = (PressLikelihood(grid, LATTICE) for _ in range(3))
    for likelihood, places in ((both, (5.6, 5.95)), (first, (5.6,)), (second, (5.95,))):
        for place in places:
            likelihood.add(Press(place, place < 5.8))
    assert both.log == pytest.approx(first.log + second.log)


def test_press_beside_another_is_independent_for_noise_in_time_only():
    grid = hypotheses_for(3.0, 10.0, 0.1)
    both, single = PressLikelihood(grid, LATTICE), PressLikelihood(grid, LATTICE)
    both.add(Press(5.6, True))
    both.add(Press(5.62, True))
    single.add(Press(5.62, True))
    assert both.presses_beside(5.6) == 2 and LATTICE.place_of(5.6) == LATTICE.place_of(5.62)
    other = PressLikelihood(grid, LATTICE)
    other.add(Press(5.6, True))
    assert both.log[0] == pytest.approx(other.log[0] + single.log[0])


def test_a_hundred_presses_at_one_place_leave_finite_probabilities():
    presses = [Press(place, worked) for _ in range(50) for place, worked in ((5.8, True), (5.81, False))]
    assert np.all(np.isfinite(posterior_of(PLAN, presses).probability))


def test_press_tells_most_at_the_boundary_and_nothing_far_from_it():
    presses = [Press(place, place < 6.2) for place in 3.0 + 0.35 * np.array([0, 3, 6, 7, 8, 10, 11, 13, 17])]
    works, information = PressInformation(posterior_of(PLAN, presses)).at(np.array([3.1, 6.2, 9.9]))
    assert works[0] > 0.9 and 0.2 < works[1] < 0.8 and works[2] < 0.1
    assert np.argmax(information) == 1 and information[0] < 0.2 * information[1] > information[2]


def test_sharp_boundary_is_found_within_the_interval_wanted():
    search = measured(PLAN, lambda place_m, _: place_m <= 6.4)
    result = estimate(PLAN, search)
    assert result.reach is Reach.MEASURED
    assert result.d50.holds(6.4) and result.d50.half_width_m <= 0.4
    assert result.farthest_success_m <= 6.4 < result.nearest_failure_m
    assert result.presses <= 24 and result.holes_m == ()
    assert result.d95.value_m < result.d50.value_m


def test_search_ends_at_the_presses_allowed_with_an_honest_interval():
    rng = np.random.default_rng(3)
    plan = SearchPlan(3.0, 10.0, interval_m=0.05, attempts_limit=9)
    search = measured(plan, lambda place_m, _: rng.random() < expit(6.0 - place_m))
    result = estimate(plan, search)
    assert result.presses == 9 and result.d50.half_width_m > 0.05 and result.d50.holds(6.0)


def test_presses_before_the_boundary_is_known_lie_half_a_wavelength_apart():
    search = measured(PLAN, lambda place_m, _: place_m <= 6.4)
    places = [press.distance_m for press in search.presses[:4]]
    assert all(abs(a - b) >= 0.349 for a, b in zip(places, places[1:]))


def test_key_that_answers_nowhere_is_told_and_no_range_of_zero():
    result = estimate(PLAN, measured(PLAN, lambda *_: False))
    assert result.reach is Reach.NO_ANSWER and result.farthest_success_m is None


def test_car_that_answers_everywhere_has_a_lower_bound_only():
    result = estimate(PLAN, measured(PLAN, lambda *_: True))
    assert result.reach is Reach.FARTHER and result.nearest_failure_m is None


def test_single_lapse_is_pressed_again_and_is_no_hole():
    lapsed = []

    def works(place_m, number):
        if number > 6 and place_m < 5.9 and not lapsed:
            lapsed.append(place_m)
            return False
        return place_m <= 6.4

    result = estimate(PLAN, measured(PLAN, works))
    assert result.holes_m == () and abs(result.d50.value_m - 6.4) < 0.6


@pytest.mark.parametrize("are_near", [True, False])
def test_places_of_lines_that_end_elsewhere_say_nothing_of_the_next_one(are_near):
    grid = PLAN.hypotheses()
    campaign = Campaign(grid, are_near)
    for radial in range(2, 6):
        measured(PLAN, lambda place_m, _: place_m < 7.3, campaign, radial)
    prior = campaign.log_place_prior(1)
    assert (np.ptp(prior) > 1.0 if are_near else np.ptp(prior) == 0.0)
    # How softly lines end they have in common all the same.
    assert np.ptp(np.sum(np.exp(campaign.log_shape_prior(1)), axis=(0, 1))) > 0.1


def test_plan_of_the_axes_of_a_car_leaves_each_its_own_place():
    assert KeyPressParameters().search_plan.are_near and not HandleRequestParameters().search_plan.are_near


@pytest.mark.parametrize("seed", range(3))
def test_soft_borders_of_a_low_frequency_field_are_not_explained_by_fading(seed):
    plan, rng = HandleRequestParameters().search_plan, np.random.default_rng(seed)
    campaign = Campaign(plan.hypotheses())
    for axis in range(8):
        border_m = rng.uniform(1.4, 2.8)
        measured(plan, lambda place_m, _, border_m=border_m: rng.random() < expit(
            (border_m - place_m) * WIDTH_PER_SCALE / 0.5), campaign, axis)
    steady, fading = np.exp(campaign.log_shape_prior(9)).sum(axis=(1, 2))
    assert steady + fading == pytest.approx(1.0) and fading < 0.15


def test_failures_inside_where_all_else_works_are_told_as_a_hole():
    plan, grid = PLAN, PLAN.hypotheses()
    campaign = Campaign(grid)
    for radial in range(2, 6):
        measured(PLAN, lambda place_m, _: place_m < 7.3, campaign, radial)
    search = RadialSearch(plan, grid, campaign, 1, 10.0)
    for place_m in (9.3, 8.6, 7.2, 7.55, 6.85, 7.2, 7.55, 6.5, 6.15, 5.8):
        search.add(Press(place_m, place_m < 7.3))
    search.add(Press(4.05, False))
    assert not search.is_finished() and search.next_place_m() == 4.05
    search.add(Press(4.05, False))
    assert search.next_place_m() == 4.05
    search.add(Press(4.05, False))
    assert estimate(plan, search).holes_m == (4.05,)


@pytest.mark.parametrize("rows", [
    ((5.45, 4, 4), (5.8, 4, 4), (6.15, 1, 4), (6.5, 5, 6), (6.85, 1, 6), (7.2, 0, 6)),
    ((5.45, 6, 6), (5.8, 6, 6), (6.15, 2, 5), (6.5, 6, 6), (6.85, 3, 6), (7.2, 0, 6))])
def test_failures_within_the_interval_of_the_boundary_are_not_a_hole(rows):
    """Rows: distance, presses that worked, presses."""
    grid = PLAN.hypotheses()
    search = RadialSearch(PLAN, grid, Campaign(grid), 1, 10.0)
    for distance_m, worked, count in rows:
        for number in range(count):
            search.add(Press(distance_m, number < worked))
    assert estimate(PLAN, search).holes_m == ()


def test_robot_that_stops_a_little_beside_the_place_presses_there_again_nevertheless():
    """The key stands some millimetres off, each time another way."""
    grid = PLAN.hypotheses()
    search = RadialSearch(PLAN, grid, Campaign(grid), 1, 10.0)
    for place_m in (9.3, 8.6, 7.2, 7.55, 6.85, 7.2, 7.55, 6.5, 6.15, 5.8):
        search.add(Press(place_m, place_m < 7.3))
    for place_m in (4.056, 4.047, 4.053):
        assert not search.is_finished()
        search.add(Press(place_m, False))
        again_m = search.next_place_m()
        assert (search.place_of(again_m) == search.place_of(4.05)) is (place_m != 4.053)
    assert estimate(PLAN, search).holes_m == pytest.approx((4.052,))


def test_radials_share_what_they_know_of_the_width():
    rng = np.random.default_rng(5)
    grid = PLAN.hypotheses()
    campaign = Campaign(grid)
    alone = np.exp(campaign.log_shape_prior(9))
    for radial in range(6):
        measured(PLAN, lambda place_m, _: rng.random() < expit((6.0 - place_m) * WIDTH_PER_SCALE), campaign, radial)
    together = np.exp(campaign.log_shape_prior(9))
    assert together.sum() == pytest.approx(1.0)
    spread = [float(np.sqrt(np.cov(np.log(grid.width_m), aweights=shape.sum(axis=(0, 1)))))
              for shape in (alone, together)]
    assert spread[1] < 0.6 * spread[0]


def test_slow_robot_does_not_press_where_it_happens_to_be_though_little_is_told_there():
    rng, plan = np.random.default_rng(4), SearchPlan(3.0, 20.0, interval_m=0.3, times=RobotTimes(speed_mps=0.1))
    grid = plan.hypotheses()
    search = RadialSearch(plan, grid, Campaign(grid), 1, 20.0)
    shares = []
    while not search.is_finished():
        place_m, summary = search.next_place_m(), PressInformation(search.posterior())
        here, best = (np.max(summary.at(places)[1]) for places in (np.array([place_m]), plan.places_m()))
        shares.append(here / best)
        search.add(Press(place_m, bool(rng.random() < expit((9.0 - place_m) * WIDTH_PER_SCALE))))
    assert len(shares) > 10 and np.median(shares) > 0.6


def test_radial_unlike_the_others_is_not_argued_away():
    grid = PLAN.hypotheses()
    campaign = Campaign(grid)
    for radial in range(8):
        measured(PLAN, lambda place_m, _: place_m <= 8.0, campaign, radial)
    result = estimate(PLAN, measured(PLAN, lambda place_m, _: place_m <= 4.2, campaign, 8))
    assert result.d50.holds(4.2)


def test_intervals_of_a_soft_boundary_hold_it():
    rng = np.random.default_rng(7)
    plan = SearchPlan(3.0, 10.0, interval_m=0.4, attempts_limit=16)
    grid = plan.hypotheses()
    campaign, found = Campaign(grid), []
    for radial in range(20):
        d50_m = rng.uniform(5.0, 8.0)
        found.append((d50_m, measured(plan, lambda place_m, _, d50_m=d50_m: rng.random() < expit(
            (d50_m - place_m) * WIDTH_PER_SCALE), campaign, radial)))
    held = [estimate(plan, search).d50.holds(d50_m) for d50_m, search in found]
    assert sum(held) >= 17


def test_good_fit_and_bad_fit_are_told_apart():
    good = [Press(place, place < 6.2) for place in 3.0 + 0.35 * np.array([3, 6, 7, 8, 10, 11, 13])]
    grid = PLAN.hypotheses()
    searches = []
    for presses in (good, [*good, *[Press(3.0 + 0.35 * number, False) for number in range(4)]]):
        search = RadialSearch(PLAN, grid, Campaign(grid), 1, 10.0)
        for press in presses:
            search.add(press)
        searches.append(estimate(PLAN, search).quality)
    assert searches[0] > 0.3 > searches[1]
