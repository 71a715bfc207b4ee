"""Simulated robot with all nodes in real time, driven by a scripted Operator and observed."""
# SPDX-License-Identifier: Apache-2.0
import math
import os
import pathlib
import time
from typing import Any, Callable, Dict, List, Optional

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from mtr_core import names, schedule
from mtr_fault_injection.processes import process_of
from mtr_proto import robot_link_pb2 as link
from mtr_simulation.stack import Stack, StackOptions

from ..harness.operator_link import OperatorLink
from ..harness.ros_shutdown import shut_down
from .judge import Motion

# Layout of a game controller; see mtr_controller_input.
AXES, BUTTONS, RELEASE_BUTTONS = 8, 12, (8, 9)
RELEASE_HELD_S = 1.5
NS = 1e-9
POLL_S = 0.02
# Legs around the Car at the distance of a measurement; the robot drives there and back.
LEGS = ((3.2, -2.2, 0.0), (-3.2, -2.2, 0.0))
NOT_READY = (link.MODE_UNSPECIFIED, link.MODE_STARTING)
START_LIMIT_S = 120.0
MOVES_MPS, STANDS_MPS = 0.3, 0.01
MACHINE_CLOCK = {"machine_clock": "true"}
# Simulated clock, which advances whatever the nodes do.
SIMULATED_CLOCK = {"lockstep": "false"}


class LiveError(Exception):
    """The robot does not do what the measurement needs; the text has the reason."""


