"""A stop counts as confirmed by a Status that was sent after the robot had taken it, however late the laptop reads."""
# SPDX-License-Identifier: Apache-2.0
import collections

import pytest

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.pose_history import STANDING_MPS
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import Waypoint
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.robot_link.virtual.robot import VirtualWorld

DRIVE = {"stop": False, "waypoint": Waypoint(1, Pose(-8.0, 6.0, 0.0)), "max_speed_mps": 0.5}


class LateLink(FakeRobotLink):
    """A laptop that is so many Statuses behind; its orders reach the robot at once, or never."""

    def __init__(self, behind):
        super().__init__(1, world=VirtualWorld(starting_s=0.0, mapping_s=0.0))
        self.behind, self.is_deaf, self._queue = behind, False, collections.deque()

    def next_status(self, timeout_s):
        while len(self._queue) <= self.behind:
            self._queue.append(super().next_status(timeout_s))
        return self._queue.popleft()

    def send(self, desired):
        if not self.is_deaf:
            super().send(desired)
        elif desired != self._desired:
            self._command_id, self._desired = self._command_id + 1, desired


@pytest.fixture(name="loop_behind")
def loop_behind_fixture():
    def loop_behind(behind):
        link = LateLink(0)
        link.connect()
        loop = ControlLoop(link, AbsentCarLink())
        link.behind = behind
        return loop, link
    return loop_behind


@pytest.mark.parametrize("behind", [0, 1, 20, 31, 50])
def test_robot_that_stops_is_confirmed_however_far_behind_the_laptop_is(loop_behind, behind):
    loop, link = loop_behind(behind)
    loop.change(**DRIVE)
    for _ in range(behind + 5):
        loop.step()
    assert abs(loop.status.speed_mps) > STANDING_MPS
    assert loop.halt() is True
    assert abs(loop.status.speed_mps) < STANDING_MPS and link.is_answered(loop.status)


@pytest.mark.parametrize("behind", [0, 1, 20, 50])
def test_status_of_a_robot_that_stood_before_confirms_nothing(loop_behind, behind):
    loop, link = loop_behind(behind)
    for _ in range(behind + 1):
        loop.step()
    loop.change(**DRIVE)
    loop.step()
    assert abs(loop.status.speed_mps) < STANDING_MPS or behind == 0
    assert loop.halt() is True and link.is_answered(loop.status)


@pytest.mark.parametrize("behind", [0, 50])
def test_stop_that_the_robot_never_takes_is_not_confirmed(loop_behind, behind):
    loop, link = loop_behind(behind)
    loop.step()
    link.is_deaf = True
    assert loop.halt() is False


@pytest.mark.parametrize(("is_cancelled", "is_kept"), [(False, False), (True, True)], ids=["by itself", "Operator"])
def test_end_of_a_run_withdraws_its_orders_and_the_operators_stop_does_not(is_cancelled, is_kept):
    link = FakeRobotLink(1, world=VirtualWorld(starting_s=0.0, mapping_s=0.0))
    link.connect()
    wish = [False]
    loop = ControlLoop(link, AbsentCarLink(), is_cancelled=lambda: wish[0])
    loop.step()
    loop.change(**DRIVE, map_car_id=3, check_car_id=2)
    loop.step()
    wish[0] = is_cancelled
    assert loop.halt() is True
    orders = (loop.desired.waypoint, loop.desired.map_car_id, loop.desired.check_car_id)
    assert loop.desired.stop and orders == ((DRIVE["waypoint"], 3, 2) if is_kept else (None, 0, 0))


def test_stop_of_a_scenario_withdraws_its_waypoint_and_the_next_one_counts():
    link = FakeRobotLink(1, world=VirtualWorld(starting_s=0.0, mapping_s=0.0))
    link.connect()
    loop = ControlLoop(link, AbsentCarLink())
    robot = Robot(loop)
    robot.drive_to(Pose(-8.0, 6.0, 0.0))
    loop.step()
    robot.stop()
    assert loop.desired.stop and loop.desired.waypoint is None
    robot.drive_to(Pose(-7.0, 6.0, 0.0))
    assert not loop.desired.stop and loop.desired.waypoint.id == 2
