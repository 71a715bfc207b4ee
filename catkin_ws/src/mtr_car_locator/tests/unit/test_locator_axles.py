"""Axles from tyres: treads, outer faces that are seen in part, data sheets, and how sure the result is."""
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
    """Rows of the outer faces, of which a part is missing at the front, and of treads (axle, side, way it faces)."""
    rows = [(axle - HALF_CHORD_M * shift, side * 0.5 * WIDTH_M, side * 0.5 * math.pi, 2.0 * HALF_CHORD_M * seen,
             SIGMA_M, 90) for axle in (FRONT_M, REAR_M) for side in (1.0, -1.0)]
    for axle, side, facing in treads:
        normal = 0.0 if facing > 0.0 else math.pi
        rows.append((axle + facing * HALF_CHORD_M, side * 0.5 * (WIDTH_M - TYRE_M), normal, 0.14, SIGMA_M, 60))
    return rows


def wheels_of(rows, **sheet):
    return wheels_between(wheel_sides(surfels(rows)), 0.0, WIDTH_M, DataSheet(**sheet))


def test_treads_give_both_axles_though_the_outer_faces_were_seen_in_part():
    wheels = wheels_of(tyres(TREADS), **SHEET)
    assert wheels.front_axle_m == pytest.approx(FRONT_M, abs=0.003)
    assert wheels.rear_axle_m == pytest.approx(REAR_M, abs=0.003)
    assert wheels.centre_m == pytest.approx(CENTRE_M, abs=0.003) and wheels.centre_sigma_m < 0.008


@pytest.mark.parametrize("outer", [each for each in TREADS if each not in INNER])
def test_inner_treads_and_one_outer_tread_are_enough(outer):
    wheels = wheels_of(tyres((*INNER, outer)), **SHEET)
    assert wheels.centre_m == pytest.approx(CENTRE_M, abs=0.005) and wheels.centre_sigma_m < 0.012


def test_inner_treads_and_the_known_wheelbase_are_enough():
    alone = wheels_of(tyres(INNER), **SHEET)
    known = wheels_of(tyres(INNER), **SHEET, wheelbase_m=FRONT_M - REAR_M)
    assert known.centre_m == pytest.approx(CENTRE_M, abs=0.003) and known.centre_sigma_m < 0.01
    assert abs(alone.centre_m - CENTRE_M) < 2.0 * alone.centre_sigma_m and alone.centre_sigma_m > 0.015


def test_outer_faces_alone_say_that_they_are_worth_centimetres():
    wheels = wheels_of(tyres(()), **SHEET)
    assert abs(wheels.centre_m - CENTRE_M) == pytest.approx(0.15 * HALF_CHORD_M, abs=0.01)
    assert abs(wheels.centre_m - CENTRE_M) < 2.0 * wheels.centre_sigma_m < 0.1


def test_wheelbase_of_another_car_makes_the_centre_unsure():
    right, wrong = (wheels_of(tyres(TREADS), **SHEET, wheelbase_m=FRONT_M - REAR_M + error) for error in (0.0, 0.1))
    assert wrong.centre_sigma_m > 2.0 * right.centre_sigma_m
    assert abs(wrong.centre_m - CENTRE_M) < 3.0 * wrong.centre_sigma_m


def test_car_of_which_only_parts_of_the_tyres_were_seen_is_located():
    rows = tyres(TREADS, seen=0.55)
    rows = [(x + (0.1 if y > 0.0 and abs(y) > 0.85 else 0.0), y, *rest) for x, y, *rest in rows]
    sheet = DataSheet(**SHEET, known_width_m=WIDTH_M + 0.05)
    fit = fit_car(surfels(rows), prior(0.2, 0.1, 0.05), LocatorParameters(sheet=sheet))
    assert fit.by_wheels and fit.quality < 0.3
    assert fit.rectangle.pose.x == pytest.approx(CENTRE_M, abs=0.005)
    assert fit.rectangle.pose.y == pytest.approx(0.0, abs=0.005)


def test_shoulder_of_a_tyre_is_no_tread():
    turned = [(FRONT_M + HALF_CHORD_M - 0.03, 0.8, math.radians(30.0), 0.12, SIGMA_M, 40)]
    plain, shouldered = (wheels_of(tyres(TREADS) + more, **SHEET) for more in ([], turned))
    assert shouldered.front_axle_m == pytest.approx(plain.front_axle_m, abs=1e-9)


def test_errors_of_the_centre_agree_with_its_sigma():
    rng = np.random.default_rng(4)
    ratios = []
    for _ in range(60):
        rows = [(x + rng.normal(0.0, SIGMA_M), y, *rest) for x, y, *rest in tyres(TREADS)]
        wheels = wheels_of(rows, known_length_m=LENGTH_M, front_overhang_m=OVERHANG_M + rng.normal(0.0, 0.005))
        ratios.append((wheels.centre_m - CENTRE_M) / wheels.centre_sigma_m)
    # Treads lie where they should here, so that only part of their sigma is used up.
    assert 0.4 < math.sqrt(np.mean(np.square(ratios))) < 1.1
