"""Observations for tests of the state machine: a Car, orders, poses and reports."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import CAR_LOCATOR, DesiredState, GoalReport, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check
from mtr_state_machine.observation import Car, CheckReport, Observation, Part

ALL_WELL = {part: 0.1 for part in Part}
WAYPOINT = Waypoint(7, "application/9", "car", Pose2(3.0, 1.0, 0.5), 2)
MAP_PLACE = Waypoint(1, CAR_LOCATOR, "map", Pose2(5.0, 5.0, 0.0))
WANTS = DesiredState(session_id=9, link_alive=True, stop=False, waypoint=WAYPOINT, max_speed_mps=0.8)
COLLECTING = Car(CarState.COLLECTING, MAP_PLACE)
LOCATED = Car(CarState.LOCATED)
CHECK_PLACE = Waypoint(5, CAR_LOCATOR, "map", Pose2(6.0, 1.0, 2.0))
LOOKING = replace(LOCATED, next_waypoint=CHECK_PLACE)
ORDERS_CHECK = replace(WANTS, check_car_id=4)
PASSED = CheckReport(4, Check.PASSED, Problem(text="Passed."))
NOT_PASSED = CheckReport(4, Check.FAILED, Problem("car_locator.elsewhere", "The Car stands 3.0 cm off."))
LOST = {Part.LOCALIZATION: Problem(text="Localization is lost.")}
ROUND_IT = Problem("car_locator.goes_round", "Goes round the Car.")
NO_WAY = Problem("motion_planner.no_way", "No way.")


def seen(**changes):
    return replace(Observation(desired=WANTS, car=Car(), age_s=ALL_WELL), **changes)


def reported(decision, result, message=NO_PROBLEM):
    return GoalReport(decision.goal.id, result, message)
