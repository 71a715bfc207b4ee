"""Uncertainties of the weighing against numerical derivatives, and the limits of accepted readings."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_commissioning.calibration.balance.comparison import optimistic, relative_sigma
from mtr_commissioning.calibration.balance.estimate import Balance, balance_of, limit_mps2, line_through
from mtr_commissioning.calibration.balance.readings import (
    BLOCK_SIGMA_M,
    LEAST_RISE_M,
    TILT_SIGMA_DEG,
    Chassis,
    Height,
    Level,
    Raised,
    Tilt,
)
from mtr_commissioning.calibration.readings import Estimate, ReadingsUnusable

CHASSIS = Chassis(0.262, 0.376, 0.098)
LEVEL = Level(13.0, 12.0, 12.0, 13.0)


def height(rise_m, front_kg, step_kg=0.0):
    return Raised(0.35, rise_m, front_kg, 25.0 - front_kg).height(CHASSIS, 25.0, 0.004, step_kg)


@pytest.mark.parametrize("step_kg", [0.0, 0.005, 0.5])
def test_uncertainty_of_a_height_is_what_step_and_block_make_of_it(step_kg):
    middle = height(0.05, 9.0).centre_m
    of_load = abs(height(0.05, 9.0 + 1e-6).centre_m - middle) / 1e-6 * step_kg / math.sqrt(12.0)
    of_block = abs(height(0.05 + 1e-6, 9.0).centre_m - middle) / 1e-6 * BLOCK_SIGMA_M
    assert height(0.05, 9.0, step_kg).sigma_m == pytest.approx(math.hypot(of_load, of_block),
                                                               rel=0.01 if step_kg > 0.1 else 0.05)


@pytest.mark.parametrize("across", [False, True])
@pytest.mark.parametrize("angle_deg", [5.0, 25.0, 45.0])
def test_uncertainty_of_a_tilted_height_is_what_the_angle_makes_of_it(angle_deg, across):
    middle, moved = (Tilt(0.35, angle, across).height(CHASSIS, 0.01, -0.02)
                     for angle in (angle_deg, angle_deg + 1e-6))
    slope = abs(moved.centre_m - middle.centre_m) / 1e-6
    assert middle.sigma_m == pytest.approx(slope * TILT_SIGMA_DEG, rel=1e-3)


@pytest.mark.parametrize(("spread", "scaled"), [(0.2, "unscaled"), (2.5, True)])
def test_line_has_the_uncertainty_of_a_weighted_fit(spread, scaled):
    sigmas = (0.002, 0.004, 0.003, 0.002, 0.005)
    keys = (0.35, 0.35, 0.9, 1.55, 1.55)
    signs = (1.0, -1.0, 0.5, -1.0, 1.0)
    heights = [Height(key, 0.27 + 0.05 * key + spread * sign * sigma, sigma)
               for key, sign, sigma in zip(keys, signs, sigmas)]
    fit, covariance = np.polyfit(keys, [each.centre_m for each in heights], 1, w=1.0 / np.array(sigmas), cov=scaled)
    low, rise = line_through(heights)
    assert (rise.value, low.value) == pytest.approx(tuple(fit))
    assert (rise.sigma, low.sigma) == pytest.approx(tuple(np.sqrt(np.diag(covariance))))
    assert low.freedom == rise.freedom == 3.0


def test_heights_of_the_key_may_be_as_close_as_the_least_travel():
    line_through([Height(key, 0.3, 0.001) for key in (0.0, 0.0, 0.3, 0.3)])
    with pytest.raises(ReadingsUnusable):
        line_through([Height(key, 0.3, 0.001) for key in (0.0, 0.0, 0.299, 0.299)])


def test_place_is_as_sure_as_a_step_of_the_scales_when_all_weighings_agree():
    tilts = [Tilt(key, 25.0, False) for key in (0.35, 0.35, 1.0, 1.0)]
    step_kg = 0.1
    found = balance_of(CHASSIS, [LEVEL, LEVEL], [], tilts, step_kg)
    stepped = Level(13.0 + 0.5 * step_kg, 12.0 - 0.5 * step_kg, 12.0 + 0.5 * step_kg, 13.0 - 0.5 * step_kg)
    for estimate, place in ((found.ahead, Level.ahead_m), (found.left, Level.left_m)):
        of_step_m = place(stepped, CHASSIS) - place(LEVEL, CHASSIS)
        assert estimate.sigma == pytest.approx(of_step_m / math.sqrt(12.0))
    assert found.mass.sigma == pytest.approx(step_kg / math.sqrt(12.0))


BALANCE = Balance(CHASSIS, Estimate(25.0, 0.05, 2.0), Estimate(0.005, 0.0004, 2.0), Estimate(-0.02, 0.0007, 2.0),
                  Estimate(0.28, 0.0006, 2.0), Estimate(0.06, 0.0005, 2.0))
MEASURED = {name: each.value for name, each in BALANCE.parameters().items()}


@pytest.mark.parametrize("lever", ["tip_lever_along_m", "tip_lever_across_m"])
@pytest.mark.parametrize("key_height_m", [0.35, 1.55])
def test_uncertainty_of_the_limit_is_what_each_parameter_makes_of_it(lever, key_height_m):
    limit = limit_mps2(MEASURED, lever, key_height_m)
    parts = [limit_mps2({**MEASURED, name: each.value + each.sigma}, lever, key_height_m) / limit - 1.0
             for name, each in BALANCE.parameters().items()]
    assert relative_sigma(BALANCE, lever, key_height_m) == pytest.approx(math.sqrt(sum(part ** 2 for part in parts)),
                                                                        rel=0.02)


@pytest.mark.parametrize(("sigmas", "is_named"), [(0.9, False), (1.1, True)])
def test_description_is_named_from_one_sigma_on(sigmas, is_named):
    share = relative_sigma(BALANCE, "tip_lever_along_m", 1.55)
    described = {**MEASURED, "tip_lever_along_m": MEASURED["tip_lever_along_m"] * (1.0 + sigmas * share)}
    assert bool(optimistic(BALANCE, described, [1.55])) is is_named


def test_limit_is_the_levers_share_of_gravity():
    described = {"centre_of_mass_m": 0.3, "centre_of_mass_rise": 0.05, "tip_lever_along_m": 0.2}
    assert limit_mps2(described, "tip_lever_along_m", 2.0) == pytest.approx(9.81 * 0.2 / 0.4)


def test_loads_may_differ_by_two_percent_and_have_to_be_loads():
    Level(60.0, 40.0, 50.0, 48.0)
    Level(0.25, 0.25, 0.25, 0.25)
    for loads in ((60.0, 40.0, 50.0, 47.9), (0.0, 0.0, 0.0, 0.0), (-5.0, -5.0, -5.0, -5.0)):
        with pytest.raises(ReadingsUnusable, match="they may differ by 2 %"):
            Level(*loads)


def raised(front_kg, rise_m=0.02, mass_kg=25.0, ahead_m=0.03):
    return Raised(0.35, rise_m, front_kg, mass_kg - front_kg).height(CHASSIS, mass_kg, ahead_m, 0.005)


def test_front_wheels_have_to_carry_a_quarter_of_their_load():
    raised(3.9)
    raised(3.0, mass_kg=24.0, ahead_m=0.0)
    with pytest.raises(ReadingsUnusable, match=r"carry 3\.8 kg of 15\.4 kg"):
        raised(3.8)


def test_rise_may_be_the_least_one_and_is_told_in_millimetres():
    raised(12.0, rise_m=LEAST_RISE_M)
    with pytest.raises(ReadingsUnusable, match="were 12 mm higher; at least 15 mm"):
        raised(12.0, rise_m=0.012)


@pytest.mark.parametrize("angle_deg", [1.0, 60.0])
def test_ends_of_the_angle_are_accepted(angle_deg):
    assert Tilt(0.35, angle_deg, False).height(CHASSIS, 0.0, 0.0).centre_m > 0.0
