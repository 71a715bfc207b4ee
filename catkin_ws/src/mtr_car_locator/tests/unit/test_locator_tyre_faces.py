"""Axles from the outer faces of the tyres: exact despite noise and uneven ground."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import numpy as np
import pytest

from mtr_car_locator.measure.close_up import CloseUp
from mtr_car_locator.measure.tyre_faces import faces_in
from mtr_car_locator.measure.wheels import Face, wheels_from
from mtr_car_locator.parameters import DataSheet

FRONT_M, REAR_M, LEVEL_M = 1.43, -1.42, 0.9
NOISE_M = 0.02
SHEET = DataSheet(known_length_m=4.85, front_overhang_m=1.0, wheelbase_m=2.85)


def face(rng, middle_m, returns=20_000, half_m=0.3, *, heights_m=0.0, level_m=LEVEL_M):
    """Return returns of a tyre on the left; heights_m: variation of its half chord with the height of the hits."""
    half = half_m + heights_m * rng.uniform(-1.0, 1.0, returns)
    along = middle_m + half * rng.uniform(-1.0, 1.0, returns)
    return np.column_stack((along, np.full(returns, level_m))) + NOISE_M * rng.standard_normal((returns, 2))


def seen(*parts, side=1.0):
    points = np.concatenate(parts) * (1.0, side)
    return CloseUp(points, np.tile((0.0, -side), (len(points), 1)))


def middles(faces):
    return [each.middle_m for each in faces]


def tyres_at(*sides):
    """Return faces of equal tyres with these middles, left and right."""
    return [[Face(middle - 0.3, middle + 0.3) for middle in each] for each in sides]


@pytest.fixture
def rng():
    return np.random.default_rng(1)


@pytest.mark.parametrize("name, side", [("left", 1.0), ("right", -1.0)])
@pytest.mark.parametrize("heights_m", [0.0, 0.03])
def test_middles_are_exact_to_two_millimetres(rng, name, side, heights_m):
    tyres = [face(rng, middle, heights_m=heights_m) for middle in (REAR_M, FRONT_M)]
    assert middles(faces_in(seen(*tyres, side=side), name, LEVEL_M)) == pytest.approx([REAR_M, FRONT_M], abs=0.002)


def test_bumper_and_sill_that_are_met_now_and_then_are_no_faces(rng):
    bumper, sill = face(rng, 2.1, 1000, 0.25), face(rng, 0.0, 2000, 1.1)
    found = faces_in(seen(face(rng, REAR_M), face(rng, FRONT_M), bumper, sill), "left", LEVEL_M)
    assert middles(found) == pytest.approx([REAR_M, FRONT_M], abs=0.003)


def test_whole_side_and_next_to_nothing_are_no_faces(rng):
    assert faces_in(seen(face(rng, 0.0, 20000, 2.0)), "left", LEVEL_M) == []
    assert faces_in(seen(face(rng, FRONT_M, 50)), "left", LEVEL_M) == []
    assert faces_in(seen(face(rng, FRONT_M, level_m=0.7)), "left", LEVEL_M) == []


def test_data_sheet_turns_axles_into_the_centre():
    wheels = wheels_from(tyres_at([REAR_M, FRONT_M], [REAR_M, FRONT_M]), SHEET)
    assert wheels.ends.centre_m == pytest.approx(FRONT_M + 1.0 - 0.5 * 4.85, abs=0.003)
    assert 0.005 < wheels.ends.centre_sigma_m < 0.008


def test_end_of_a_bumper_as_long_as_a_tyre_is_told_by_the_other_side_and_the_wheelbase():
    wheels = wheels_from(tyres_at([REAR_M, FRONT_M, 2.1], [-2.2, REAR_M, FRONT_M]), SHEET)
    assert wheels.axles.front_m == pytest.approx(FRONT_M, abs=0.003)


@pytest.mark.parametrize("faces", [
    [[REAR_M, FRONT_M], [FRONT_M]], [[REAR_M, FRONT_M], [REAR_M + 0.2, FRONT_M + 0.2]],
    [[REAR_M, FRONT_M - 0.1], [REAR_M, FRONT_M - 0.1]]])
def test_faces_that_do_not_stand_as_the_cars_wheels_are_none(faces):
    assert wheels_from(tyres_at(*faces), SHEET) is None


def test_two_ways_to_see_a_car_in_the_faces_are_not_guessed_between():
    assert wheels_from(tyres_at(*[[-2.4, -1.4, 1.0, 1.4]] * 2), DataSheet()) is None


@pytest.mark.parametrize("wheelbase_m", [0.0, 2.85])
@pytest.mark.parametrize("front", [Face(FRONT_M - 0.38, FRONT_M + 0.3), Face(FRONT_M - 0.22, FRONT_M + 0.3)])
def test_mirror_that_lengthens_the_front_faces_or_hides_their_ends_makes_the_centre_unsure(front, wheelbase_m):
    sheet = replace(SHEET, wheelbase_m=wheelbase_m)
    beside = [[Face(REAR_M - 0.3, REAR_M + 0.3), front]] * 2
    plain, off = (wheels_from(each, sheet) for each in (tyres_at(*[[REAR_M, FRONT_M]] * 2), beside))
    assert 0.015 < abs(off.ends.centre_m - plain.ends.centre_m) < 3.0 * off.ends.centre_sigma_m
    assert plain.ends.centre_sigma_m < 0.01


def test_car_that_is_parked_in_line_has_other_wheels():
    faces = tyres_at(*[[REAR_M, FRONT_M, FRONT_M + 2.4, FRONT_M + 5.2]] * 2)
    assert wheels_from(faces, DataSheet()).axles.front_m == pytest.approx(FRONT_M, abs=0.003)
