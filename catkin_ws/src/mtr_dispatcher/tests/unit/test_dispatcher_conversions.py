"""Conversion of the desired state to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
import rospy

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import Press, Waypoint
from mtr_core.se2 import Pose2
from mtr_dispatcher.command import Command
from mtr_dispatcher.conversions import desired_message, lock_message
from mtr_dispatcher.session import SessionState

NOBODY = Problem("dispatcher.nobody", "No application.")
STAMP = rospy.Time(12, 34)


def test_whole_command_arrives_in_the_message():
    sent = Waypoint(1, "application/5", "car", Pose2(2.0, 3.0, 0.5), 2)
    command = Command(5, 6, waypoint=sent, max_speed_mps=0.7, key_height_m=1.2, press=Press(4, 5, (1, 2), 0.5, 0.25),
                      map_car_id=9, check_car_id=2)
    message = desired_message(SessionState(5, command, 3, 7, True, NO_PROBLEM), STAMP, 0.5)
    waypoint, press = message.waypoint, message.press
    assert (message.session_id, message.command_id, message.link_alive, message.stop) == (5, 6, True, False)
    assert (waypoint.id, waypoint.frame_id, waypoint.x, waypoint.y) == (1, "car", 2.0, 3.0)
    assert (waypoint.heading, waypoint.direction, waypoint.requester) == (0.5, 2, "application/5")
    assert (press.id, press.buttons, press.strength, press.duration_s) == (4, [1, 2], 0.5, 0.25)
    assert (message.max_speed_mps, message.key_height_m, message.map_car_id) == (0.7, 1.2, 3)
    assert message.check_car_id == 7
    assert message.header.stamp == STAMP


def test_what_the_command_leaves_open_becomes_the_default():
    message = desired_message(SessionState(0, Command(), 0, 0, False, NOBODY), STAMP, 0.5)
    assert (message.waypoint.id, message.press.id, message.map_car_id, message.max_speed_mps) == (0, 0, 0, 0.5)
    assert math.isnan(message.key_height_m) and message.stop


@pytest.mark.parametrize("limit_mps, asked_mps, given_mps", [(0.3, 0.7, 0.3), (0.3, 0.2, 0.2), (0.3, None, 0.3),
                                                              (math.inf, 0.7, 0.7), (math.inf, None, 0.5)])
def test_slow_link_lowers_the_maximum_speed_and_never_raises_it(limit_mps, asked_mps, given_mps):
    state = SessionState(5, Command(5, 6, max_speed_mps=asked_mps), 0, 0, True, NO_PROBLEM, limit_mps)
    assert desired_message(state, STAMP, 0.5).max_speed_mps == given_mps


def test_lock_carries_the_reason():
    message = lock_message(SessionState(0, Command(), 0, 0, False, NOBODY), STAMP)
    assert (message.owner, message.engaged, message.reason) == ("dispatcher", True, "No application.")
    assert [problem.code for problem in message.problems] == [NOBODY.code]
    assert not lock_message(SessionState(1, Command(), 0, 0, True, NO_PROBLEM), STAMP).engaged
