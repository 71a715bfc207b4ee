"""Simulated robot whose nodes are killed, and a record of its wheel speeds."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
import random
import signal
import time
from typing import Any, Callable, Dict, List, Optional

import rospy
from nav_msgs.msg import Odometry

from mtr_core import names
from mtr_fault_injection.parts import FaultError
from mtr_fault_injection.processes import process_of
from mtr_msgs.msg import DesiredState, DriveStatus, MotionStatus, PeripheralsState, RobotMode
from mtr_simulation.stack import Stack, StackOptions

from ..faults.robot import PATIENCE, Speed, fastest_of
from ..harness.ros_shutdown import shut_down
from ..harness.speed import fastest_point_mps
from .deaths import LIMITS_S, Kill, kill_of, silence

# Limit of wall time: roslaunch restarts a node after 2 s, and its start takes some seconds on a busy machine.
BACK_LIMIT_S = 60.0
POLL_S = 0.02
# Topic that each node publishes at its ticks.
WORDS = {"dispatcher": (names.DESIRED_STATE, DesiredState), "state_machine": (names.ROBOT_MODE, RobotMode),
         "motion_planner": (names.MOTION_STATUS, MotionStatus),
         "peripherals": (names.PERIPHERALS_STATE, PeripheralsState)}
ARGUMENTS = {"respawn": "true", "scenario": "lot", "car": "gentle"}


class KilledRobot:
    """Robot under test; use as a context manager, once per process.

    Attributes:
        stack: its nodes.
    """

    def __init__(self, folder: pathlib.Path, seed: int):
        folder.mkdir(parents=True, exist_ok=True)
        parameters = folder.resolve() / "parameters.yaml"
        parameters.write_text(PATIENCE, encoding="utf-8")
        self.stack = Stack(StackOptions(folder, seed, arguments={**ARGUMENTS, "node_parameters": str(parameters)}))
        self._sent: List[Speed] = []
        self._wheels: List[Speed] = []
        self._words_s: Dict[str, List[float]] = {node: [] for node in WORDS}
        self._open = contextlib.ExitStack()

    def __enter__(self) -> "KilledRobot":
        with contextlib.ExitStack() as opened:
            opened.enter_context(self.stack)
            os.environ.update(ROS_MASTER_URI=self.stack.master_uri, ROS_IP="127.0.0.1")
            rospy.init_node("kills", disable_signals=True, disable_rostime=True)
            opened.callback(shut_down, "The test is over.")
            rospy.Subscriber(names.WHEEL_ODOMETRY, Odometry, self._take_wheels, queue_size=200, tcp_nodelay=True)
            rospy.Subscriber(names.DRIVE_STATUS, DriveStatus, self._take_sent, queue_size=200, tcp_nodelay=True)
            for node, (topic, message_type) in WORDS.items():
                rospy.Subscriber(topic, message_type, self._take_word, self._words_s[node], queue_size=200,
                                 tcp_nodelay=True)
            self._open = opened.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def kill_one(self, chance: random.Random, goes_on: Callable[[], bool]) -> Optional[Kill]:
        """Kill a random node and wait for its return; None if the node is not running. goes_on: the application is
        running."""
        node = chance.choice(list(LIMITS_S))
        killed, words = self._process_of(node), self._words_s[node]
        if killed is None or not words:
            return None
        first = len(words) - 1
        os.kill(killed, signal.SIGKILL)
        if not self._waited(lambda: self._process_of(node) not in (None, killed)):
            return kill_of(node, list(self._sent), list(self._wheels), words[-1], None, is_back=False)
        # All messages that the killed node published have arrived.
        said = len(words)
        self._waited(lambda: len(words) > said or not goes_on())
        if len(words) == said:
            return kill_of(node, list(self._sent), list(self._wheels), words[-1], None, is_back=not goes_on())
        return kill_of(node, list(self._sent), list(self._wheels), *silence(words[first:]))

    @staticmethod
    def _waited(condition: Callable[[], bool]) -> bool:
        end_s = time.monotonic() + BACK_LIMIT_S
        while not condition() and time.monotonic() < end_s:
            time.sleep(POLL_S)
        return condition()

    def _process_of(self, node: str) -> Optional[int]:
        try:
            return process_of(self.stack.master_uri, node)
        except FaultError:
            return None

    @staticmethod
    def _take_word(message: Any, words_s: List[float]) -> None:
        words_s.append(message.header.stamp.to_sec())

    def _take_sent(self, status: DriveStatus) -> None:
        self._sent.append(Speed(status.header.stamp.to_sec(),
                                fastest_point_mps(status.linear_mps, status.angular_radps)))

    def _take_wheels(self, odometry: Odometry) -> None:
        self._wheels.append(Speed(odometry.header.stamp.to_sec(), fastest_of(odometry.twist.twist)))
