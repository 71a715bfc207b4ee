"""Autolock: the static boundary and the Car's reaction time from passes, and the speed that a budget allows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from mtr_operator.domain.estimation.interval import Interval, difference_holds
from mtr_operator.domain.estimation.passes.boundary import BoundaryCampaign, Pass
from mtr_operator.domain.estimation.passes.parts import parts_of
from mtr_operator.domain.estimation.passes.reaction import STEP_M, depths, reaction_table
from mtr_operator.domain.estimation.passes.speeds import intercept_sigma, pass_sigma, proposed_speed
from mtr_operator.domain.estimation.passes.steps import Steps
from mtr_operator.domain.estimation.passes.timing import TIMINGS, CarTiming

CYCLE_S = 0.2


def passed(rng, boundary_m, speed_mps, timing, *, delay_s=0.04, outward=False):
    """A pass simulated in time: polls with a random phase, then the bus' cycle."""
    time_s, agreeing = -rng.uniform(0.0, timing.poll_s) - (0.5 + 4.0 * timing.noise_m) / speed_mps, 0
    while agreeing < timing.debounce:
        time_s += timing.poll_s
        agreeing = agreeing + 1 if speed_mps * time_s > timing.noise_m * rng.standard_normal() else 0
    told_s = time_s + delay_s + rng.uniform(-0.5, 0.5) * CYCLE_S
    depth_m = speed_mps * told_s + 0.002 * rng.standard_normal()
    return Pass(boundary_m + depth_m if outward else boundary_m - depth_m, speed_mps, outward)


@pytest.mark.parametrize("speed_mps", [0.1, 0.5])
@pytest.mark.parametrize("timing", [CarTiming(0.3, 2, 0.012), CarTiming(0.7, 1, 0.03), CarTiming(0.1, 3, 0.005)])
def test_table_of_depths_agrees_with_passes_simulated_in_time(speed_mps, timing):
    table = reaction_table(speed_mps, CYCLE_S, 0.002)[TIMINGS.index(timing)]
    weights, rng = (table - table.min()) / np.sum(table - table.min()), np.random.default_rng(1)
    drawn = np.array([-passed(rng, 0.0, speed_mps, timing, delay_s=0.0).distance_m for _ in range(1500)])
    drawn -= speed_mps * timing.polled_s
    mean = weights @ depths()
    assert table.sum() * STEP_M == pytest.approx(1.0, abs=0.01)
    assert mean == pytest.approx(drawn.mean(), abs=4.0 * drawn.std() / math.sqrt(1500.0) + 0.001)
    assert math.sqrt(weights @ (depths() - mean) ** 2) == pytest.approx(drawn.std(), rel=0.12, abs=0.001)


@pytest.mark.parametrize("outward", [False, True])
def test_two_speeds_find_the_static_boundary_and_the_reaction_time(outward):
    rng, timing, campaign = np.random.default_rng(2), CarTiming(0.3, 2, 0.012), BoundaryCampaign(CYCLE_S)
    true_m = rng.uniform(1.0, 2.0, 24)
    for axis, boundary_m in enumerate(true_m):
        campaign.keep(axis, [passed(rng, boundary_m, speed, timing, outward=outward) for speed in (0.1, 0.4)])
    found = [campaign.boundary(axis) for axis in range(24)]
    errors = np.array([each.static.value_m for each in found]) - true_m
    assert np.sqrt(np.mean(errors ** 2)) < 0.025 and abs(np.mean(errors)) < 0.012
    assert sum(each.static.holds(value) for each, value in zip(found, true_m)) >= 21
    # Half a poll of phase and one of debounce; the delay beside them.
    assert np.median([each.reaction_s.value_m for each in found]) == pytest.approx(0.49, abs=0.1)


