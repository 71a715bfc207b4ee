"""A Car on its wheels next to another car: only the inner faces of its far tyres are seen, under the Car."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from locator_surfels import ORIGIN, SIGMA_M, prior, surfels

from mtr_car_locator.find.errors import NotLocated
from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.parameters import LocatorParameters

HALF_CHORD_M, TYRE_M, GAP_M = 0.30, 0.2, 0.6
# Width over the tyres and wheelbase of a saloon and of a small car.
SALOON, SMALL = (1.8, 2.85), (1.45, 2.1)


def tyre(x, outer_m, side, *, outer_face, rng):
    """Return rows of one tyre: its inner face, both treads, and its outer face if it is seen."""
    faces = [(outer_m - TYRE_M, -side)] + ([(outer_m, side)] if outer_face else [])
    rows = [(x + part, side * out, facing * 0.5 * math.pi, 0.2, SIGMA_M, 60)
            for out, facing in faces for part in (-0.2, 0.0, 0.2)]
    rows += [(x + end * HALF_CHORD_M, side * (outer_m - 0.5 * TYRE_M), 0.0 if end > 0 else math.pi, 0.16, SIGMA_M, 60)
             for end in (1.0, -1.0)]
    return [(a + rng.normal(0.0, SIGMA_M), b + rng.normal(0.0, SIGMA_M), *rest) for a, b, *rest in rows]


def wheels(width_m, wheelbase_m, near=1.0, seed=1, far=True):
    """Return rows of a Car's tyres as seen from the side `near`."""
    rng = np.random.default_rng(seed)
    return [row for x in (0.5 * wheelbase_m, -0.5 * wheelbase_m) for side in (near, -near) if far or side == near
            for row in tyre(x, 0.5 * width_m, side, outer_face=side == near, rng=rng)]


def flank(width_m, near=1.0, turn_deg=0.0, length_m=4.4):
    """Return rows of the side of the adjacent car that faces the Car."""
    turn = math.radians(turn_deg)
    y = -near * (0.5 * width_m + GAP_M + 0.5 * length_m * math.sin(abs(turn)))
    return [(along * math.cos(turn), y + along * math.sin(turn), near * 0.5 * math.pi + turn, 0.4, SIGMA_M, 90)
            for along in np.arange(-0.5 * length_m + 0.2, 0.5 * length_m, 0.4)]


def located(rows):
    return fit_car(surfels(rows), prior(0.25, 0.1, 0.05), LocatorParameters())


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("near", [1.0, -1.0])
@pytest.mark.parametrize("size", [SALOON, SMALL])
def test_inner_faces_of_the_far_tyres_tell_the_middle_and_the_width(size, near, seed):
    fit = located(wheels(*size, near, seed) + flank(size[0], near))
    assert fit.by_wheels and set(fit.seen) == {"left", "right"}
    assert fit.rectangle.pose.y == pytest.approx(0.0, abs=0.006)
    assert fit.rectangle.width == pytest.approx(size[0], abs=0.012)
    assert abs(fit.rectangle.pose.x) < 0.02 and abs(math.degrees(fit.rectangle.pose.heading)) < 0.3
    assert fit.sigmas[1] < 0.01 < fit.width_sigma


@pytest.mark.parametrize("turn_deg", [-3.0, 3.0])
def test_side_of_the_neighbour_does_not_turn_the_car(turn_deg):
    fit = located(wheels(*SALOON) + flank(SALOON[0], turn_deg=turn_deg))
    assert abs(math.degrees(fit.rectangle.pose.heading)) < 0.3
    assert fit.rectangle.pose.y == pytest.approx(0.0, abs=0.006)


@pytest.mark.parametrize("size", [SALOON, SMALL])
def test_tyres_of_a_neighbour_are_not_taken_for_the_cars(size):
    width_m, wheelbase_m = size
    outer_faces = [row for row in wheels(width_m, wheelbase_m, far=False) if row[1] > 0.5 * width_m - 0.03]
    beside = [(x, y - width_m - GAP_M, *rest) for x, y, *rest in outer_faces]
    fit = located(wheels(*size) + beside)
    assert fit.rectangle.pose.y == pytest.approx(0.0, abs=0.006)
    with pytest.raises(NotLocated):
        located(wheels(*size, far=False) + beside)


@pytest.mark.parametrize("seed", range(3))
def test_other_rectangle_about_the_same_wheels_is_no_second_car(seed):
    # A rectangle of the expected length with its rear at the rear treads has its centre 0.9 m from the Car's.
    rows = wheels(1.55, 2.2, seed=seed) + flank(1.55)
    rows += [(-1.4, y, math.pi, 0.16, SIGMA_M, 60) for y in (0.45, -0.45)]
    fit = located(rows)
    assert fit.by_wheels and fit.rectangle.pose.distance_to(ORIGIN) < 0.02


def test_outer_faces_that_are_seen_are_not_replaced_by_inner_ones():
    rng = np.random.default_rng(1)
    # Outer faces are at their true places, although the inner ones belong to other tyres.
    rows = [row for x in (1.4, -1.4) for side, width_m in ((1.0, 1.8), (-1.0, 1.8))
            for row in tyre(x, 0.5 * width_m, side, outer_face=True, rng=rng)]
    rows = [(x, y + (0.05 if -0.75 < y < -0.65 else 0.0), *rest) for x, y, *rest in rows]
    fit = located(rows)
    assert fit.rectangle.pose.y == pytest.approx(0.0, abs=0.006)
    assert fit.rectangle.width == pytest.approx(1.8, abs=0.012)
