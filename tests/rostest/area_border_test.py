#!/usr/bin/env python3
"""A test area from the core of the window to the wheels: drive control stops the robot before its border."""
# SPDX-License-Identifier: Apache-2.0
import socket
import sys
import threading
import unittest

import rospy
import rostest
from live_robot import CRUISE_MPS, LiveRobot, wait_until
from node_process import NodeProcess
from scripted_time import Speaker

from mtr_core import names, schedule
from mtr_description.robot_description import described_robot
from mtr_msgs.msg import DriveStatus, LocalizedPose, VelocityCommand
from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.errors import OperatorError
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.station.links.idle_loop import IdleLoop
from mtr_operator.station.links.stop_order import StopOrder
from mtr_operator.station.links.watched_link import WatchedRobotLink

# Of a localization that has just started; more than a number of XML-RPC holds.
ORIGIN = 2 ** 60 + 1
AHEAD_M, SIDE_M = 3.0, 2.0
SIGMA_M = 0.01
# What drive control keeps from the border: its gap and 2 sigma of the position.
MARGIN_M = 0.05 + 2.0 * SIGMA_M
REMAINS_M = 0.25


class PoseSpeaker(Speaker):
    """Localization that follows the wheels exactly."""

    def __init__(self, odometry):
        covariance = [0.0] * 9
        covariance[0] = covariance[4] = SIGMA_M ** 2
        super().__init__(names.LOCALIZED_POSE, LocalizedPose(valid=True, origin_id=ORIGIN, covariance=covariance),
                         schedule.LOCALIZATION)
        self._odometry = odometry

    def speak(self, tick_ns):
        """Say where the robot is."""
        self.message.x = self._odometry.message.pose.pose.position.x
        super().speak(tick_ns)


class Window:
    """What the window does between two tests, in a thread of its own; nothing is drawn.

    Attributes: area: what the robot reports of its area.
    """

    def __init__(self, status_port, command_port):
        link = WatchedRobotLink(ZmqRobotLink("127.0.0.1", status_port, command_port), StopOrder())
        wait_until(lambda: connects(link), "ports of the dispatcher", 60.0)
        self._link, self._requests, self.area = link, [], None
        self._idle = IdleLoop(link, AbsentCarLink())
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def set_area(self, corners):
        """Order an area in the frame that the robot reports."""
        origin_id = self.area.origin_id
        self._requests.append(lambda: self._idle.set_area(corners, origin_id))

    def close(self):
        """Say goodbye."""
        self._over.set()
        self._thread.join()
        self._link.close()

    def _run(self):
        while not self._over.is_set():
            while self._requests:
                self._requests.pop(0)()
            snapshot = self._idle.step()
            if snapshot is not None:
                self.area = snapshot.status.area


def connects(link):
    """True once the robot's ports are open."""
    try:
        link.connect()
    except OperatorError:
        return False
    return True


def free_ports():
    """Two TCP ports that nobody uses."""
    sockets = [socket.socket() for _ in range(2)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class AreaBorder(unittest.TestCase):
    """The planner wants to drive ahead for ever."""

    def setUp(self):
        rospy.set_param(names.ROBOT_RUN, "area_border_test")
        self.ports = free_ports()
        self.robot = LiveRobot()
        self.pose = PoseSpeaker(self.robot.odometry)
        self.manual = Speaker(names.MANUAL_VELOCITY, VelocityCommand(), schedule.CONTROLLER_INPUT)
        self.robot.speakers.remove(self.robot.dispatcher)
        self.robot.speakers += [self.pose, self.manual]
        self.robot.planner.message.linear_mps, self.robot.planner.message.active = CRUISE_MPS, True
        self.farthest_m = 0.0
        self.code = ""
        self.status = rospy.Subscriber(names.DRIVE_STATUS, DriveStatus, self.take_status, queue_size=50)
        self.robot.start()
        self.addCleanup(self.robot.close)
        self.dispatcher = self.start_dispatcher()
        self.addCleanup(self.stop_dispatcher)
        self.drive = NodeProcess("mtr_drive_control", "drive_control_node", "drive_control")
        self.addCleanup(self.drive.stop)
        self.window = Window(*self.ports)
        self.addCleanup(self.window.close)

    def start_dispatcher(self):
        """That of a real robot."""
        status_port, command_port = self.ports
        return NodeProcess("mtr_dispatcher", "dispatcher_node", "dispatcher", status_port=status_port,
                           command_port=command_port)

    def stop_dispatcher(self):
        """The one that runs now."""
        self.dispatcher.stop()

    def take_status(self, message):
        """Note how far the robot has come, and what drive control says."""
        self.code = message.problems[0].code if message.problems else ""
        self.farthest_m = max(self.farthest_m, self.front_m)

    @property
    def front_m(self):
        """Front of the footprint, the key included."""
        return self.robot.odometry.message.pose.pose.position.x + described_robot().footprint().front_m

    def wait_at_border(self):
        """The robot stands at the border ahead, with its margin."""
        wait_until(lambda: self.code == "drive_control.area_border" and self.robot.speed_mps == 0.0, "border", 40.0)
        self.assertLess(self.farthest_m, AHEAD_M - MARGIN_M + 0.01)
        self.assertGreater(self.front_m, AHEAD_M - MARGIN_M - REMAINS_M)

    def test_robot_drives_when_its_area_is_set_and_stops_at_the_border_whoever_drives(self):
        wait_until(lambda: self.window.area is not None and self.window.area.origin_id == ORIGIN, "status of the robot")
        self.assertEqual([problem.code for problem in self.window.area.problems], ["dispatcher.no_area"])
        wait_until(lambda: self.code == "drive_control.area_missing", "the reason to stand")
        self.assertEqual(self.farthest_m, described_robot().footprint().front_m)

        corners = ((AHEAD_M, SIDE_M), (-SIDE_M, SIDE_M), (-SIDE_M, -SIDE_M), (AHEAD_M, -SIDE_M))
        self.window.set_area(corners)
        wait_until(lambda: self.window.area.corners == corners and not self.window.area.problems, "echo of the area")
        self.wait_at_border()

        # A new dispatcher knows the area of the former one.
        self.dispatcher.stop()
        self.dispatcher = self.start_dispatcher()
        self.code = ""
        self.wait_at_border()
        self.assertEqual(self.window.area.corners, corners)

        command = self.manual.message
        command.active, command.linear_mps = True, CRUISE_MPS
        self.code = ""
        self.wait_at_border()
        command.linear_mps = -CRUISE_MPS
        wait_until(lambda: self.front_m < AHEAD_M - 1.0, "way back by hand")
        command.linear_mps = CRUISE_MPS
        self.wait_at_border()

        # A map that began elsewhere: the planner moves nothing, and a person crawls.
        self.pose.message.origin_id = ORIGIN + 1
        command.linear_mps = -CRUISE_MPS
        wait_until(lambda: self.code == "drive_control.area_of_other_origin" and self.robot.speed_mps < 0.0, "crawl")
        self.assertGreaterEqual(self.robot.speed_mps, -0.1001)
        command.active = False
        wait_until(lambda: self.robot.speed_mps == 0.0, "standstill without a person")
        wait_until(lambda: "dispatcher.area_of_other_origin" in [problem.code for problem in self.window.area.problems],
                   "reason for the Operator")


if __name__ == "__main__":
    rospy.init_node("area_border_test")
    rostest.rosrun("mtr_tests", "area_border_test", AreaBorder, sys.argv)