@pytest.mark.parametrize("timing, delay_s", [(CarTiming(0.3, 2, 0.03), 5.0), (CarTiming(0.7, 2, 0.05), 2.4)])
def test_car_that_locks_by_a_timer_is_told_from_one_that_is_slow(timing, delay_s):
    rng, held = np.random.default_rng(4), 0
    for _ in range(4):
        found = boundaries(rng, timing, [1.5] * 12, delay_s=delay_s)
        held += sum(each.static.holds(1.5) for each in found)
        assert all(each.static.half_width_m < 0.3 for each in found)
        reaction_s = np.median([each.reaction_s.value_m for each in found])
        assert reaction_s == pytest.approx(timing.polled_s + delay_s, abs=0.2)
    assert held >= 43


def test_timer_that_starts_again_is_told_by_the_last_departure():
    rng, timing, speed_mps = np.random.default_rng(8), CarTiming(0.3, 1, 0.15), 0.1
    first_m, last_m = (mean_depth(reaction_table(speed_mps, 0.0, 0.002, each)[TIMINGS.index(timing)])
                       for each in (False, True))
    drawn = np.array([last_departure(rng, speed_mps, timing) for _ in range(1500)]) - speed_mps * timing.polled_s
    error_m = 4.0 * drawn.std() / math.sqrt(1500.0)
    assert last_m == pytest.approx(drawn.mean(), abs=error_m)
    assert last_m - first_m > 2.0 * error_m


def mean_depth(table):
    weights = (table - table.min()) / np.sum(table - table.min())
    return weights @ depths()


def last_departure(rng, speed_mps, timing):
    """Depth at the poll that is the last to change the Car's mind, as many in a row as it wants."""
    step_m = speed_mps * timing.poll_s
    depths_m = np.arange(-4.0 * timing.noise_m - rng.uniform(0.0, step_m), 4.0 * timing.noise_m + 3.0 * step_m, step_m)
    gone, is_near, departed_m = depths_m > timing.noise_m * rng.standard_normal(len(depths_m)), True, math.nan
    agreeing = 0
    for depth_m, is_gone in zip(depths_m, gone):
        agreeing = agreeing + 1 if is_gone == is_near else 0
        if agreeing == timing.debounce:
            is_near, agreeing = not is_near, 0
            departed_m = departed_m if is_near else depth_m
    return departed_m


def boundaries(rng, timing, true_m, speeds_mps=(0.1, 0.4), delay_s=0.04):
    """What a campaign of passes outward says of each axis."""
    campaign = BoundaryCampaign(CYCLE_S)
    for axis, boundary_m in enumerate(true_m):
        campaign.keep(axis, [passed(rng, boundary_m, speed, timing, delay_s=delay_s, outward=True)
                             for speed in speeds_mps])
    return [campaign.boundary(axis) for axis in range(len(true_m))]


def test_campaigns_on_one_car_differ_as_the_interval_of_their_difference_says():
    rng, timing = np.random.default_rng(7), CarTiming(0.36, 2, 0.02)
    true_m = rng.uniform(1.0, 2.0, 16)
    campaigns = [boundaries(rng, timing, true_m, speeds) for speeds in 3 * ((0.1, 0.4), (0.15, 0.5))]
    agree = [difference_holds(first.static, second.static) for one, other in itertools.combinations(campaigns, 2)
             for first, second in zip(one, other)]
    assert 0.91 < np.mean(agree) < 0.985


def test_what_axes_cannot_tell_of_the_car_is_shared_by_its_campaigns_and_what_they_scatter_is_not():
    places_m = np.array([0.0, 1.0, 2.0])
    # Two timings, equally likely, one with the boundary at 0 and one at 2.
    weights = np.array([[[1.0, 0.0, 0.0]], [[0.0, 0.0, 1.0]]])
    silent = np.zeros((2, 1))
    assert parts_of(places_m, weights, [silent, silent]) == pytest.approx((1.0, 1.0))
    against = [np.array([[0.3], [0.0]]), np.array([[0.0], [0.3]])]
    common_m, shared_m = parts_of(places_m, weights, against)
    assert common_m == pytest.approx(1.0)
    # Each axis moves the mean by 0.15; two of them, and one degree of freedom less.
    assert shared_m == pytest.approx(math.sqrt(1.0 - 4.0 * 0.15 ** 2))
    assert parts_of(places_m, weights, [silent])[1] == 0.0


