"""The simulated robot with all nodes in lock-step, a scripted Operator who answers each Status, and injected faults."""
# SPDX-License-Identifier: Apache-2.0
import math
import os
import pathlib
import time
from types import SimpleNamespace
from typing import Any, Callable, List, NamedTuple

import rospy
from nav_msgs.msg import Odometry

from mtr_bringup.stack import Stack, StackOptions, free_port
from mtr_core import names
from mtr_msgs.msg import ActiveFaults
from mtr_msgs.srv import InjectFault
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.robot_link.conversions import robot_status_from
from mtr_proto import robot_link_pb2 as link

from ..harness.operator_link import OperatorLink
from ..harness.ros_shutdown import shut_down

# Wall time of a machine with much else to do.
LIMIT_S = 120.0
POLL_S = 0.005
LEGS = ((3.2, -2.2, 0.0), (-3.2, -2.2, 0.0))
MOVES_MPS = 0.3
# s of wall time for which simulated time waits for a part that is silent: each of the many silences costs it once.
PATIENCE = "/lockstep_patience_s: 0.7\n"
ARGUMENTS = {"fault_injection": "true", "resume_by_operator": "true", "scenario": "lot"}


class FaultyRobotError(Exception):
    """The robot does not come into the state that a cell needs; the text says what it does instead."""


class Speed(NamedTuple):
    """True speed of the robot at a time of the robot's clock, s, m/s."""

    time_s: float
    linear_mps: float


class FaultyRobot:
    """Use as a context manager.

    Attributes:
        statuses: all that have come, as the application understands them.
        speeds: of the robot as it really is.
    """

    def __init__(self, folder: pathlib.Path, seed: int = 1):
        self.statuses: List[RobotStatus] = []
        self.speeds: List[Speed] = []
        folder.mkdir(parents=True, exist_ok=True)
        parameters = folder.resolve() / "parameters.yaml"
        parameters.write_text(PATIENCE, encoding="utf-8")
        relay = {"node_parameters": str(parameters),
                 "fault_relay_status_port": str(free_port()), "fault_relay_command_port": str(free_port())}
        self._stack = Stack(StackOptions(folder, seed=seed, arguments={**ARGUMENTS, **relay}))
        self._begun_s = math.nan
        self._legs, self._wanted = 0, SimpleNamespace(content={})

    def __enter__(self) -> "FaultyRobot":
        self._stack.__enter__()
        os.environ.update(ROS_MASTER_URI=self._stack.master_uri, ROS_IP="127.0.0.1")
        rospy.init_node("fault_matrix", disable_signals=True, disable_rostime=True)
        rospy.Subscriber(names.SIM_TRUTH, Odometry, self._take_truth, queue_size=200, tcp_nodelay=True)
        rospy.Subscriber(names.ACTIVE_FAULTS, ActiveFaults, self._take_faults, queue_size=10)
        self._inject = rospy.ServiceProxy(names.INJECT_FAULT, InjectFault)
        self._operator = OperatorLink(self._stack.status_port, self._stack.command_port, self._take_status)
        return self

    def __exit__(self, *_: object) -> None:
        self._operator.close()
        shut_down("The matrix is over.")
        self._stack.stop()

    @property
    def status(self) -> Any:
        """The newest Status, as it came."""
        return self._operator.status

    @property
    def now_s(self) -> float:
        """Robot's clock at the newest Status."""
        return float(self.status.sent_time_s)

    @property
    def speed_mps(self) -> float:
        """Newest true speed."""
        return abs(self.speeds[-1].linear_mps) if self.speeds else 0.0

    @property
    def has_orders(self) -> bool:
        """True as soon as the Operator wanted something."""
        return bool(self._wanted.content)

    def order(self, **content: Any) -> None:
        """What the Operator wants from now on."""
        self._wanted.content = content
        self._operator.order(**content)

    def drive(self) -> None:
        """Order the next leg round the Car."""
        x, y, heading = LEGS[self._legs % len(LEGS)]
        self._legs += 1
        self.order(map_car_id=1, max_speed_mps=1.0, waypoint=link.Waypoint(id=self._legs, x=x, y=y, heading=heading))

    @property
    def is_under_way(self) -> bool:
        """True while the leg that was ordered last is wanted."""
        return "waypoint" in self._wanted.content and not self.has_arrived

    @property
    def has_arrived(self) -> bool:
        """True when the leg that was ordered last is over."""
        return bool(self.status.waypoint_id == self._legs and self.status.waypoint_result in (
            link.WAYPOINT_RESULT_REACHED, link.WAYPOINT_RESULT_REFUSED))

    def release_hold(self) -> None:
        """Have the robot go on after a fault, as the Operator does."""
        hold_id = self.status.hold_id
        if hold_id and self._wanted.content.get("resume_hold_id") != hold_id:
            self.order(**{**self._wanted.content, "resume_hold_id": hold_id})

    def begin(self, part: str, kind: str, duration_s: float, amount: float) -> float:
        """Let a part have a fault; the robot's clock when it begins."""
        self._begun_s = math.nan
        answer = self._inject(part, kind, duration_s, amount)
        if not answer.accepted:
            raise FaultyRobotError(answer.message)
        self.wait_until(lambda: not math.isnan(self._begun_s), "the fault")
        return self._begun_s

    def wait_until(self, condition: Callable[[], Any], what: str, meanwhile: Callable[[], None] = lambda: None) -> None:
        """Wait, by wall time; FaultyRobotError when it takes longer."""
        end_s = time.monotonic() + LIMIT_S
        while not condition():
            if time.monotonic() > end_s:
                said = [note.text for note in self.status.notifications]
                raise FaultyRobotError(f"{what} has not come to pass; the robot says {said}; see {self._stack.log}.")
            meanwhile()
            time.sleep(POLL_S)

    def _take_faults(self, active: ActiveFaults) -> None:
        if active.faults:
            self._begun_s = active.header.stamp.to_sec()

    def _take_status(self) -> None:
        self.statuses.append(robot_status_from(self.status))

    def _take_truth(self, odometry: Any) -> None:
        self.speeds.append(Speed(odometry.header.stamp.to_sec(), odometry.twist.twist.linear.x))
