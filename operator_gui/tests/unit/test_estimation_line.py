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
from mtr_operator.domain.estimation.press.fading_draws import FadingDraws, explaining
from mtr_operator.domain.estimation.press.lattice import Lattice
from mtr_operator.domain.estimation.press.likelihood import Press, PressLikelihood
from mtr_operator.domain.estimation.press.line_boundary import LineBoundary
from mtr_operator.domain.estimation.press.plan import SearchPlan
from mtr_operator.domain.estimation.press.posterior import RadialPosterior
from mtr_operator.domain.estimation.press.radial_search import RadialSearch
from mtr_operator.domain.estimation.press.transition import D95_PER_SCALE, SIGMA_PER_SCALE, WIDTH_PER_SCALE

PLAN = SearchPlan(3.0, 10.0, interval_m=0.3)
# Presses between the places are wanted.
FINE = replace(PLAN, interval_m=0.1)
APART_M = PLAN.half_wavelength_m
DRAWS = 2000


def measured(presses, grid=None, draws=DRAWS):
    """Posterior of the mean curve, and the line's own boundary."""
    grid = PLAN.hypotheses() if grid is None else grid
    likelihood, campaign = PressLikelihood(grid, PLAN.lattice), Campaign(grid)
    for press in presses:
        likelihood.add(press)
    posterior = RadialPosterior(grid, likelihood.log, campaign.log_shape_prior(1), campaign.log_place_prior(1))
    return posterior, LineBoundary(posterior, presses, PLAN.lattice, draws)


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


def line_of_the_model(width_m, shared, chance):
    """Distances, and the share of presses that works there: its fading is a sum of waves, as on the way to a Car."""
    distances_m, waves = np.arange(1.0, 12.0, 0.02), 48
    turns_per_m = math.pi / APART_M * chance.uniform(-1.0, 1.0, waves)
    angles = np.multiply.outer(distances_m, turns_per_m) + chance.uniform(0.0, 2.0 * math.pi, waves)
    fading = math.sqrt(2.0 / waves) * np.sum(np.cos(angles), axis=1)
    fading_m = math.sqrt(shared) * SIGMA_PER_SCALE * width_m / WIDTH_PER_SCALE
    boundary_m = chance.uniform(5.0, 8.0) + fading_m * fading
    return distances_m, expit((boundary_m - distances_m) * WIDTH_PER_SCALE / (math.sqrt(1.0 - shared) * width_m))


def held_of(lines, width_m, shared, places_of):
    """How many intervals of d50 and of d95 hold a line's own; places_of: the presses of a line, given its d50."""
    chance, grid, held = np.random.default_rng(4), with_shape(width_m, shared), np.zeros(2, int)
    for _ in range(lines):
        distances_m, works = line_of_the_model(width_m, shared, chance)
        truth_m = [distances_m[np.argmax(np.cumsum(works - level))] for level in (0.5, 0.95)]
        _, line = measured([Press(float(place_m), bool(chance.random() < np.interp(place_m, distances_m, works)))
                            for place_m in places_of(truth_m[0], chance)], grid, 1000)
        held += [line.d50().holds(truth_m[0]), line.d95().holds(truth_m[1])]
    return held


@pytest.mark.parametrize("shared", [0.0, 0.85])
def test_intervals_hold_the_lines_own_distances(shared):
    """Lines of the model; 95 % of 150 would be 143, and 130 or fewer are rarer than one time in ten thousand."""
    held = held_of(150, 1.6, shared, lambda _, chance: 3.0 + APART_M * chance.choice(20, 10, replace=False))
    assert min(held) > 130


def test_presses_between_two_places_do_not_tell_a_wrong_width():
    """Taken as made at their nearest place they left 5 of these 8 campaigns with an interval that held the width."""
    grid, held = PLAN.hypotheses(), 0
    for seed in range(100, 108):
        chance, campaign = np.random.default_rng(seed), Campaign(grid)
        for radial in range(24):
            distances_m, works = line_of_the_model(1.0, 0.88, chance)
            end_m = distances_m[np.argmax(np.cumsum(works - 0.5))]
            likelihood = PressLikelihood(grid, FINE.lattice)
            for place_m in [*PLAN.places_m()[1::2], *np.clip(end_m + chance.uniform(-0.4, 0.4, 16), 3.0, 10.0)]:
                works_here = 0.98 * np.interp(place_m, distances_m, works)
                likelihood.add(Press(float(place_m), bool(chance.random() < works_here)))
            campaign.keep_evidence(radial, RadialPosterior(grid, likelihood.log, campaign.log_shape_prior(99),
                                                           campaign.log_place_prior(99)).log_evidence)
        below = np.cumsum(np.sum(np.exp(campaign.log_shape_prior(99)), axis=(0, 1)))
        low_m, high_m = np.interp([0.025, 0.975], below, grid.width_m)
        held += bool(low_m <= 1.0 <= high_m)
    # 6 or fewer of 8 come by chance in 6 % of such sets if 95 % hold, 5 or fewer in 0.6 %.
    assert held >= 7