class LiveRobot:
    """Robot under observation; use as a context manager.

    Attributes:
        commands: commands to the wheels, with their arrival times.
        wheels: wheel speeds reported by the base, with their arrival times.
        status_times_s: arrival times of Statuses.
    """

    def __init__(self, folder: pathlib.Path, variables: Optional[Dict[str, str]] = None,
                 clock: Dict[str, str] = MACHINE_CLOCK):
        """variables: environment variables of the nodes. clock: arguments of the launch file that choose the clock."""
        self.commands: List[Motion] = []
        self.wheels: List[Motion] = []
        self.status_times_s: List[float] = []
        self._joy = Joy(axes=[0.0] * AXES, buttons=[0] * BUTTONS)
        self._stack = Stack(StackOptions(folder, real_time_factor=1.0, lockstep_operator=False, variables=variables,
                                         arguments={**clock, "controller": "true", "base_guard": "true",
                                                    "scenario": "lot"}))
        self._legs = self._map_car_id = 0
        self._has_leg = False

    def __enter__(self) -> "LiveRobot":
        self._stack.__enter__()
        os.environ.update(ROS_MASTER_URI=self._stack.master_uri, ROS_IP="127.0.0.1")
        rospy.init_node("live_robot", disable_signals=True)
        self._operator = OperatorLink(self._stack.status_port, self._stack.command_port, self._take_status)
        self._joystick = rospy.Publisher(names.JOY, Joy, queue_size=1, tcp_nodelay=True)
        self._timer = rospy.Timer(rospy.Duration(schedule.CONTROLLER_INPUT.period_ns * NS), self._speak)
        for topic, kind, take in ((names.WHEEL_COMMAND, Twist, self._take_command),
                                  (names.WHEEL_ODOMETRY, Odometry, self._take_odometry)):
            rospy.Subscriber(topic, kind, take, queue_size=200, tcp_nodelay=True)
        return self

    def __exit__(self, *_: object) -> None:
        self._timer.shutdown()
        self._operator.close()
        shut_down("The measurement is over.")
        self._stack.stop()

    @property
    def status(self) -> Any:
        """Newest Status."""
        return self._operator.status

    def start(self) -> None:
        """Release the emergency stop and order a map of the Car; return when the order is given."""
        self.wait_until(lambda: self._joystick.get_num_connections() and self.wheels, "a robot that speaks")
        self.wait_until(lambda: self.status.mode not in NOT_READY, "a robot that is ready")
        self.release()
        self.map_car()

    def map_car(self) -> None:
        """Order a map of the Car, again if it was mapped before."""
        self._map_car_id += 1
        self._has_leg = False
        self._operator.order(map_car_id=self._map_car_id)

    @property
    def knows_car(self) -> bool:
        """True if the latest order to map the Car is done."""
        status = self.status
        return (status.map_car_id == self._map_car_id and status.mode == link.MODE_FOLLOWING_WAYPOINT
                and bool(status.car.mapped))

    def stop(self) -> float:
        """Order a stop, which the next leg ends; return the monotonic time at which the order was sent."""
        ordered_s = time.monotonic()
        self._operator.send(map_car_id=self._map_car_id, stop=True)
        self._has_leg = False
        return ordered_s

    def release(self) -> None:
        """Release the emergency stop."""
        self.hold_release()
        released = time.monotonic() + RELEASE_HELD_S
        self.wait_until(lambda: time.monotonic() > released
                        and self.status.emergency_stop == link.EMERGENCY_STOP_RELEASED, "the release")
        self.let_go()

    def hold_release(self) -> None:
        """Hold the buttons that release the emergency stop."""
        for button in RELEASE_BUTTONS:
            self._joy.buttons[button] = 1

    def let_go(self) -> None:
        """Hold no button."""
        self._joy.buttons = [0] * BUTTONS

    def keep_driving(self) -> None:
        """Order the next leg when none is under way; must be called repeatedly."""
        status = self.status
        if self.knows_car and (
                not self._has_leg or (status.waypoint_id == self._legs and status.waypoint_result in (
                    link.WAYPOINT_RESULT_REACHED, link.WAYPOINT_RESULT_REFUSED))):
            self._operator.order(**self._next_leg())

    def drive_on(self) -> float:
        """Order the next leg without waiting for a Status; return the monotonic time at which the order was sent."""
        leg = self._next_leg()
        ordered_s = time.monotonic()
        self._operator.send(**leg)
        return ordered_s

    def _next_leg(self) -> Dict[str, Any]:
        x, y, heading = LEGS[self._legs % len(LEGS)]
        self._legs += 1
        self._has_leg = True
        return {"map_car_id": self._map_car_id, "max_speed_mps": 1.0,
                "waypoint": link.Waypoint(id=self._legs, x=x, y=y, heading=heading)}

    def wait_for_standstill(self, limit_s: float) -> None:
        """Wait until wheel speeds and wheel commands are zero.

        Raises:
            LiveError: the robot still moves after limit_s.
        """
        deadline_s = time.monotonic() + limit_s
        while any(abs(each[-1].linear_mps) > STANDS_MPS for each in (self.wheels, self.commands)):
            if time.monotonic() > deadline_s:
                raise LiveError(f"It does not stand after {limit_s:g} s; see {self._stack.log}.")
            time.sleep(POLL_S)

    def wait_for_motion(self, limit_s: float) -> None:
        """Wait until the robot drives."""
        self.wait_until(lambda: self.moves, "motion", limit_s)

    @property
    def moves(self) -> bool:
        """True while the wheels turn."""
        return bool(self.wheels) and abs(self.wheels[-1].linear_mps) > MOVES_MPS

    def wait_until(self, condition: Callable[[], Any], what: str, limit_s: float = START_LIMIT_S) -> None:
        """Wait for a condition and keep the robot driving.

        Raises:
            LiveError: the limit has passed.
        """
        deadline_s = time.monotonic() + limit_s
        while not condition():
            if time.monotonic() > deadline_s:
                raise LiveError(f"It did not come to pass within {limit_s:g} s: {what}. The robot says: "
                                f"{[note.text for note in self.status.notifications]}; see {self._stack.log}.")
            self.keep_driving()
            time.sleep(POLL_S)

    def watch(self, duration_s: float) -> None:
        """Keep the robot driving for a time, s."""
        end_s = time.monotonic() + duration_s
        while time.monotonic() < end_s:
            self.keep_driving()
            time.sleep(POLL_S)

    def process_of(self, node: str) -> int:
        """Return the id of a node's process."""
        return process_of(self._stack.master_uri, node)

    def _take_status(self) -> None:
        self.status_times_s.append(time.monotonic())

    def _speak(self, _: Any) -> None:
        # Some drivers send no stamp either; this process does not follow the robot's clock when it is set.
        self._joystick.publish(self._joy)

    def _take_command(self, twist: Any) -> None:
        self.commands.append(Motion(time.monotonic(), twist.linear.x, twist.angular.z))

    def _take_odometry(self, odometry: Any) -> None:
        twist = odometry.twist.twist
        assert math.isfinite(twist.linear.x)
        self.wheels.append(Motion(time.monotonic(), twist.linear.x, twist.angular.z))
