"""Bad input never moves the robot, bad parameters never start the node."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import parameters_from
from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL_ID, Goal, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Result
from mtr_motion_planner.inputs import Car, Inputs, Order, RobotState
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.planner import MotionPlanner
from mtr_motion_planner.replanning import InlineExecutor

NAN = math.nan
CAR = Car(1.0, True, Pose2(0, 0, 0), ((2.2, .9), (-2.2, .9), (-2.2, -.9), (2.2, -.9)))
ROBOT = RobotState(1.0, True, Pose2(4.0, 0.0, 0.0), 0.0, 0.0)
WAYPOINT = Waypoint(1, "application/5", "car", Pose2(6.0, 0.0, 0.0))
ORDER = Order(1.0, Goal(WAYPOINT, 1), 0.5)
GOOD = Inputs(1.0, ORDER, ROBOT, CAR)


def with_goal(pose):
    return with_waypoint(pose=pose)


def with_waypoint(**changes):
    return dataclasses.replace(ORDER, goal=Goal(dataclasses.replace(WAYPOINT, **changes), 1))


BAD = {
    "no order": dataclasses.replace(GOOD, order=None),
    "no pose": dataclasses.replace(GOOD, robot=None),
    "no car": dataclasses.replace(GOOD, car=None),
    "old pose": dataclasses.replace(GOOD, robot=dataclasses.replace(ROBOT, stamp_s=0.65)),
    "old order": dataclasses.replace(GOOD, order=dataclasses.replace(ORDER, stamp_s=0.65)),
    "old car": dataclasses.replace(GOOD, car=dataclasses.replace(CAR, stamp_s=0.65)),
    "stamp not a number": dataclasses.replace(GOOD, robot=dataclasses.replace(ROBOT, stamp_s=NAN)),
    "lost": dataclasses.replace(GOOD, robot=dataclasses.replace(ROBOT, valid=False, message=Problem(text="No scan."))),
    "pose not a number": dataclasses.replace(GOOD, robot=dataclasses.replace(ROBOT, pose=Pose2(NAN, 0, 0))),
    "speed infinite": dataclasses.replace(GOOD, robot=dataclasses.replace(ROBOT, speed_mps=math.inf)),
    "car not a number": dataclasses.replace(GOOD, car=dataclasses.replace(CAR, pose=Pose2(0, 0, NAN))),
    "outline not a number": dataclasses.replace(GOOD, car=dataclasses.replace(CAR, outline=((NAN, 0), (1, 1), (2, 0)))),
    "no outline": dataclasses.replace(GOOD, car=dataclasses.replace(CAR, outline=())),
    "goal not a number": dataclasses.replace(GOOD, order=with_goal(Pose2(6.0, NAN, 0.0))),
    "goal infinite": dataclasses.replace(GOOD, order=with_goal(Pose2(math.inf, 0.0, 0.0))),
    "speed limit not a number": dataclasses.replace(GOOD, order=dataclasses.replace(ORDER, max_speed_mps=NAN)),
    "pose in the future": dataclasses.replace(GOOD, robot=dataclasses.replace(ROBOT, stamp_s=1.35)),
    "order in the future": dataclasses.replace(GOOD, order=dataclasses.replace(ORDER, stamp_s=1.35)),
    "car in the future": dataclasses.replace(GOOD, car=dataclasses.replace(CAR, stamp_s=1.35)),
    "goal in a frame nobody knows": dataclasses.replace(GOOD, order=with_waypoint(frame="odom")),
    "outline of zero size": dataclasses.replace(GOOD, car=dataclasses.replace(CAR, outline=((0.0, 0.0),) * 4)),
    "speed limit beyond the platform's": dataclasses.replace(GOOD, order=dataclasses.replace(ORDER, max_speed_mps=2.1)),
    "speed limit zero": dataclasses.replace(GOOD, order=dataclasses.replace(ORDER, max_speed_mps=0.0)),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_gives_zero_velocity(case):
    output = MotionPlanner(MotionParameters(), InlineExecutor()).step(BAD[case])
    assert (output.linear_mps, output.angular_radps) == (0.0, 0.0)
    assert output.result in (Result.IDLE, Result.PENDING, Result.REFUSED)
    assert output.message.text.endswith(".") or output.goal_id == NO_GOAL_ID


@pytest.mark.parametrize("case", BAD)
def test_robot_sets_out_when_the_input_is_good_again(case):
    planner = MotionPlanner(MotionParameters(), InlineExecutor())
    planner.step(BAD[case])
    for tick in range(1, 20):
        now = 1.0 + 0.04 * tick
        goal = Goal(WAYPOINT, 2)
        output = planner.step(Inputs(now, dataclasses.replace(ORDER, stamp_s=now, goal=goal),
                                     dataclasses.replace(ROBOT, stamp_s=now), dataclasses.replace(CAR, stamp_s=now)))
    assert abs(output.linear_mps) + abs(output.angular_radps) > 0.1


SENTENCES = {"goal not a number": "not a number", "goal infinite": "not a number", "outline of zero size": "no size",
             "speed limit beyond the platform's": "at most 2 m/s", "pose in the future": "in the future",
             "goal in a frame nobody knows": "frame is 'odom'"}


@pytest.mark.parametrize("case", SENTENCES)
def test_sentence_says_what_is_wrong_with_the_input(case):
    assert SENTENCES[case] in MotionPlanner(MotionParameters(), InlineExecutor()).step(BAD[case]).message.text


def test_input_that_turns_bad_in_mid_motion_gives_zero_at_once_and_goes_on_from_the_measured_speed():
    planner = MotionPlanner(MotionParameters(), InlineExecutor())
    moving = dataclasses.replace(ROBOT, speed_mps=0.3)
    for tick in range(40):
        now = 1.0 + 0.04 * tick
        good = Inputs(now, dataclasses.replace(ORDER, stamp_s=now), dataclasses.replace(moving, stamp_s=now),
                      dataclasses.replace(CAR, stamp_s=now))
        output = planner.step(good)
    assert output.linear_mps > 0.2
    assert planner.step(dataclasses.replace(good, robot=None)).linear_mps == 0.0
    assert 0.0 < planner.step(good).linear_mps < 0.3


@pytest.mark.parametrize("name, value", [("acceleration_mps2", 0.0), ("goal_heading_rad", NAN), ("corrections", -1),
                                         ("route_margin_m", 0.01)])
def test_parameter_out_of_range_is_named(name, value):
    with pytest.raises(ConfigurationError, match=name):
        parameters_from({name: value}, MotionParameters)
