"""A clock of the robot that is set makes no wait shorter and none longer."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.robot import REACH_LIMIT_S, Robot
from mtr_operator.domain.actions.trouble import LineInvalid
from mtr_operator.domain.clocks.waiting_time import WaitingTime
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.robot_status import RobotStatus, WaypointResult

AHEAD = Ray(0.0, 0.0, 1.0, 0.0)
SET_S, HOUR_S = 3.0, 3600.0
SETS = pytest.mark.parametrize("by_s", [HOUR_S, -HOUR_S, 30.0, -5.0])


def told(number, stamp_s, steady_s, session_id=1):
    return RobotStatus(number, session_id, stamp_s, sent_s=stamp_s, steady_s=steady_s)


@SETS
def test_time_goes_on_where_the_clock_is_set(by_s):
    waiting = WaitingTime()
    for number in range(100):
        steady_s = 50.0 + 0.1 * number
        stamp_s = 1000.0 + 0.1 * number + by_s * (number >= 40)
        waiting.learn(told(number, stamp_s, steady_s))
        assert waiting.at(stamp_s) == pytest.approx(1000.0 + 0.1 * number)


def test_pose_of_before_the_clock_was_set_counts_by_its_own_stamp():
    waiting = WaitingTime()
    stamps = [(10.0, 10.0), (10.1, 10.1), (HOUR_S + 10.2, 10.2), (HOUR_S + 10.3, 10.3)]
    for number, (stamp_s, time_s) in enumerate(stamps):
        # The Status says by its own time of sending that the clock was set one Status sooner.
        status = replace(told(number, stamp_s, 70.0 + 0.1 * number), sent_s=stamp_s + HOUR_S * (number == 1))
        waiting.learn(status)
        assert waiting.at(stamp_s) == pytest.approx(time_s)


def test_without_a_set_clock_it_is_the_robots_time_to_the_last_digit():
    waiting = WaitingTime()
    for number in range(50):
        # A pose's stamp is older than its Status by another time each time.
        stamp_s = 1.7e9 + 0.1 * number - 0.01 * (number % 7)
        waiting.learn(told(number, stamp_s, 70.0 + 0.1 * number))
        assert waiting.at(stamp_s) == stamp_s


@pytest.mark.parametrize("second", [told(2, 5000.0, 2.0, session_id=2), told(2, 5000.0, math.nan)],
                         ids=["another start", "a robot of before"])
def test_nobody_knows_by_how_much_another_robots_clock_was_set(second):
    waiting = WaitingTime()
    waiting.learn(told(1, 10.0, 70.0))
    waiting.learn(second)
    assert waiting.at(5000.0) == 5000.0


@pytest.fixture
def robot(robot_link, car_link):
    made = Robot(ControlLoop(robot_link, car_link))
    made.set_maximum_speed(0.1)
    made.go_to(AHEAD, 4.0)
    made.wait_until_reached()
    return made


def set_clock(world, by_s, **changes):
    """Some seconds after the start, for good."""
    begin_s = world.time_s
    world.spoil = lambda status: replace(
        status, **changes,
        **{name: status.stamp_s + by_s * (status.stamp_s > begin_s + SET_S) for name in ("stamp_s", "sent_s")})


@SETS
def test_robot_that_is_on_its_way_gets_there(robot, world, by_s):
    begun_s = world.time_s
    set_clock(world, by_s)
    robot.go_to(AHEAD, 3.0, Direction.FORWARD)
    assert robot.wait_until_reached() is None and robot.is_at_waypoint()
    assert world.time_s - begun_s == pytest.approx(10.0, abs=0.5)


@SETS
def test_robot_that_never_gets_there_is_waited_for_as_long_as_ever(robot, world, by_s):
    set_clock(world, by_s, waypoint_result=WaypointResult.PENDING)
    robot.go_to(AHEAD, 3.0, Direction.FORWARD)
    begun_s = world.time_s
    with pytest.raises(LineInvalid, match="did not reach the waypoint within 180 s"):
        robot.wait_until_reached()
    assert world.time_s - begun_s == pytest.approx(REACH_LIMIT_S, abs=0.5)
