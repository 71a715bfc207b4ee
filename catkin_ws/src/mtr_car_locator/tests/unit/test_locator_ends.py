"""Front and rear of a Car with different bumper insets in the scan plane: each with a consistent sigma."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math

import numpy as np
import pytest
from locator_surfels import LENGTH_M, ORIGIN, WIDTH_M, box, prior, surfels

from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.measure.axles import Axles
from mtr_car_locator.measure.data_sheet import warning_of
from mtr_car_locator.measure.ends import EndEvidence, Estimate, ends_of
from mtr_car_locator.measure.measurement import ends_in
from mtr_car_locator.measure.overhangs import ends_on
from mtr_car_locator.measure.side import SideExtent
from mtr_car_locator.parameters import DataSheet, LocatorParameters
from mtr_core.se2 import Pose2

FRONT_SIGMA_M, REAR_SIGMA_M = DataSheet().front_inset_sigma_m, DataSheet().rear_inset_sigma_m
ORDINARY = Estimate(4.5, 0.87)
LEVEL_SIGMA_M = 0.003
# Insets of front and rear in m; the last two are cars among the models of osrf/gazebo_models.
INSETS_M = [(0.0, 0.03), (0.01, 0.06), (0.06, 0.0), (0.0, 0.0), (0.03, 0.03), (0.01, 0.12), (0.105, 0.014),
            (0.221, 0.015)]


def fit_of(front_inset_m, rear_inset_m, **sheet):
    """Return the fit of a box in the scan plane of a Car that is longer by the insets; its centre is the origin."""
    pose = Pose2(0.5 * (rear_inset_m - front_inset_m), 0.0, 0.0)
    in_plane = box(pose, length=LENGTH_M - front_inset_m - rear_inset_m)
    return fit_car(surfels(in_plane), prior(0.1, 0.1, 0.03), LocatorParameters(sheet=DataSheet(**sheet)))


def ends_of_fit(fit):
    """Return errors outwards and sigmas of front and rear."""
    x, half = fit.rectangle.pose.x, 0.5 * fit.rectangle.length
    return ((x + half - 0.5 * LENGTH_M, fit.side_sigmas.front), (half - x - 0.5 * LENGTH_M, fit.side_sigmas.rear))


@pytest.mark.parametrize("insets_m", INSETS_M)
@pytest.mark.parametrize("sheet", [{}, {"known_length_m": LENGTH_M}], ids=["unknown", "length"])
def test_both_ends_lie_within_two_of_their_sigmas(insets_m, sheet):
    for error_m, sigma_m in ends_of_fit(fit_of(*insets_m, **sheet)):
        assert abs(error_m) < 2.02 * sigma_m


@pytest.mark.parametrize("insets_m", INSETS_M)
def test_known_length_leaves_half_of_the_missing_length_unsure_and_no_more(insets_m):
    missing_m = sum(insets_m)
    for _, sigma_m in ends_of_fit(fit_of(*insets_m, known_length_m=LENGTH_M)):
        assert 0.2 * missing_m < sigma_m < 0.3 * missing_m + 0.01


@pytest.mark.parametrize("insets_m", INSETS_M)
def test_distances_from_an_end_that_no_data_sheet_tells_are_never_too_short(insets_m):
    for error_m, _ in ends_of_fit(fit_of(*insets_m)):
        assert error_m < 0.005


def test_outline_reaches_both_ends_where_the_centre_is_not_midway_between_the_bumpers():
    fit = fit_of(0.105, 0.014, known_length_m=LENGTH_M)
    along = [x for x, _ in fit.outline]
    assert max(along) == pytest.approx(0.5 * LENGTH_M) and min(along) == pytest.approx(-0.5 * LENGTH_M)
    # Surfels are at their measured places, in the frame of the published Car.
    seen = fit.rectangle.pose.x + fit.surfels.position[:, 0]
    assert seen.max() == pytest.approx(0.5 * LENGTH_M - 0.105, abs=0.01)
    assert seen.min() == pytest.approx(0.014 - 0.5 * LENGTH_M, abs=0.01)


@pytest.mark.parametrize("sheet", [{}, {"known_length_m": LENGTH_M}, {"known_width_m": WIDTH_M}])
@pytest.mark.parametrize("sides", [("front", "left", "right"), ("rear", "left"), ("front", "rear", "left", "right")])
def test_sigmas_of_sides_follow_from_those_of_centre_and_size(sides, sheet):
    fit = fit_car(surfels(box(sides=sides)), prior(), LocatorParameters(sheet=DataSheet(**sheet)))
    front, rear, left, right = fit.side_sigmas
    assert 0.5 * (front ** 2 + rear ** 2) == pytest.approx(fit.sigmas[0] ** 2 + 0.25 * fit.length_sigma ** 2)
    assert 0.5 * (left ** 2 + right ** 2) == pytest.approx(fit.sigmas[1] ** 2 + 0.25 * fit.width_sigma ** 2)


def evidence(level_m, inset_sigma_m, by_axle=None):
    return EndEvidence(SideExtent(level_m, LEVEL_SIGMA_M), inset_sigma_m, by_axle)


def test_intervals_of_a_known_length_hold_insets_from_their_prior():
    chance = np.random.default_rng(7)
    held = np.zeros((600, 2), dtype=bool)
    for row in held:
        front_m, rear_m = abs(chance.normal(0.0, FRONT_SIGMA_M)), abs(chance.normal(0.0, REAR_SIGMA_M))
        noise = chance.normal(0.0, LEVEL_SIGMA_M, 2)
        ends = ends_of(evidence(2.25 - front_m + noise[0], FRONT_SIGMA_M),
                       evidence(2.25 - rear_m + noise[1], REAR_SIGMA_M), ORDINARY, 4.5 + chance.normal(0.0, 0.005))
        row[:] = (abs(ends.front_m - 2.25) <= 1.96 * ends.front_sigma_m,
                  abs(ends.rear_m + 2.25) <= 1.96 * ends.rear_sigma_m)
    # One standard deviation of 95 % is 0.9 %. Insets of a known sum are nearly uniform, so 1.96 standard deviations
    # contain slightly more than 95 %.
    assert np.all(held.mean(axis=0) > 0.95 - 0.027) and np.all(held.mean(axis=0) < 0.995)


def test_axle_and_overhang_tell_the_front_and_with_the_length_the_rear():
    by_axle = Estimate(2.25, 0.006)
    alone = ends_of(evidence(2.15, FRONT_SIGMA_M, by_axle), evidence(2.24, REAR_SIGMA_M), ORDINARY)
    known = ends_of(evidence(2.15, FRONT_SIGMA_M, by_axle), evidence(2.24, REAR_SIGMA_M), ORDINARY, 4.5)
    assert (alone.front_m, alone.rear_m) == (2.25, -2.24)
    assert alone.front_sigma_m == 0.006 and alone.rear_sigma_m == pytest.approx(REAR_SIGMA_M, rel=0.01)
    assert known.front_m == pytest.approx(2.25, abs=0.003) and known.rear_m == pytest.approx(-2.25, abs=0.003)
    assert 0.003 < known.front_sigma_m < 0.007 and 0.004 < known.rear_sigma_m < 0.009


def test_plane_that_is_longer_than_the_data_sheet_leaves_both_ends_unsure_by_half_of_it():
    ends = ends_of(evidence(2.30, FRONT_SIGMA_M), evidence(2.25, REAR_SIGMA_M), ORDINARY, 4.5)
    assert 0.025 < ends.front_sigma_m < 0.04 and 0.025 < ends.rear_sigma_m < 0.04


@pytest.mark.parametrize("beyond_m", [0.05, 0.2])
def test_bumper_beyond_the_front_of_the_data_sheet_is_contradictory(beyond_m):
    for is_axle_sure in (False, True):
        seen, near = (evidence(level_m, FRONT_SIGMA_M, Estimate(2.25, 0.006)) for level_m in (2.25 + beyond_m, 2.26))
        assert seen.contradiction_m(is_axle_sure=is_axle_sure) == pytest.approx(beyond_m)
        assert near.contradiction_m(is_axle_sure=is_axle_sure) == 0.0


# Level of the bumper ahead of the origin, and front from the front axle and an overhang of 0.9 m.
@pytest.mark.parametrize(("axle_m", "front_m", "wheelbase_m"), [
    (1.35, 2.25, 0.0), (1.35, 2.25, 2.7), (1.50, 2.40, 0.0), (1.9, 2.15, 0.0), (1.9, 2.8, 2.7), (1.1, 2.15, 2.7)])
def test_front_by_an_axle_that_the_bumper_contradicts_is_not_used(axle_m, front_m, wheelbase_m):
    extents = {"front": SideExtent(2.15, LEVEL_SIGMA_M), "rear": SideExtent(2.25, LEVEL_SIGMA_M)}
    sheet = DataSheet(front_overhang_m=0.9, wheelbase_m=wheelbase_m)
    ends = ends_in(extents, Axles(axle_m, axle_m - 2.7, 0.004, 0.004), sheet)
    assert ends.front_m == pytest.approx(front_m, abs=0.002)
    assert bool(ends.front_beyond_m) is (front_m == 2.15)
    assert ("front_overhang_m" in warning_of(extents, ends, sheet)) is (front_m != 2.25)


# Length, wheelbase and front overhang from makers' data sheets, or with a typical overhang of the class: two large
# saloons, a pick-up, an executive saloon, a compact car, the smallest class, a delivery van.
CARS = [(5.38, 2.91, 1.09), (5.20, 2.86, 1.05), (5.36, 3.22, 0.95), (4.92, 2.94, 0.84), (4.28, 2.62, 0.88),
        (3.395, 2.52, 0.47), (4.89, 3.00, 0.91)]


@pytest.mark.parametrize("car", CARS)
@pytest.mark.parametrize("sheet", [(), ("known_length_m",), ("front_overhang_m",),
                                   ("known_length_m", "front_overhang_m")])
def test_ends_by_the_wheels_alone_hold_makers_cars(car, sheet):
    known = dict(zip(("known_length_m", "wheelbase_m", "front_overhang_m"), car))
    ends = ends_on(Axles(1.4, 1.4 - car[1], 0.004, 0.004), DataSheet(**{name: known[name] for name in sheet}))
    front_m = 1.4 + car[2]
    assert abs(ends.front_m - front_m) < 2.5 * ends.front_sigma_m
    assert abs(ends.rear_m - (front_m - car[0])) < 2.5 * ends.rear_sigma_m
    assert abs(ends.length_m - car[0]) < 2.5 * ends.length_sigma_m
    assert (ends.front_sigma_m < 0.01) == ("front_overhang_m" in sheet)
    assert ends.rear_sigma_m < (0.012 if len(sheet) == 2 else 0.3)


@pytest.mark.parametrize("names", itertools.combinations(("known_length_m", "front_overhang_m"), 1))
def test_what_is_measured_of_a_car_on_its_wheels_makes_both_ends_no_less_sure(names):
    axles, known = Axles(1.4, -1.4, 0.004, 0.004), {"known_length_m": 4.6, "front_overhang_m": 0.9}
    vague, better = ends_on(axles, DataSheet()), ends_on(axles, DataSheet(**{name: known[name] for name in names}))
    assert better.front_sigma_m < vague.front_sigma_m and better.rear_sigma_m < vague.rear_sigma_m
    assert math.isfinite(better.centre_sigma_m) and better.centre_sigma_m < vague.centre_sigma_m


def test_located_car_is_where_it_stands():
    assert fit_of(0.02, 0.02).rectangle.pose.distance_to(ORIGIN) < 0.003
