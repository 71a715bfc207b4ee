"""Key press: the distances of this very line, with the fading that stays in its place."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.special import expit

from mtr_operator.domain.estimation.interval import interval_of_draws
from mtr_operator.domain.estimation.press.campaign import Campaign
from mtr_operator.domain.estimation.press.likelihood import Press, PressLikelihood
from mtr_operator.domain.estimation.press.line_boundary import LineBoundary, Places
from mtr_operator.domain.estimation.press.plan import SearchPlan
from mtr_operator.domain.estimation.press.posterior import RadialPosterior
from mtr_operator.domain.estimation.press.radial_search import RadialSearch
from mtr_operator.domain.estimation.press.transition import D95_PER_SCALE, SIGMA_PER_SCALE, WIDTH_PER_SCALE

PLAN = SearchPlan(3.0, 10.0, interval_m=0.3)
APART_M = PLAN.half_wavelength_m
DRAWS = 2000


def measured(presses, grid=None):
    """Posterior of the mean curve, and the line's own boundary."""
    grid = PLAN.hypotheses() if grid is None else grid
    likelihood, campaign = PressLikelihood(grid, APART_M, PLAN.minimum_m), Campaign(grid)
    pressed = {}
    for press in presses:
        likelihood.add(press)
        pressed.setdefault(likelihood.place_of(press.distance_m), []).append(press)
    posterior = RadialPosterior(grid, likelihood.log, campaign.log_shape_prior(1), campaign.log_place_prior(1))
    return posterior, LineBoundary(posterior, Places(pressed, PLAN.minimum_m, APART_M), DRAWS)


def with_shape(width_m, shared):
    """A grid on which nothing but d50 is open."""
    grid = PLAN.hypotheses()
    return replace(grid, width_m=np.full(len(grid.width_m), width_m), lapse=np.zeros(2), shared=np.full(2, shared))


def test_interval_of_draws_is_that_of_their_quantiles():
    interval = interval_of_draws(np.linspace(0.0, 1.0, 1001))
    assert (interval.low_m, interval.value_m, interval.high_m) == pytest.approx((0.025, 0.5, 0.975))
    assert interval.sigma_m == pytest.approx(1.0 / math.sqrt(12.0), rel=0.01)


def test_without_fading_it_is_the_mean_curve():
    presses = [Press(3.0 + APART_M * place, place < 8) for place in (2, 5, 6, 7, 8, 9, 12)]
    posterior, line = measured(presses, with_shape(1.0, 0.0))
    mean, d50, d95 = posterior.d50(), line.d50(), line.d95()
    assert (d50.low_m, d50.value_m, d50.high_m) == pytest.approx((mean.low_m, mean.value_m, mean.high_m), abs=0.04)
    offset_m = D95_PER_SCALE / WIDTH_PER_SCALE
    assert d50.value_m - d95.value_m == pytest.approx(offset_m, abs=0.04)


def test_sharp_end_lies_between_its_presses_although_fading_hides_the_mean_curve():
    presses = [Press(3.0 + APART_M * place, place < 8) for place in (2, 5, 6, 7, 7, 7, 8, 8, 8, 9, 12)]
    posterior, line = measured(presses, with_shape(0.6, 0.85))
    worked_m, failed_m = 3.0 + APART_M * 7, 3.0 + APART_M * 8
    assert worked_m - 0.05 <= line.d50().low_m and line.d50().high_m <= failed_m + 0.05
    assert posterior.d50().half_width_m > 1.5 * line.d50().half_width_m


def test_press_where_the_line_is_known_tells_little_and_one_at_its_end_much():
    presses = [Press(3.0 + APART_M * place, place < 8) for place in (5, 6, 7, 7, 7, 8, 8, 8, 9)]
    _, line = measured(presses, with_shape(0.6, 0.85))
    works, told = line.information(np.array([3.0, 3.0 + APART_M * 7.5, 10.0]))
    assert works[0] > 0.97 and works[2] < 0.03
    assert told[1] > 5.0 * max(told[0], told[2], 0.01)


def test_same_presses_give_the_same_interval():
    presses = [Press(5.0, True), Press(6.0, False), Press(5.7, True)]
    assert measured(presses)[1].d50() == measured(presses)[1].d50()


@pytest.mark.parametrize("shared", [0.0, 0.85])
def test_intervals_hold_the_lines_own_distances(shared):
    """Lines of the model; 95 % of 150 would be 143, and 130 or fewer are rarer than one time in ten thousand."""
    chance, width_m = np.random.default_rng(4), 1.6
    fading_m = math.sqrt(shared) * SIGMA_PER_SCALE * width_m / WIDTH_PER_SCALE
    own_m = math.sqrt(1.0 - shared) * width_m
    distances_m = np.arange(1.0, 12.0, 0.02)
    grid, held = with_shape(width_m, shared), np.zeros(2, int)
    for _ in range(150):
        where = (distances_m - PLAN.minimum_m) / APART_M
        before, part = np.floor(where).astype(int), where - np.floor(where)
        fading = chance.standard_normal(60)
        mixed = ((1.0 - part) * fading[before] + part * fading[before + 1]) / np.hypot(1.0 - part, part)
        boundary_m = chance.uniform(5.0, 8.0) + fading_m * mixed
        works = expit((boundary_m - distances_m) * WIDTH_PER_SCALE / own_m)
        truth_m = [distances_m[np.argmax(np.cumsum(works - level))] for level in (0.5, 0.95)]
        places_m = 3.0 + APART_M * chance.choice(20, 10, replace=False)
        _, line = measured([Press(float(place_m), bool(chance.random() < np.interp(place_m, distances_m, works)))
                            for place_m in places_m], grid)
        held += [line.d50().holds(truth_m[0]), line.d95().holds(truth_m[1])]
    assert min(held) > 130


def test_place_just_beyond_the_boundary_that_failed_once_is_pressed_again_before_a_radial_ends():
    """Where presses are lost now and then, one there would be a wrong end."""
    grid = PLAN.hypotheses()
    campaign = Campaign(grid)
    for radial in range(8):
        other, is_lost = RadialSearch(PLAN, grid, campaign, radial, PLAN.maximum_m), radial % 3 == 0
        while not other.is_finished():
            place_m = other.next_place_m()
            worked = place_m < 6.2 + 0.1 * radial
            other.add(Press(place_m, worked and not is_lost))
            is_lost = is_lost and not worked
    search = RadialSearch(PLAN, grid, campaign, 9, PLAN.maximum_m)
    for place_m in (9.3, 8.25, 7.2, 5.8, 6.15, 6.5, 6.5, 6.5, 6.15, 6.85):
        assert not search.is_finished()
        search.add(Press(place_m, place_m < 6.7))
    assert search.boundary().d50().half_width_m <= PLAN.interval_m
    assert not search.is_finished() and search.next_place_m() == 6.85
    search.add(Press(6.85, False))
    assert search.is_finished()