def test_intervals_wanted_below_half_a_wavelength_hold():
    plan, chance = SearchPlan(3.0, 10.0, 0.1, 24), np.random.default_rng(70)
    grid = plan.hypotheses()
    campaign, searched = Campaign(grid), []
    for radial in range(16):
        distances_m, works = line_of_the_model(1.0, 0.88, chance)
        search = RadialSearch(plan, grid, campaign, radial, plan.maximum_m)
        while not search.is_finished():
            place_m = search.next_place_m()
            search.add(Press(place_m, bool(chance.random() < 0.98 * np.interp(place_m, distances_m, works))))
        searched.append((distances_m[np.argmax(np.cumsum(works - 0.5))], search))
    for _, search in searched:
        search.revisit()
    assert any(plan.lattice.is_between(press.distance_m) for _, search in searched for press in search.presses)
    held = sum(search.boundary().d50().holds(truth_m) for truth_m, search in searched)
    # 12 or fewer of 16 come by chance in 0.7 % of such campaigns if 95 % hold.
    assert held >= 13


def test_press_between_two_places_narrows_the_line_as_draws_of_the_model_do():
    """Against many draws of the same hypotheses, weighted by how well they explain the presses."""
    lattice, numbers, shape = Lattice(0.0, APART_M), np.arange(-3, 12), (0.6, 0.02, 0.85)
    presses = [Press(1.2, True), Press(1.5, True), Press(1.55, False), Press(1.65, True), Press(1.65, True),
               Press(1.9, False)]

    def drawn(count, chance):
        return FadingDraws(chance.uniform(1.0, 2.0, count), *(np.full(count, value) for value in shape),
                           chance.standard_normal((count, len(numbers))))

    def boundary_m(draws):
        return draws.d50_m + draws.fading_m * (draws.fading @ lattice.weights(np.array([1.6]), numbers))[:, 0]

    many = drawn(200_000, np.random.default_rng(1))
    weights = lattice.weights(np.array([press.distance_m for press in presses]), numbers)
    likely = np.ones(len(many.d50_m))
    for press, column in zip(presses, weights.T):
        beyond_m = many.d50_m + many.fading_m * (many.fading @ column) - press.distance_m
        works = (1.0 - many.lapse) * expit(beyond_m * WIDTH_PER_SCALE / many.own_width_m)
        likely *= works if press.worked else 1.0 - works
    mean_m = likely @ boundary_m(many) / np.sum(likely)
    sigma_m = math.sqrt(likely @ (boundary_m(many) - mean_m) ** 2 / np.sum(likely))
    chance = np.random.default_rng(2)
    found = boundary_m(explaining(drawn(2000, chance), presses, [True] * len(presses), weights, chance))
    assert np.mean(found) == pytest.approx(mean_m, abs=0.02)
    assert np.std(found) == pytest.approx(sigma_m, rel=0.2)


def test_press_between_two_places_is_left_to_the_lines_own_end():
    grid = PLAN.hypotheses()
    likelihood = PressLikelihood(grid, FINE.lattice)
    likelihood.add(Press(6.5 + APART_M / 2.0, True))
    assert not likelihood.log.any() and likelihood.presses_beside(6.5 + APART_M / 2.0) == 1


def test_press_counts_at_its_nearest_place_where_no_finer_interval_is_wanted():
    coarse = PressLikelihood(PLAN.hypotheses(), PLAN.lattice)
    coarse.add(Press(6.5 + 0.4 * APART_M, True))
    assert coarse.log.any() and not PLAN.is_fine and FINE.is_fine


def test_fading_between_places_is_that_of_both_sides_and_correlated_by_the_sinc():
    lattice, numbers = Lattice(1.0, 0.5), np.arange(-40, 41)
    weights = lattice.weights(np.array([1.0, 1.2, 1.25]), numbers)
    assert weights[:, 0] == pytest.approx((numbers == 0).astype(float), abs=1e-12)
    assert weights[:, 1] @ weights[:, 0] == pytest.approx(np.sinc(0.4), abs=0.01)
    assert weights[:, 1] @ weights[:, 2] == pytest.approx(np.sinc(0.1), abs=0.01)
    assert np.sum(weights ** 2, axis=0) == pytest.approx(np.ones(3))
    assert [lattice.is_between(distance_m) for distance_m in (1.0, 1.04, 1.06, 1.25, 1.46)] == [
        False, False, True, True, False]


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
