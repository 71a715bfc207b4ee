"""Profiles of sides from returns: unbiased levels at any noise, wheel arches, strays, and insufficient data."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_car_locator.measure.side_profile import BIN_M, outermost, profile_of, summit

RETURNS_PER_M = 20_000
ARCH_M, BEND_M, CORNER_M = 1.717, 1.86, 1.95
SEEDS = range(12)


def side_with_arches(along):
    """Shoulders of 7.6 degrees next to the arches extend to 0; sills are 20 mm inside, tyres 25 mm, corners round."""
    away = np.abs(along)
    shoulder = -math.tan(math.radians(7.6)) * (away - ARCH_M)
    bent = -0.019 - 0.6 * (away - BEND_M)
    inner = np.where(away < 0.9, -0.02, np.where(away < 1.63, -0.025, np.nan))
    return np.where(away < ARCH_M, inner, np.where(away < BEND_M, shoulder, bent))


def side_with_short_bumpers(along):
    """Sides of bumpers of 10 cm, curved, extend to 0 next to the arches; sills are 20 mm inside, tyres 25 mm."""
    away = np.abs(along)
    inner = np.where(away < 0.6, -0.02, np.where((away > 0.7) & (away < 1.38), -0.025, np.nan))
    return np.where(away < 1.42, inner, -900.0 * (away - 1.42) ** 4)


def side_with_round_bumpers(along):
    """Bumpers of a small car, superellipses 0.235 m deep, reach 0 at the arches only; sills are 20 mm inside."""
    away = np.abs(along)
    inner = np.where(away < 0.75, -0.02, np.where((away > 0.86) & (away < 1.44), -0.025, np.nan))
    share = np.clip((away - 1.55) / 0.235, 0.0, 1.0)
    return np.where(away < 1.55, inner, 0.815 * ((1.0 - share ** 2.4) ** (1.0 / 2.4) - 1.0))


def side_with_steps(along):
    """A sill at 0, with parts between the wheels that protrude by 3 cm."""
    return np.where(np.abs(np.abs(along) - 0.65) < 0.035, 0.03, 0.0)


def bumper(along):
    """A superellipse 1.8 m wide and 0.6 m deep with its tip at 0."""
    return 0.6 * ((1.0 - np.minimum(np.abs(along) / 0.9, 1.0) ** 2.8) ** (1.0 / 2.8) - 1.0)


def flat_bumper_with_slanted_corners(along):
    return -0.19 * np.maximum(np.abs(along) - 0.25, 0.0)


def returns(shape, half_m, noise_m, seed):
    rng = np.random.default_rng(seed)
    along = rng.uniform(-half_m, half_m, int(2.0 * half_m * RETURNS_PER_M))
    outward = shape(along) + rng.normal(0.0, noise_m, len(along))
    seen = np.isfinite(outward)
    return along[seen], outward[seen]


def errors(find, shape, half_m, noise_m):
    """Return levels that should be 0, and their sigmas, over the seeds."""
    found = [find(profile_of(*returns(shape, half_m, noise_m, seed))) for seed in SEEDS]
    return np.array([each.level for each in found]), np.array([each.sigma for each in found])


@pytest.mark.parametrize("noise_m", [0.005, 0.01, 0.02])
@pytest.mark.parametrize("find, shape, half_m", [(outermost, side_with_arches, CORNER_M),
                                                 (outermost, lambda along: 0.0 * along, 2.0),
                                                 (outermost, lambda along: -0.02 * np.square(along), 2.0),
                                                 (summit, bumper, 0.54),
                                                 (summit, flat_bumper_with_slanted_corners, 0.54)],
                         ids=["wheel arches", "flat side", "bent side", "round bumper", "flat bumper"])
def test_level_has_no_bias_at_any_noise(find, shape, half_m, noise_m):
    levels, sigmas = errors(find, shape, half_m, noise_m)
    assert abs(levels.mean()) < 0.0025
    assert np.abs(levels).max() < 0.004
    assert np.all(sigmas < 0.002)


def test_sigma_of_a_bumper_is_what_its_levels_scatter():
    levels, sigmas = errors(summit, bumper, 0.54, 0.02)
    assert 0.4 < levels.std() / sigmas.mean() < 1.5


def test_tyre_and_sill_do_not_pull_the_shoulder_in():
    along, outward = returns(side_with_arches, CORNER_M, 0.01, 1)
    shoulders = np.abs(along) > ARCH_M
    alone, whole = (outermost(profile_of(along[part], outward[part])) for part in (shoulders, np.ones_like(shoulders)))
    assert whole.level == pytest.approx(alone.level, abs=0.003)


def test_strays_far_off_do_not_count():
    along, outward = returns(lambda along: 0.0 * along, 1.0, 0.01, 3)
    outward[::12] += 0.09
    assert np.abs(profile_of(along, outward).level).max() < 0.004


def test_bins_that_reach_beyond_a_level_can_be_left_out():
    along, outward = returns(lambda along: np.where(np.abs(along - 0.5) < 0.07, 0.06, 0.0), 1.0, 0.01, 4)
    profile = profile_of(along, outward)
    assert outermost(profile).level > 0.04
    assert outermost(profile.below(0.03)).level == pytest.approx(0.0, abs=0.003)


def test_hardly_any_returns_tell_nothing():
    assert profile_of(np.zeros(3), np.zeros(3)) is None
    few = profile_of(*returns(lambda along: 0.0 * along, 1.5 * BIN_M, 0.01, 5))
    assert outermost(few) is None and summit(few) is None


@pytest.mark.parametrize("noise_m", [0.005, 0.01, 0.02])
def test_side_of_a_short_bumper_is_the_outermost(noise_m):
    levels, sigmas = errors(outermost, side_with_short_bumpers, 1.55, noise_m)
    assert abs(levels.mean()) < 0.005
    assert np.all(np.abs(levels) < 2.0 * sigmas)


@pytest.mark.parametrize("noise_m", [0.005, 0.01, 0.02])
def test_bumper_that_is_round_from_the_arch_on_makes_the_side_less_sure(noise_m):
    levels, sigmas = errors(outermost, side_with_round_bumpers, 1.70, noise_m)
    assert np.all(np.abs(levels) < 2.0 * sigmas) and np.all(sigmas < 0.025)


@pytest.mark.parametrize("noise_m", [0.005, 0.01, 0.02])
def test_what_stands_out_between_the_wheels_is_no_short_bumper(noise_m):
    levels, _ = errors(outermost, side_with_steps, 1.55, noise_m)
    assert np.abs(levels).max() < 0.005
