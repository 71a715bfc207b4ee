"""Fit of the Car to given surfels: other objects nearby, unseen sides, choice between two candidates."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from locator_surfels import LENGTH_M, ORIGIN, PARAMETERS, SIGMA_M, STEP_M, WIDTH_M, box, prior, surfels

from mtr_car_locator.find.errors import NotLocated
from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.parameters import DataSheet, LocatorParameters
from mtr_core.se2 import Pose2


def error_of(fit, actual=ORIGIN):
    """Return distance in m and angle in rad between fit and truth."""
    at = actual.inverse() @ fit.rectangle.pose
    return math.hypot(at.x, at.y), abs(at.heading)


@pytest.mark.parametrize("guess", [(0.9, -0.5, 0.1), (-0.7, 0.7, -0.3), (0.0, -1.0, 0.34)])
@pytest.mark.parametrize("actual", [Pose2(0.0, 0.0, 0.0), Pose2(3.0, -2.0, 2.0)])
def test_car_seen_from_all_sides_is_exact_wherever_it_stands(guess, actual):
    turned = actual @ Pose2(*guess)
    fit = fit_car(surfels(box(actual)), prior(turned.x, turned.y, turned.heading), PARAMETERS)
    off_m, off_rad = error_of(fit, actual)
    assert off_m < 0.003 and math.degrees(off_rad) < 0.1
    assert fit.rectangle.length == pytest.approx(LENGTH_M, abs=0.006)
    assert fit.rectangle.width == pytest.approx(WIDTH_M, abs=0.006)


def test_errors_are_as_large_as_the_sigmas_say():
    squares = []
    for seed in range(40):
        fit = fit_car(surfels(box(seed=seed)), prior(0.2, 0.1, 0.05), PARAMETERS)
        at = fit.rectangle.pose
        squares.append(np.square(np.array([at.x, at.y, at.heading]) / fit.sigmas))
    # The sigma of a map is common to neighbours and does not average out; here it does, so the errors are smaller. The
    # sigma along the Car includes insets of its ends, which a box does not have.
    assert np.all(np.mean(squares, axis=0) < 1.5)
    assert np.all(np.mean(squares, axis=0)[1:] > 0.005)


@pytest.mark.parametrize("sides, unseen", [(("front", "left"), ("rear", "right")),
                                           (("rear", "right"), ("front", "left")),
                                           (("front", "left", "rear"), ("right",))])
def test_unseen_sides_are_placed_by_the_expected_size_and_say_so(sides, unseen):
    fit = fit_car(surfels(box(sides=sides)), prior(0.3, -0.2, 0.1), PARAMETERS)
    assert set(fit.seen) == set(sides)
    assert error_of(fit)[0] < 0.01
    assert fit.width_sigma > 0.08 and fit.sigmas[1] > 0.04
    assert (fit.length_sigma > 0.3) == ("rear" in unseen or "front" in unseen)


@pytest.mark.parametrize("sides, size", [
    (("front", "left", "rear"), {"width": 1.4}), (("front", "left", "rear"), {"width": 2.2}),
    (("front", "left"), {"length": 3.1})])
def test_sigmas_hold_what_an_unseen_side_of_an_ordinary_car_may_be_off(sides, size):
    fit = fit_car(surfels(box(sides=sides, **size)), prior(0.3, -0.2, 0.1), PARAMETERS)
    at, sigmas = fit.rectangle.pose, (fit.length_sigma, fit.width_sigma, *fit.sigmas[:2])
    errors = (fit.rectangle.length - size.get("length", LENGTH_M), fit.rectangle.width - size.get("width", WIDTH_M),
              at.x, at.y)
    assert max(map(abs, errors)) > 0.1
    assert all(abs(error) < 2.0 * sigma for error, sigma in zip(errors, sigmas))


@pytest.mark.parametrize("sides", [("front",), ("left",), ("left", "right"), ("front", "rear")])
def test_one_direction_alone_is_not_enough(sides):
    with pytest.raises(NotLocated, match="one long side and one end"):
        fit_car(surfels(box(sides=sides)), prior(), PARAMETERS)


@pytest.mark.parametrize("gap_m", [0.4, 0.7, 1.0])
@pytest.mark.parametrize("guess_y", [-0.5, 0.0, 0.5])
def test_neighbour_beside_is_not_taken(gap_m, guess_y):
    neighbour = box(Pose2(0.3, WIDTH_M + gap_m, 0.03), seed=2)
    fit = fit_car(surfels(box(), neighbour), prior(0.0, guess_y), PARAMETERS)
    assert error_of(fit)[0] < 0.005


def test_two_cars_that_are_as_likely_are_not_guessed_between():
    both = surfels(box(Pose2(0.0, 1.2, 0.0)), box(Pose2(0.0, -1.2, 0.0), seed=2))
    with pytest.raises(NotLocated, match=r"Two things of a Car's size stand there, 2\.4 m apart"):
        fit_car(both, prior(), PARAMETERS)


@pytest.mark.parametrize("wall", [Pose2(0.0, 1.2, -math.pi / 2.0), Pose2(0.0, 1.5, -math.pi / 2.0),
                                  Pose2(2.6, 0.0, math.pi)])
def test_wall_beside_the_car_is_not_its_side(wall):
    rows = [(*wall.apply(0.0, along), wall.heading, STEP_M, SIGMA_M, 50) for along in np.arange(-6.0, 6.0, STEP_M)]
    fit = fit_car(surfels(box(), rows), prior(0.3, 0.3, 0.1), PARAMETERS)
    assert error_of(fit)[0] < 0.005
    assert fit.rectangle.width == pytest.approx(WIDTH_M, abs=0.006)


@pytest.mark.parametrize("length, width, name", [(6.5, 1.8, "length"), (2.7, 1.8, "length"), (4.5, 2.7, "width")])
def test_thing_of_another_size_is_no_car(length, width, name):
    with pytest.raises(NotLocated):
        fit_car(surfels(box(length=length, width=width)), prior(), PARAMETERS)


@pytest.mark.parametrize("length, width", [(3.05, 1.45), (3.57, 1.63), (5.3, 2.0), (5.95, 2.15)])
@pytest.mark.parametrize("guess", [(0.0, 0.0, 0.0), (0.6, -0.5, 0.1)])
def test_small_and_large_cars_are_found_without_a_data_sheet(length, width, guess):
    """If both ends are seen, an ordinary length from one of them is not a second Car."""
    fit = fit_car(surfels(box(length=length, width=width)), prior(*guess), PARAMETERS)
    assert error_of(fit)[0] < 0.005
    assert fit.rectangle.length == pytest.approx(length, abs=0.006)
    assert fit.rectangle.width == pytest.approx(width, abs=0.006)


@pytest.mark.parametrize("length", [6.1, 6.5, 7.5])
@pytest.mark.parametrize("guess_x", [-0.9, -0.6, 0.0, 0.6, 0.9])
def test_part_of_a_thing_that_is_too_long_is_no_car(length, guess_x):
    with pytest.raises(NotLocated):
        fit_car(surfels(box(length=length, width=2.0)), prior(guess_x), PARAMETERS)


def test_car_too_far_from_the_prior_is_not_looked_for():
    with pytest.raises(NotLocated):
        fit_car(surfels(box(Pose2(3.0, 2.0, 0.0))), prior(), PARAMETERS)


@pytest.mark.parametrize("rows", [[], [(0.0, 0.0, 0.0, 0.05, 0.003, 9)]])
def test_nothing_there_is_said(rows):
    with pytest.raises(NotLocated, match="nothing of a Car's size"):
        fit_car(surfels(rows), prior(), PARAMETERS)


def test_side_inset_widens_the_car():
    inset = LocatorParameters(sheet=DataSheet(side_inset_m=0.02))
    plain, wide = (fit_car(surfels(box()), prior(), parameters) for parameters in (PARAMETERS, inset))
    assert wide.rectangle.width - plain.rectangle.width == pytest.approx(0.04)
    assert wide.rectangle.length == pytest.approx(plain.rectangle.length)
