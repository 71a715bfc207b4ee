"""Axles from tyres: treads, partly seen outer faces, data sheets, and uncertainty of the result."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math

import numpy as np
import pytest
from locator_surfels import SIGMA_M, prior, surfels

from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.measure.wheels import wheel_sides, wheels_between
from mtr_car_locator.parameters import DataSheet, LocatorParameters

WIDTH_M, FRONT_M, REAR_M, HALF_CHORD_M, TYRE_M = 1.8, 1.45, -1.40, 0.30, 0.2
LENGTH_M, OVERHANG_M = 4.8, 0.95
CENTRE_M = FRONT_M + OVERHANG_M - 0.5 * LENGTH_M
TREADS = tuple(itertools.product((FRONT_M, REAR_M), (1.0, -1.0), (1.0, -1.0)))
INNER = tuple((axle, side, facing) for axle, side, facing in TREADS if (axle > 0.0) == (facing < 0.0))
SHEET = {"known_length_m": LENGTH_M, "front_overhang_m": OVERHANG_M}


def tyres(treads, seen=0.7, shift=0.15):
    """Return rows of outer faces with a missing part at the front, and of treads (axle, side, direction)."""
    rows = [(axle - HALF_CHORD_M * shift, side * 0.5 * WIDTH_M, side * 0.5 * math.pi, 2.0 * HALF_CHORD_M * seen,
             SIGMA_M, 90) for axle in (FRONT_M, REAR_M) for side in (1.0, -1.0)]
    for axle, side, facing in treads:
        normal = 0.0 if facing > 0.0 else math.pi
        rows.append((axle + facing * HALF_CHORD_M, side * 0.5 * (WIDTH_M - TYRE_M), normal, 0.14, SIGMA_M, 60))
    return rows


def mirrors(x=0.65, out=0.06):
    """Return rows of protruding parts on both sides between the wheels, with the short edge along the sill below."""
    rows = [(x, side * (0.5 * WIDTH_M + out), side * 0.5 * math.pi, 0.16, SIGMA_M, 60) for side in (1.0, -1.0)]
    return rows + [(x + end * 0.08, side * 0.5 * WIDTH_M, 0.0 if end > 0.0 else math.pi, 0.14, SIGMA_M, 60)
                   for end in (1.0, -1.0) for side in (1.0, -1.0)]


def in_line(rows, shift_m):
    """Return rows of a car parked in line with the Car, with a visible body."""
    other = [(x + shift_m, *rest) for x, *rest in rows]
    return other + [(shift_m, side * (0.5 * WIDTH_M + 0.02), side * 0.5 * math.pi, 4.4, SIGMA_M, 90)
                    for side in (1.0, -1.0)]


def wheels_of(rows, **sheet):
    wheels, = wheels_between(wheel_sides(surfels(rows)), 0.0, WIDTH_M, DataSheet(**sheet))
    return wheels


def test_treads_give_both_axles_though_the_outer_faces_were_seen_in_part():
    wheels = wheels_of(tyres(TREADS), **SHEET)
    assert wheels.axles.front_m == pytest.approx(FRONT_M, abs=0.003)
    assert wheels.axles.rear_m == pytest.approx(REAR_M, abs=0.003)
    assert wheels.ends.centre_m == pytest.approx(CENTRE_M, abs=0.003) and wheels.ends.centre_sigma_m < 0.008


@pytest.mark.parametrize("outer", [each for each in TREADS if each not in INNER])
def test_inner_treads_and_one_outer_tread_are_enough(outer):
    wheels = wheels_of(tyres((*INNER, outer)), **SHEET)
    assert wheels.ends.centre_m == pytest.approx(CENTRE_M, abs=0.005) and wheels.ends.centre_sigma_m < 0.012


def test_inner_treads_and_the_known_wheelbase_are_enough():
    alone = wheels_of(tyres(INNER), **SHEET)
    known = wheels_of(tyres(INNER), **SHEET, wheelbase_m=FRONT_M - REAR_M)
    assert known.ends.centre_m == pytest.approx(CENTRE_M, abs=0.003) and known.ends.centre_sigma_m < 0.01
    assert abs(alone.ends.centre_m - CENTRE_M) < 2.0 * alone.ends.centre_sigma_m and alone.ends.centre_sigma_m > 0.015


def test_outer_faces_alone_say_that_they_are_worth_centimetres():
    wheels = wheels_of(tyres(()), **SHEET)
    assert abs(wheels.ends.centre_m - CENTRE_M) == pytest.approx(0.15 * HALF_CHORD_M, abs=0.01)
    assert abs(wheels.ends.centre_m - CENTRE_M) < 2.0 * wheels.ends.centre_sigma_m < 0.1


def test_wheelbase_of_another_car_makes_the_centre_unsure():
    right, wrong = (wheels_of(tyres(TREADS), **SHEET, wheelbase_m=FRONT_M - REAR_M + error) for error in (0.0, 0.1))
    assert wrong.ends.centre_sigma_m > 2.0 * right.ends.centre_sigma_m
    assert abs(wrong.ends.centre_m - CENTRE_M) < 3.0 * wrong.ends.centre_sigma_m


def test_car_of_which_only_parts_of_the_tyres_were_seen_is_located():
    rows = tyres(TREADS, seen=0.55)
    rows = [(x + (0.1 if y > 0.0 and abs(y) > 0.85 else 0.0), y, *rest) for x, y, *rest in rows]
    sheet = DataSheet(**SHEET, known_width_m=WIDTH_M + 0.05)
    fit = fit_car(surfels(rows), prior(0.2, 0.1, 0.05), LocatorParameters(sheet=sheet))
    assert fit.by_wheels and fit.quality < 0.3
    assert fit.rectangle.pose.x == pytest.approx(CENTRE_M, abs=0.005)
    assert fit.rectangle.pose.y == pytest.approx(0.0, abs=0.005)


@pytest.mark.parametrize("x", [0.3, 0.65, 0.9, -0.8])
def test_mirror_beside_a_wheel_hides_neither(x):
    plain, beside = (wheels_of(tyres(TREADS) + more, **SHEET) for more in ([], mirrors(x)))
    assert beside.ends.centre_m == pytest.approx(plain.ends.centre_m, abs=0.01)


@pytest.mark.parametrize("shift_m", [5.2, -5.2])
def test_car_that_is_parked_in_line_hides_no_wheels(shift_m):
    wheels = wheels_of(tyres(TREADS) + in_line(tyres(TREADS), shift_m), **SHEET)
    assert wheels.ends.centre_m == pytest.approx(CENTRE_M, abs=0.005)


@pytest.mark.parametrize("shift_m", [5.2, -5.2])
def test_wheels_of_a_car_in_line_are_told_from_the_cars_by_the_starting_place(shift_m):
    rows = tyres(TREADS) + [(x + shift_m, *rest) for x, *rest in tyres(TREADS)]
    fit = fit_car(surfels(rows), prior(0.2, 0.1, 0.05), LocatorParameters(sheet=DataSheet(**SHEET)))
    assert fit.by_wheels and fit.rectangle.pose.x == pytest.approx(CENTRE_M, abs=0.005)


@pytest.mark.parametrize("seed", range(8))
def test_directions_of_a_few_surfaces_do_not_turn_the_car(seed):
    turns = np.random.default_rng(seed).normal(0.06, 0.04, len(tyres(TREADS)))
    rows = [(x, y, normal + turn, *rest) for (x, y, normal, *rest), turn in zip(tyres(TREADS), turns)]
    fit = fit_car(surfels(rows), prior(0.2, 0.1, 0.05), LocatorParameters(sheet=DataSheet(**SHEET)))
    assert fit.by_wheels and abs(math.degrees(fit.rectangle.pose.heading)) < 0.3


@pytest.mark.parametrize("wheelbase_m", [1.87, 2.52, 3.68])
def test_length_by_wheels_holds_the_smallest_and_the_longest_cars(wheelbase_m):
    """Smart fortwo (2.70 m), Honda N-Box (3.40 m), Ford F-150 (5.89 m)."""
    shift = 0.5 * (wheelbase_m - (FRONT_M - REAR_M))
    rows = [(x + shift * math.copysign(1.0, x), *rest) for x, *rest in tyres(TREADS)]
    wheels, length_m = wheels_of(rows), {1.87: 2.695, 2.52: 3.395, 3.68: 5.885}[wheelbase_m]
    assert abs(wheels.ends.length_m - length_m) < 3.0 * wheels.ends.length_sigma_m


def test_shoulder_of_a_tyre_is_no_tread():
    turned = [(FRONT_M + HALF_CHORD_M - 0.03, 0.8, math.radians(30.0), 0.12, SIGMA_M, 40)]
    plain, shouldered = (wheels_of(tyres(TREADS) + more, **SHEET) for more in ([], turned))
    assert shouldered.axles.front_m == pytest.approx(plain.axles.front_m, abs=1e-9)


def test_errors_of_the_centre_agree_with_its_sigma():
    rng = np.random.default_rng(4)
    ratios = []
    for _ in range(60):
        rows = [(x + rng.normal(0.0, SIGMA_M), y, *rest) for x, y, *rest in tyres(TREADS)]
        wheels = wheels_of(rows, known_length_m=LENGTH_M, front_overhang_m=OVERHANG_M + rng.normal(0.0, 0.005))
        ratios.append((wheels.ends.centre_m - CENTRE_M) / wheels.ends.centre_sigma_m)
    # Treads have no errors here, so only a part of their sigma is used.
    assert 0.4 < math.sqrt(np.mean(np.square(ratios))) < 1.1
