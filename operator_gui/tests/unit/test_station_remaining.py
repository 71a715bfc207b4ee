"""The checklist of a test that is at hand: what is left of it is looked at before the robot goes on."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import numpy as np
import pytest

from mtr_operator.domain.ports import LockState
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.station.checks.finding import Check, Finding
from mtr_operator.station.connection import Connection
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.mailbox import Batch
from mtr_operator.station.test import new_test
from mtr_operator.station.view_model import ViewModel

CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)
STATUS = RobotStatus(id=1, robot_session_id=1, stamp_s=1.0, pose_valid=True, battery_percent=80, car=CAR)
# On the first radial, which leads ahead; its border is at 4 m.
WALL = np.array([[5.15, 0.1], [5.15, -0.1]])


def result(number, status=LineStatus.OK):
    is_ok = status is LineStatus.OK
    return KeyPressResult(number, 90.0 * (number - 1), status, 4.0 if is_ok else None, None, 0.01 if is_ok else None, 1,
                          1.0, "" if is_ok else "The link was interrupted.")


@pytest.fixture(name="model")
def paused(tmp_path):
    model = ViewModel(lambda: 0.0)
    model.apply(Batch((), RobotSnapshot(STATUS, LockState.LOCKED, ""), ()))
    scenario = SCENARIOS["key_press"]
    parameters = dataclasses.replace(KeyPressParameters(), angle_between_radials_rad=math.pi / 2.0)
    model.take_up(new_test(scenario, parameters, tmp_path, Connection()))
    model.obstacles.places, model.obstacles.version = WALL, 1
    model.obstacles.seen[:] = True
    return model


def item(model, check):
    found, = (item for item in model.checklist if item.check is check)
    return found


def test_way_of_the_lines_that_are_left_is_looked_at_before_the_robot_goes_on__2(model):
    assert (item(model, Check.WAY).finding, item(model, Check.WAY).said) == (Finding.WAY_HINDERED, "1")
    model.results = (result(1),)
    assert item(model, Check.WAY).finding is Finding.WAY_FREE
    model.results = (result(1, LineStatus.INVALID),)
    assert item(model, Check.WAY).finding is Finding.WAY_HINDERED


def test_battery_is_held_against_what_is_left__2(model):
    whole = item(model, Check.BATTERY)
    assert whole.finding is Finding.BATTERY_SUFFICES
    model.results = tuple(map(result, (1, 2, 3)))
    rest = item(model, Check.BATTERY)
    assert rest.finding is Finding.BATTERY_SUFFICES
    assert 0.0 < rest.numbers[1] < whole.numbers[1] / 2.0


def test_nothing_is_left_of_a_finished_test__2(model):
    model.results = tuple(map(result, (1, 2, 3, 4)))
    assert item(model, Check.WAY).finding is Finding.WAY_TO_COME
    assert item(model, Check.BATTERY).finding is Finding.BATTERY_FINE
