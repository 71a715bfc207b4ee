#!/usr/bin/env python3
"""Service mode: wheels, lift and servos stay still for every kind of order, also after a restart. Hazard H23"""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import secrets
import signal
import sys
import tempfile
import threading
import time
import unittest

import roslib.packages
import rospy
import rostest
import yaml
import zmq
from case import case
from live_robot import CRUISE_MPS, LiveRobot, wait_until
from node_process import NodeProcess
from scripted_time import Speaker

from mtr_core import names, schedule
from mtr_core.crc import seal
from mtr_dispatcher.service.file import FILE_NAME
from mtr_msgs.msg import (
    FirmwareCommand,
    FirmwarePress,
    FirmwareState,
    LiftCommand,
    PeripheralsState,
    RobotMode,
    VelocityCommand,
)
from mtr_msgs.srv import OrderServiceMode, OrderServiceModeRequest
from mtr_proto import robot_link_pb2 as link

STATUS_PORT, COMMAND_PORT = 25334, 25333
STATUS_PERIOD_S, FIRMWARE_PERIOD_S = 0.1, 0.04
US_PER_S = 1e6
LOW_M, HIGH_M = 0.6, 1.2
STANDS_WITHIN_S = 1.5
# What a robot that is not locked needs to set off, with some room.
WATCHED_S = 2.5
# Python nodes of a busy machine need some time to start.
STARTS_WITHIN_S = 90.0


class Board:
    """The board of lift and servos as its topics show it: it reports, and records what it is ordered to do."""

    def __init__(self):
        self.commands, self.presses = [], []
        self._publisher = rospy.Publisher(names.FIRMWARE_STATE, FirmwareState, queue_size=1)
        self._subscribers = (rospy.Subscriber(names.FIRMWARE_COMMAND, FirmwareCommand, self.commands.append),
                             rospy.Subscriber(names.FIRMWARE_PRESS, FirmwarePress, self.presses.append))
        self._timer = rospy.Timer(rospy.Duration(FIRMWARE_PERIOD_S), self._report)

    def _report(self, _):
        now_us = int(time.monotonic() * US_PER_S) % 2 ** 32
        done = self.presses[-1].id if self.presses else 0
        self._publisher.publish(seal(FirmwareState(
            time_us=now_us, lift_height_m=0.3, press_id=done, press_state=2 if done else 0,
            press_start_us=now_us if done else 0, press_end_us=now_us if done else 0)))


class Application:
    """The Operator's end of the link: a thread answers each Status with the same content."""

    def __init__(self):
        self.session_id, self.content, self.status = secrets.randbits(63) | 1, {}, link.Status()
        self._over, self._number, self._sent = threading.Event(), 0, None
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        context = zmq.Context.instance()
        with context.socket(zmq.SUB) as statuses, context.socket(zmq.PUB) as commands:
            statuses.setsockopt(zmq.SUBSCRIBE, b"")
            statuses.connect(f"tcp://127.0.0.1:{STATUS_PORT}")
            commands.connect(f"tcp://127.0.0.1:{COMMAND_PORT}")
            while not self._over.is_set():
                if statuses.poll(1000 * STATUS_PERIOD_S):
                    status = link.Status.FromString(statuses.recv())
                    content = dict(self.content)
                    self._number += content != self._sent
                    self._sent = content
                    commands.send(link.Command(session_id=self.session_id, id=self._number, seen_status_id=status.id,
                                               seen_robot_time_s=status.sent_time_s, **content).SerializeToString())
                    self.status = status

    def close(self):
        """Fall silent."""
        self._over.set()
        self._thread.join()