def test_shared_part_cancels_in_a_difference():
    first, second = Interval(1.0, 0.9, 1.1, 0.05), Interval(1.12, 1.0, 1.2, 0.05)
    assert difference_holds(first, second)
    assert not difference_holds(replace(first, shared_m=0.04), replace(second, shared_m=0.04))
    assert difference_holds(replace(first, shared_m=0.05), second)


def test_noise_of_a_single_axis_is_not_taken_for_a_timer():
    campaign = BoundaryCampaign(CYCLE_S)
    campaign.keep(1, [Pass(2.3, 0.4, True), Pass(1.3, 0.1, True)])
    assert campaign.boundary(1).reaction_s.high_m < 3.0


@pytest.mark.parametrize("noise_m", [0.1, 0.2])
def test_intervals_hold_on_a_car_whose_noise_reacts_early_at_slow_passes(noise_m):
    rng, held = np.random.default_rng(5), 0
    timing = CarTiming(0.1, 2, noise_m)
    for _ in range(4):
        campaign = BoundaryCampaign(CYCLE_S)
        for axis in range(12):
            campaign.keep(axis, [passed(rng, 1.5, speed, timing) for speed in (0.1, 0.4)])
        held += sum(campaign.boundary(axis).static.holds(1.5) for axis in range(12))
    assert held >= 44


@pytest.mark.parametrize("poll_s", [0.1, 0.7])
def test_approach_in_steps_finds_the_boundary_of_a_car_that_polls_slowly(poll_s):
    rng, steps, held = np.random.default_rng(6), Steps(0.05, 2.0), 0
    for _ in range(40):
        boundary_m, place_m = rng.uniform(1.0, 2.0), 2.5 - rng.uniform(0.0, 0.05)
        while not stood(rng, boundary_m - place_m, poll_s, steps.stand_s):
            place_m -= steps.step_m
        campaign = BoundaryCampaign(CYCLE_S)
        campaign.keep(0, [Pass(place_m, 0.0, False, steps)])
        static = campaign.boundary(0).static
        held += static.holds(boundary_m)
        assert static.half_width_m < 0.25
    assert held >= 36


def stood(rng, depth_m, poll_s, stand_s):
    """Two polls in a row notice a key that stands for a while."""
    notices = depth_m > 0.02 * rng.standard_normal(int(stand_s / poll_s))
    return any(notices[:-1] & notices[1:])


def test_one_pass_leaves_the_reaction_time_inside_the_distance():
    rng, timing, campaign = np.random.default_rng(3), CarTiming(0.3, 2, 0.012), BoundaryCampaign(CYCLE_S)
    for axis in range(12):
        campaign.keep(axis, [passed(rng, 1.5, 0.4, timing)])
    alone = campaign.boundary(0).static
    for axis in range(12):
        campaign.keep(axis, [passed(rng, 1.5, speed, timing) for speed in (0.1, 0.4)])
    assert alone.half_width_m > 2.0 * campaign.boundary(0).static.half_width_m
    assert alone.holds(1.5)


def test_proposed_speed_keeps_the_budget_for_polls_and_cycle():
    speed_mps = proposed_speed(0.01, 0.3, 0.2)
    assert pass_sigma(speed_mps, 0.3, 0.2) == pytest.approx(0.01)
    assert speed_mps == pytest.approx(0.096, abs=0.001)
    assert proposed_speed(0.01, 0.0, 0.0) == math.inf


def test_equal_speeds_say_nothing_of_the_reaction_time():
    assert intercept_sigma(0.3, 0.3, 0.3, 0.2) == math.inf
    assert intercept_sigma(0.1, 0.4, 0.3, 0.2) == pytest.approx(0.0196, abs=0.0002)
