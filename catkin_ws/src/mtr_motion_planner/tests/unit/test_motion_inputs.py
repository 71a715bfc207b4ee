"""Bad inputs never move the robot, and bad parameters never start the node."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest
from motion_simulation import FOOTPRINT

from mtr_core.errors import ConfigurationError
from mtr_core.executors import InlineExecutor
from mtr_core.parameters import parameters_from
from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL_ID, Goal, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Result
from mtr_motion_planner.inputs import DesiredMotion, EstimatedCar, Inputs, RobotState
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.planner import MotionPlanner

NAN = math.nan
CAR = EstimatedCar(1.0, True, Pose2(0, 0, 0), ((2.2, .9), (-2.2, .9), (-2.2, -.9), (2.2, -.9)))
ROBOT = RobotState(1.0, True, Pose2(4.0, 0.0, 0.0), 0.0, 0.0)
WAYPOINT = Waypoint(1, "application/5", "car", Pose2(6.0, 0.0, 0.0))
DESIRED = DesiredMotion(1.0, Goal(WAYPOINT, 1), 0.5)
GOOD = Inputs(1.0, DESIRED, ROBOT, CAR)


def with_goal(pose):
    return with_waypoint(pose=pose)


def with_waypoint(**changes):
    return replace(DESIRED, goal=Goal(replace(WAYPOINT, **changes), 1))


BAD = {
    "no order": replace(GOOD, desired=None),
    "no pose": replace(GOOD, robot=None),
    "no car": replace(GOOD, car=None),
    "old pose": replace(GOOD, robot=replace(ROBOT, stamp_s=0.65)),
    "old order": replace(GOOD, desired=replace(DESIRED, stamp_s=0.65)),
    "old car": replace(GOOD, car=replace(CAR, stamp_s=0.65)),
    "stamp not a number": replace(GOOD, robot=replace(ROBOT, stamp_s=NAN)),
    "lost": replace(GOOD, robot=replace(ROBOT, valid=False, message=Problem(text="No scan."))),
    "pose not a number": replace(GOOD, robot=replace(ROBOT, pose=Pose2(NAN, 0, 0))),
    "speed infinite": replace(GOOD, robot=replace(ROBOT, speed_mps=math.inf)),
    "car not a number": replace(GOOD, car=replace(CAR, pose=Pose2(0, 0, NAN))),
    "outline not a number": replace(GOOD, car=replace(CAR, outline=((NAN, 0), (1, 1), (2, 0)))),
    "no outline": replace(GOOD, car=replace(CAR, outline=())),
    "goal not a number": replace(GOOD, desired=with_goal(Pose2(6.0, NAN, 0.0))),
    "goal infinite": replace(GOOD, desired=with_goal(Pose2(math.inf, 0.0, 0.0))),
    "speed limit not a number": replace(GOOD, desired=replace(DESIRED, max_speed_mps=NAN)),
    "pose in the future": replace(GOOD, robot=replace(ROBOT, stamp_s=1.35)),
    "order in the future": replace(GOOD, desired=replace(DESIRED, stamp_s=1.35)),
    "car in the future": replace(GOOD, car=replace(CAR, stamp_s=1.35)),
    "goal in a frame nobody knows": replace(GOOD, desired=with_waypoint(frame="odom")),
    "outline of zero size": replace(GOOD, car=replace(CAR, outline=((0.0, 0.0),) * 4)),
    "speed limit beyond the platform's": replace(GOOD, desired=replace(DESIRED, max_speed_mps=2.1)),
    "speed limit zero": replace(GOOD, desired=replace(DESIRED, max_speed_mps=0.0)),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_gives_zero_velocity(case):
    output = MotionPlanner(MotionParameters(), FOOTPRINT, InlineExecutor()).step(BAD[case])
    assert (output.linear_mps, output.angular_radps) == (0.0, 0.0)
    assert output.result in (Result.IDLE, Result.PENDING, Result.REFUSED)
    assert output.message.text.endswith(".") or output.goal_id == NO_GOAL_ID


@pytest.mark.parametrize("case", BAD)
def test_robot_sets_out_when_the_input_is_good_again(case):
    planner = MotionPlanner(MotionParameters(), FOOTPRINT, InlineExecutor())
    planner.step(BAD[case])
    for tick in range(1, 20):
        now = 1.0 + 0.04 * tick
        goal = Goal(WAYPOINT, 2)
        output = planner.step(Inputs(now, replace(DESIRED, stamp_s=now, goal=goal),
                                     replace(ROBOT, stamp_s=now), replace(CAR, stamp_s=now)))
    assert abs(output.linear_mps) + abs(output.angular_radps) > 0.1


SENTENCES = {"goal not a number": "not a number", "goal infinite": "not a number", "outline of zero size": "no size",
             "speed limit beyond the platform's": "at most 2 m/s", "pose in the future": "in the future",
             "goal in a frame nobody knows": "frame is 'odom'"}


@pytest.mark.parametrize("case", SENTENCES)
def test_sentence_says_what_is_wrong_with_the_input(case):
    planner = MotionPlanner(MotionParameters(), FOOTPRINT, InlineExecutor())
    assert SENTENCES[case] in planner.step(BAD[case]).message.text


def test_input_that_turns_bad_in_mid_motion_gives_zero_at_once_and_goes_on_from_the_measured_speed():
    planner = MotionPlanner(MotionParameters(), FOOTPRINT, InlineExecutor())
    moving = replace(ROBOT, speed_mps=0.3)
    for tick in range(40):
        now = 1.0 + 0.04 * tick
        good = Inputs(now, replace(DESIRED, stamp_s=now), replace(moving, stamp_s=now),
                      replace(CAR, stamp_s=now))
        output = planner.step(good)
    assert output.linear_mps > 0.2
    assert planner.step(replace(good, robot=None)).linear_mps == 0.0
    assert 0.0 < planner.step(good).linear_mps < 0.3


@pytest.mark.parametrize("name, value", [("acceleration_mps2", 0.0), ("goal_heading_rad", NAN), ("corrections", -1),
                                         ("route_margin_m", 0.01)])
def test_parameter_out_of_range_is_named(name, value):
    with pytest.raises(ConfigurationError, match=name):
        parameters_from({name: value}, MotionParameters)
