"""The keep-out area grows by the uncertainty of the Car and of the robot."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest
from motion_simulation import OUTLINE, PARAMETERS, ROBOT, SimulatedRobot, car_at

from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_motion_planner.geometry.growth import (
    KNOWN_SIGMA_M,
    MARGIN_SIGMAS,
    CarBounds,
    Growth,
    bounds_of,
    grown,
)
from mtr_motion_planner.geometry.keep_out import KeepOut, polygon_of
from mtr_motion_planner.inputs import InputsUnusable, RobotState, SideSigmas, situation_of
from mtr_motion_planner.parameters import Margins, MotionParameters

CAR_POSES = [Pose2(0.0, 0.0, 0.0), Pose2(7.0, -3.0, 2.0)]
# Pose of base_link for a key at a distance from each side: x, y and heading in degrees in the Car's frame; the key is
# 0.25 m ahead of base_link.
KEY_M = 0.25
SIDES = {"front": lambda gap: (2.25 + gap + KEY_M, 0.1, 180.0), "rear": lambda gap: (-2.25 - gap - KEY_M, 0.1, 0.0),
         "left": lambda gap: (0.3, 0.9 + gap + KEY_M, -90.0), "right": lambda gap: (0.3, -0.9 - gap - KEY_M, 90.0)}
CODES = {"front": "front", "rear": "rear", "left": "side", "right": "side"}
DATA_SHEET = SideSigmas(0.007, 0.009, 0.005, 0.005)


def robot_beside(side, gap_m, car, **changed):
    """Return a robot with a goal at which its key is at this distance from a side of the Car."""
    robot = SimulatedRobot(car.pose @ Pose2(3.5, 3.0, math.radians(-135.0)), car)
    robot.go(1, *SIDES[side](gap_m), Direction.FORWARD)
    for name, value in changed.items():
        setattr(robot, name, value)
    return robot


@pytest.mark.parametrize("car_pose", CAR_POSES)
@pytest.mark.parametrize("side", SIDES)
def test_car_with_a_data_sheet_is_measured_down_to_30_cm_from_every_side(side, car_pose):
    robot = robot_beside(side, 0.3, replace(car_at(car_pose), sides=DATA_SHEET, heading_sigma=0.001),
                         position_sigma_m=0.004)
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("car_pose", CAR_POSES)
@pytest.mark.parametrize("sigma_m", [0.04, 0.1, 0.36])
@pytest.mark.parametrize("side", SIDES)
def test_side_that_is_not_known_well_is_not_approached_and_the_robot_stays(side, sigma_m, car_pose):
    sides = DATA_SHEET._replace(**{side: sigma_m})
    robot = robot_beside(side, 0.3, replace(car_at(car_pose), sides=sides))
    output = robot.run()
    assert (output.result, output.message.code) == (
        Result.REFUSED, f"motion_planner.{CODES[side]}_uncertain")
    assert f"{sigma_m:.2f} m" in output.message.text and "car_file" in output.message.text
    assert len({(pose.x, pose.y) for pose in robot.poses}) == 1


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("sigma_m", [0.04, 0.1, 0.36])
def test_side_that_is_not_known_well_is_measured_from_farther_away(side, sigma_m):
    robot = robot_beside(side, 0.3 + MARGIN_SIGMAS * sigma_m, replace(
        car_at(), sides=DATA_SHEET._replace(**{side: sigma_m})))
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("other", SIDES)
@pytest.mark.parametrize("side", SIDES)
def test_uncertainty_of_one_side_hinders_no_other(side, other):
    robot = robot_beside(other, 0.3, replace(car_at(), sides=DATA_SHEET._replace(**{side: 0.1})))
    assert (robot.run().result == Result.REFUSED) == (side == other)


@pytest.mark.parametrize("side", SIDES)
def test_robot_that_does_not_know_its_own_position_keeps_away(side):
    robot = robot_beside(side, 0.3, replace(car_at(), sides=DATA_SHEET), position_sigma_m=0.1)
    output = robot.run()
    assert (output.result, output.message.code) == (Result.REFUSED, "motion_planner.own_position_uncertain")
    robot.position_sigma_m = 0.004
    assert robot.run_for(0.2).result == Result.PENDING
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("what", ["position_sigma_m", "heading_sigma"])
def test_position_that_becomes_uncertain_on_the_way_stops_the_robot_before_the_car(what):
    robot = robot_beside("front", 0.3, replace(car_at(), sides=DATA_SHEET))
    robot.run_for(3.0)
    assert robot.speed > 0.1
    setattr(robot, what, 0.2)
    output = robot.run()
    assert (output.result, output.message.code) == (Result.REFUSED, "motion_planner.own_position_uncertain")


def test_sigma_that_flickers_does_not_plan_again():
    robot = robot_beside("left", 0.5, replace(car_at(), sides=DATA_SHEET))
    for tick in range(4000):
        robot.position_sigma_m = 0.004 if tick % 2 else 0.009
        if robot.tick().result == Result.REACHED:
            break
    assert robot.outputs[-1].result == Result.REACHED and robot.outputs[-1].replans == 0


def test_heading_of_the_car_counts_at_its_corners():
    robot = RobotState(1.0, True, Pose2(9.0, 0.0, 0.0), 0.0, 0.0)
    growth = bounds_of(replace(car_at(), heading_sigma=0.01), robot, 0.28, Margins()).growth
    assert growth == pytest.approx((0.018, 0.018, 0.045, 0.045))


def test_prior_outline_of_a_car_that_is_not_located_is_not_grown():
    robot = RobotState(1.0, True, Pose2(9.0, 0.0, 0.0), 0.0, 0.0, position_sigma_m=0.2)
    car = replace(car_at(located=False), sides=SideSigmas(math.nan, 1.0, 1.0, 1.0))
    assert not any(bounds_of(car, robot, 0.28, Margins()).growth)


@pytest.mark.parametrize("heading", [0.0, 1.0, -2.5])
def test_outline_grows_by_each_side_s_own_distance(heading):
    turned = Pose2(0.0, 0.0, heading)
    found = grown(polygon_of([turned.apply(x, y) for x, y in OUTLINE]), heading, Growth(0.5, 0.1, 0.2, 0.3))
    x, y = np.array([turned.inverse().apply(*corner) for corner in found.exterior.coords]).T
    assert (x.max(), x.min(), y.max(), y.min()) == pytest.approx((2.75, -2.35, 1.1, -1.2))


@pytest.mark.parametrize("fitting", ["front_fitting_m", "rear_fitting_m"])
def test_what_was_entered_as_standing_out_is_part_of_the_car(fitting):
    margins = replace(Margins(), **{fitting: 0.6})
    side, other = ("front", "rear") if fitting.startswith("front") else ("rear", "front")
    results = []
    for where, gap_m in ((side, 0.65), (side, 0.75), (other, 0.3)):
        robot = SimulatedRobot(Pose2(3.5, 3.0, math.radians(-135.0)), replace(car_at(), sides=DATA_SHEET),
                               parameters=replace(MotionParameters(), margins=margins))
        robot.go(1, *SIDES[where](gap_m), Direction.FORWARD)
        results.append(robot.run().result)
    assert results == [Result.REFUSED, Result.REACHED, Result.REACHED]


@pytest.mark.parametrize("end", [1.0, -1.0])
def test_key_passes_and_turns_before_an_end_with_room_for_what_no_lidar_sees(end):
    robot = SimulatedRobot(Pose2(end * 3.2, -2.5, math.radians(90.0)), replace(car_at(), sides=DATA_SHEET))
    robot.go(1, end * 2.75, 0.0, 90.0)
    robot.run()
    robot.go(2, end * 3.2, 2.5, 90.0)
    assert robot.run().result == Result.REACHED
    fronts = [pose @ Pose2(0.27, 0.0, 0.0) for pose in robot.poses]
    assert min(end * front.x - 2.25 for front in fronts if abs(front.y) < 0.6 and end * front.x > 1.0) > 0.25


@pytest.mark.parametrize("sigma_m, is_allowed", [(0.5 * KNOWN_SIGMA_M, True), (1.1 * KNOWN_SIGMA_M, False)])
def test_end_that_is_known_may_be_approached_beyond_the_margin_of_the_way_round(sigma_m, is_allowed):
    bounds = CarBounds(Growth(MARGIN_SIGMAS * sigma_m), front_is_known=is_allowed)
    keep_out = KeepOut(OUTLINE, ROBOT, PARAMETERS.margins, bounds=bounds)
    approach, passing = Pose2(2.25 + 0.18 + ROBOT.front_m, 0.0, math.pi), Pose2(2.25 + 0.3, -0.4, math.radians(80.0))
    rooms = keep_out.room(np.array([[each.x, each.y, each.heading] for each in (approach, passing)]))
    assert bool((rooms[0] >= 0.0).all()) is is_allowed
    assert rooms[1].min() < 0.0


@pytest.mark.parametrize("value", [math.nan, math.inf])
@pytest.mark.parametrize("broken", ["front", "rear", "left", "right", "heading_sigma", "position_sigma_m",
                                    "robot heading"])
def test_uncertainty_that_is_no_number_stops_the_robot(broken, value):
    robot = robot_beside("front", 0.5, car_at())
    if broken in SideSigmas._fields:
        robot.car = replace(robot.car, sides=DATA_SHEET._replace(**{broken: value}))
    elif broken == "heading_sigma":
        robot.car = replace(robot.car, heading_sigma=value)
    else:
        setattr(robot, "heading_sigma" if broken == "robot heading" else broken, value)
    with pytest.raises(InputsUnusable):
        situation_of(robot.inputs(), 0.3)
    assert robot.run_for(0.5).linear_mps == 0.0