class ServiceModeTest(unittest.TestCase):
    """The state machine and the manual controller are scripted; no order of theirs ever ends."""

    press_id = 0

    @classmethod
    def setUpClass(cls):
        rospy.init_node("service_mode_test")
        cls.robot = LiveRobot()
        cls.robot.speakers = [each for each in cls.robot.speakers if each is not cls.robot.dispatcher
                              and not isinstance(each.message, PeripheralsState)]
        for each in cls.robot.speakers:
            if isinstance(each.message, RobotMode):
                each.message.mode = RobotMode.FOLLOWING_WAYPOINT
        cls.planner = cls.robot.planner.message
        cls.by_hand = Speaker(names.MANUAL_VELOCITY, VelocityCommand(), schedule.CONTROLLER_INPUT)
        cls.lift_by_hand = Speaker(names.MANUAL_LIFT, LiftCommand(), schedule.CONTROLLER_INPUT)
        cls.robot.speakers += [cls.by_hand, cls.lift_by_hand]
        cls.robot.start()
        cls.board = Board()

    @classmethod
    def tearDownClass(cls):
        cls.robot.close()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.nodes = {}
        self.application = Application()
        self.start()
        self.order_nothing()

    def tearDown(self):
        self.application.close()
        for node in self.nodes.values():
            node.stop()
        self.folder.cleanup()

    def start(self):
        """Start the robot's software."""
        calibration = pathlib.Path(roslib.packages.get_pkg_dir("mtr_peripherals")) / "config/calibration.yaml"
        for name, value in yaml.safe_load(calibration.read_text(encoding="utf-8")).items():
            rospy.set_param(f"/peripherals/{name}", value)
        rospy.set_param("/peripherals/emergency_owners", ["service_mode"])
        self.nodes = {
            "drive_control": NodeProcess("mtr_drive_control", "drive_control_node", "drive_control"),
            "peripherals": NodeProcess("mtr_peripherals", "peripherals_node", "peripherals"),
            "dispatcher": NodeProcess("mtr_dispatcher", "dispatcher_node", "dispatcher", simulated=True,
                                      service_folder=self.folder.name, status_port=STATUS_PORT,
                                      command_port=COMMAND_PORT, service_release_s=30.0)}

    def kill(self, *nodes):
        """End these without a chance to say anything."""
        for name in nodes:
            self.nodes[name].signal(signal.SIGKILL)
            self.nodes[name].exit_status()

    def restart(self):
        """A loss of power, and the next start; another application comes to control the robot."""
        self.kill(*self.nodes)
        self.application.close()
        self.start()
        self.application = Application()

    def order_nothing(self):
        """Withdraw every order."""
        self.planner.active = self.by_hand.message.active = False
        self.planner.linear_mps = self.by_hand.message.linear_mps = self.lift_by_hand.message.rate_mps = 0.0
        self.application.content = {}

    def order(self, kind):
        """Order motion in one way."""
        self.order_nothing()
        if kind == "autonomous":
            self.planner.linear_mps, self.planner.active = CRUISE_MPS, True
        elif kind == "manual":
            self.by_hand.message.linear_mps, self.by_hand.message.active = 0.3, True
        elif kind == "lift by hand":
            self.lift_by_hand.message.rate_mps = 0.1
        elif kind == "lift":
            self.application.content = {"device_height_m": HIGH_M}
        else:
            ServiceModeTest.press_id += 1
            press = link.ButtonPress(id=self.press_id, buttons=[1], strength=1.0, duration_s=0.1)
            self.application.content = {"press": press}

    def moves(self, kind):
        """Wait until the robot does what was ordered in this way."""
        count, presses = len(self.board.commands), len(self.board.presses)
        self.order(kind)
        wait_until({
            "autonomous": lambda: self.robot.speed_mps > CRUISE_MPS / 2.0,
            "manual": lambda: self.robot.speed_mps > 0.1,
            "lift by hand": lambda: self.lifts(count), "lift": lambda: self.lifts(count),
            "press": lambda: len(self.board.presses) > presses}[kind], kind, STARTS_WITHIN_S)
        self.order_nothing()
        wait_until(lambda: self.robot.speed_mps == 0.0, "standstill")

    def lifts(self, since):
        """The board was ordered to move the lift since then."""
        return any(not each.stop and not math.isnan(each.lift_height_m) for each in self.board.commands[since:])

    def assert_still(self, kind):
        """For longer than the robot would take to set off neither wheels nor board are ordered to move."""
        self.order(kind)
        wait_until(lambda: self.robot.speed_mps == 0.0, "standstill", STANDS_WITHIN_S)
        wheels, commands, presses = (len(each) for each in (self.robot.commands, self.board.commands,
                                                           self.board.presses))
        time.sleep(WATCHED_S)
        with case(kind):
            self.assertEqual([speed for _, speed in self.robot.commands[wheels:] if speed], [])
            self.assertEqual([each for each in self.board.commands[commands:] if not each.stop], [])
            self.assertEqual(self.board.presses[presses:], [])

    def assert_all_still(self):
        """Of all kinds of orders."""
        for kind in KINDS:
            self.assert_still(kind)
        self.order_nothing()

    def enter(self):
        """The Operator enters service mode while the robot drives."""
        self.order("autonomous")
        wait_until(lambda: self.robot.speed_mps > CRUISE_MPS / 2.0, "driving", STARTS_WITHIN_S)
        self.application.content = {"enter_service": True}
        self.wait_for(True)
        self.application.content = {}

    def wait_for(self, is_active):
        """Wait until Status says so."""
        wait_until(lambda: self.application.status.id and self.application.status.service_mode.active is is_active,
                   f"service mode {is_active}", STARTS_WITHIN_S)

    def call(self, order):
        """A person at the robot; what the robot answers."""
        rospy.wait_for_service(names.SERVICE_MODE_REQUEST, STARTS_WITHIN_S)
        return rospy.ServiceProxy(names.SERVICE_MODE_REQUEST, OrderServiceMode)(order)

    def release(self):
        """Both sides; the robot's first."""
        self.assertTrue(self.call(OrderServiceModeRequest.RELEASE).accepted)
        wait_until(lambda: self.application.status.service_mode.HasField("robot_agrees_s"), "the robot's release")
        self.application.content = {"leave_service_id": self.application.status.service_mode.id}
        self.wait_for(False)
        self.application.content = {}

    def test_every_kind_of_order_moves_the_robot_and_none_does_in_service_mode_over_a_restart(self):
        for kind in KINDS:
            self.moves(kind)
        self.enter()
        self.assert_all_still()
        self.restart()
        self.assert_all_still()
        self.wait_for(True)
        codes = [each.code for each in self.application.status.service_mode.problems]
        self.assertEqual(codes, ["dispatcher.service_mode", "dispatcher.service_restored"])
        self.release()
        for kind in KINDS:
            self.moves(kind)

    def test_one_side_alone_releases_nothing(self):
        self.assertTrue(self.call(OrderServiceModeRequest.ENTER).accepted)
        self.wait_for(True)
        self.assertTrue(self.call(OrderServiceModeRequest.RELEASE).accepted)
        self.assert_still("autonomous")
        self.call(OrderServiceModeRequest.ENTER)
        wait_until(lambda: not self.application.status.service_mode.HasField("robot_agrees_s"), "withdrawn release")
        self.application.content = {"leave_service_id": self.application.status.service_mode.id}
        wait_until(lambda: self.application.status.service_mode.HasField("operator_agrees_s"), "the Operator's release")
        self.planner.linear_mps, self.planner.active = CRUISE_MPS, True
        time.sleep(WATCHED_S)
        self.assertEqual(self.robot.speed_mps, 0.0)
        self.assertFalse(self.call(0).accepted)

    def test_nodes_that_die_in_service_mode_release_nothing(self):
        self.enter()
        self.kill("dispatcher")
        self.assert_still("autonomous")
        self.assert_still("lift by hand")

    def test_file_that_cannot_be_read_is_service_mode(self):
        self.moves("autonomous")
        self.kill(*self.nodes)
        (pathlib.Path(self.folder.name) / FILE_NAME).write_text("{", encoding="utf-8")
        self.application.close()
        self.start()
        self.application = Application()
        self.wait_for(True)
        self.assert_still("autonomous")
        self.assert_still("lift by hand")
        self.release()
        self.moves("autonomous")


KINDS = ("autonomous", "manual", "lift by hand", "lift", "press")


if __name__ == "__main__":
    rostest.rosrun("mtr_tests", "service_mode_test", ServiceModeTest, sys.argv)
