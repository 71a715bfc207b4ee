"""Complete tests around random Cars have no contacts, and the benchmark detects a contact if there is one."""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from dataclasses import replace

import numpy as np
import pytest

from mtr_benchmarks.car_clearance import trial
from mtr_benchmarks.car_clearance.bodies import Fitting, Solid, TrueCar
from mtr_benchmarks.car_clearance.draw import HIGH, LOW, NO_SHEET, SHEETS, WHOLE, random_car
from mtr_benchmarks.car_clearance.figures import CONTACTS, ORDINARY, figures
from mtr_benchmarks.car_clearance.sweep import Body
from mtr_benchmarks.harness.rows import all_met
from mtr_motion_planner.inputs import EXACT_SIDES

SEED, CARS = 7, 12
SALOON = TrueCar(4.8, 1.85, 1.45, 0.9, 2.8, 0.32, 0.2, 0.05, 0.02, 0.2, spare_wheel=False)


@functools.lru_cache(maxsize=None)
def end_of(number):
    """Return the result of the test of a Car."""
    return trial.run((SEED, number))


@pytest.mark.parametrize("number", range(CARS))
def test_robot_touches_no_car_and_says_why_a_line_is_not_measured_at_the_nearest_place(number):
    end = end_of(number)
    assert not end.asked and len(end.lines) == 8
    assert figures([end]).contacts == []
    assert all(line.nearest_m == trial.NEAR_M[0] or line.refused for line in end.lines)


def test_most_lines_are_measured_and_those_of_ordinary_cars_with_a_data_sheet_at_the_nearest_place():
    found = figures([end_of(number) for number in range(CARS)])
    assert found.measured >= 0.95
    assert found.ordinary_at_nearest == 1.0


def test_planner_that_takes_the_car_for_exact_touches_some(monkeypatch):
    received = trial.received
    monkeypatch.setattr(trial, "received", lambda fit, now_s: replace(
        received(fit, now_s), sides=EXACT_SIDES, heading_sigma=0.0))
    numbers = [number for number in range(1, 60) if random_car(SEED, number).sheet == NO_SHEET and number % 2]
    assert figures([trial.run((SEED, number)) for number in numbers[:4]]).contacts


def test_every_second_car_has_its_bumpers_above_the_plane():
    drawn = [random_car(3, number) for number in range(60)]
    assert {each.kind for each in drawn} == {*LOW, *HIGH} and {each.sheet for each in drawn} == set(SHEETS)
    assert [each.kind in HIGH for each in drawn] == [bool(number % 2) for number in range(60)]
    assert all((each.car.clearance_m > 0.3) == (each.kind in HIGH) for each in drawn)
    assert any(each.car.spare_wheel for each in drawn) and any(each.rear_fitting_m for each in drawn)


@pytest.mark.parametrize("car, length_m", [
    (SALOON, 4.8 - 0.05 - 0.02), (replace(SALOON, clearance_m=0.35), 2.8 + 2.0 * 0.3194)])
def test_plane_meets_what_is_at_its_height(car, length_m):
    xs = [x for corners in car.section(0.3) for x, _ in corners]
    assert max(xs) - min(xs) == pytest.approx(length_m, abs=0.001)


@pytest.mark.parametrize("solid, gap_m", [
    (Solid(((1.0, 0.5), (1.0, -0.5), (2.0, -0.5), (2.0, 0.5)), 0.0, 0.2), 1.0 - 0.254),
    (Solid(((1.0, 0.5), (1.0, -0.5), (2.0, -0.5), (2.0, 0.5)), 1.0, 1.2), 1.0 - 0.27),
    (Solid(((0.2, 0.2), (0.2, 0.1), (2.0, 0.1), (2.0, 0.2)), 1.0, 1.2), 0.07),
    (Solid(((0.2, 0.2), (0.2, 0.1), (2.0, 0.1), (2.0, 0.2)), 0.2, 0.3), 0.0),
    (Solid(((0.1, 0.1), (0.1, -0.1), (2.0, -0.1), (2.0, 0.1)), 1.0, 1.2), 0.0),
    (Solid(((0.1, 0.1), (0.1, -0.1), (2.0, -0.1), (2.0, 0.1)), 1.7, 1.8), math.inf)])
def test_clearance_is_that_of_what_has_the_same_height(solid, gap_m):
    assert Body([solid]).clearance(np.zeros((1, 3))) == pytest.approx(gap_m, abs=0.001)


def test_fitting_and_spare_wheel_are_part_of_the_true_body():
    rear = [min(x for solid in car.solids() for x, _ in solid.corners) for car in (
        SALOON, replace(SALOON, fittings=(Fitting(0.4, 0.6, 0.6, 0.7),)), replace(SALOON, spare_wheel=True))]
    assert rear == pytest.approx([-2.4, -2.8, -2.4])


def test_one_contact_or_refused_ordinary_line_fails_the_table():
    drawn = next(each for each in map(lambda number: random_car(1, number), range(100))
                 if each.kind in LOW and each.sheet == WHOLE and not each.rear_fitting_m)
    fine = trial.LineEnd("front", 0.3, (), 0.1)
    assert all_met(figures([trial.CarEnd(0, drawn, (fine,) * 8)]).rows())
    for bad, name in ((fine._replace(clearance_m=0.0), CONTACTS), (fine._replace(nearest_m=0.5), ORDINARY)):
        rows = figures([trial.CarEnd(0, drawn, (*(fine,) * 7, bad))]).rows()
        assert [row.requirement for row in rows if not row.is_met] == [name]
