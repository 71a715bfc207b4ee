"""Simulated robot with all nodes, a scripted Operator who answers each Status, and injected faults."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import math
import os
import pathlib
import time
from types import SimpleNamespace
from typing import Any, Callable, List, NamedTuple

import rospy
from nav_msgs.msg import Odometry

from mtr_core import names
from mtr_fault_injection.set_clock import SettableClock
from mtr_msgs.msg import ActiveFaults, FirmwareState
from mtr_msgs.srv import InjectFault
from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.robot_link.conversions import robot_status_from
from mtr_proto import robot_link_pb2 as link
from mtr_simulation.stack import Stack, StackOptions, free_port

from ..harness.operator_link import OperatorLink
from ..harness.ros_shutdown import shut_down
from ..harness.speed import fastest_point_mps
from .judge import WELL, CarSeen, Seen, has_stood
from .receiver import Receiver
from .robots import RobotKind, small_disk

# Limit in wall time, sufficient for a busy machine.
LIMIT_S = 400.0
POLL_S = 0.005
# Number of messages of each kind that remain after `forget`.
KEPT = 100
LEGS = ((3.2, -2.2, 0.0), (-3.2, -2.2, 0.0))
MOVES_MPS = 0.3
NOT_FOUND = "car_locator.not_found"
# Wall time for which simulated time waits for a silent part, s; short, because each of the many silences costs it once.
PATIENCE = "/lockstep_patience_s: 0.7\n"
# Heights between which the lift moves the key, m above ground, and the height halfway.
LOW_M, HIGH_M, MIDDLE_M = 0.4, 1.5, 0.95
# Duration of a press, s.
PRESS_S = 0.3
# Period after which the firmware's clock in a message wraps, s.
FIRMWARE_WRAP_S = 2 ** 32 * 1e-6
ARGUMENTS = {"fault_injection": "true", "resume_by_operator": "true", "scenario": "lot"}


class FaultyRobotError(Exception):
    """The robot does not reach the state that a cell needs; the text has its messages."""


class PutBackError(FaultyRobotError):
    """The robot asks to be put at its starting place: a restarted Car locator does not know this place."""


class Speed(NamedTuple):
    """True speed of the robot's fastest point, or of its lift upwards, at a time of the robot's clock; s, m/s."""

    time_s: float
    mps: float


def fastest_of(twist: Any) -> float:
    """Return the speed of the robot's fastest point from its Twist, m/s."""
    return fastest_point_mps(twist.linear.x, twist.angular.z, twist.linear.y)


class FaultyRobot:
    """Robot under test; use as a context manager.

    Attributes:
        seen: all received Statuses as the application interprets them, with the state of the Car.
        speeds, lifts: true speeds of the robot and of its lift.
        truth: newest true pose and twist.
        ended_s: end of the newest fault by the robot's clock; infinite while it lasts.
    """

    def __init__(self, folder: pathlib.Path, kind: RobotKind, seed: int = 1):
        self.seen: List[Seen] = []
        self.speeds: List[Speed] = []
        self.lifts: List[Speed] = []
        self.truth = Odometry()
        folder.mkdir(parents=True, exist_ok=True)
        self._kind, self._open = kind, contextlib.ExitStack()
        self._disk = folder.resolve() / "ros"
        parameters = folder.resolve() / "parameters.yaml"
        own = "".join(f"{name}: {value:g}\n" for name, value in kind.parameters.items())
        parameters.write_text(PATIENCE + own, encoding="utf-8")
        self._ports = free_port(), free_port()
        arguments = {**ARGUMENTS, **kind.arguments, "node_parameters": str(parameters),
                     "fault_relay_status_port": str(self._ports[0]), "fault_relay_command_port": str(self._ports[1])}
        variables = dict(kind.variables)
        if kind.has_small_disk:
            arguments["fault_disk_folder"] = str(self._disk)
        if not kind.is_simulated:
            clock = SettableClock(folder.resolve() / "clock")
            arguments["fault_clock_file"] = str(clock.file)
            # The clock's library is added to one that is already preloaded.
            both = filter(None, (variables.get("LD_PRELOAD"), clock.variables["LD_PRELOAD"]))
            variables = {**variables, **clock.variables, "LD_PRELOAD": " ".join(both)}
        self._stack = Stack(StackOptions(folder, seed, kind.real_time_factor, not kind.by_relay, arguments=arguments,
                                         variables=variables))
        self._begun_s = self._height_m = math.nan
        self.ended_s = math.inf
        self._legs = self._maps = self._presses = 0
        self._wanted = SimpleNamespace(content={})

    def __enter__(self) -> "FaultyRobot":
        with contextlib.ExitStack() as opened:
            if self._kind.has_small_disk:
                opened.enter_context(small_disk(self._disk))
            opened.enter_context(self._stack)
            os.environ.update(ROS_MASTER_URI=self._stack.master_uri, ROS_IP="127.0.0.1")
            rospy.init_node("fault_matrix", disable_signals=True, disable_rostime=True)
            opened.callback(shut_down, "The matrix is over.")
            rospy.Subscriber(names.SIM_TRUTH, Odometry, self._take_truth, queue_size=200, tcp_nodelay=True)
            rospy.Subscriber(names.FIRMWARE_STATE, FirmwareState, self._take_lift, queue_size=200, tcp_nodelay=True)
            rospy.Subscriber(names.ACTIVE_FAULTS, ActiveFaults, self._take_faults, queue_size=10)
            if self._kind.has_receiver:
                rospy.Subscriber(names.SIM_TRUTH, Odometry, Receiver().take, queue_size=200, tcp_nodelay=True)
            self._inject = rospy.ServiceProxy(names.INJECT_FAULT, InjectFault)
            self._car = CanCarLink("slcan", str(self._stack.can_link)) if self._kind.hears_car else None
            if self._car:
                self._car.connect()
                opened.callback(self._car.close)
            ports = self._ports if self._kind.by_relay else (self._stack.status_port, self._stack.command_port)
            self._operator = OperatorLink(*ports, self._take_status)
            opened.callback(self._operator.close)
            self._open = opened.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    @property
    def process(self) -> int:
        """Id of the ancestor process of all nodes."""
        return self._stack.pid

    @property
    def status(self) -> Any:
        """Newest Status as received."""
        return self._operator.status

    @property
    def now_s(self) -> float:
        """Robot's steady clock at the newest Status."""
        return float(self.status.steady_time_s)

    @property
    def speed_mps(self) -> float:
        """Newest true speed along the path, forwards or backwards."""
        return abs(float(self.truth.twist.twist.linear.x))

    def has_stood(self, for_s: float) -> bool:
        """Return True if the robot has not moved for the given time."""
        return has_stood(self.speeds, for_s)

    @property
    def lift_mps(self) -> float:
        """Newest true speed of the lift, up or down."""
        return abs(self.lifts[-1].mps) if self.lifts else 0.0

    def order(self, **content: Any) -> None:
        """Set the Operator's orders from now on."""
        self._wanted.content = content
        self._operator.order(**content)

    def map_car(self) -> None:
        """Order a map of the Car, again if it was mapped before."""
        self._maps += 1
        self.order(map_car_id=self._maps)

    @property
    def knows_car(self) -> bool:
        """True if the latest order to map the Car is done."""
        return bool(self._maps and self.status.car.mapped and self.status.map_car_id == self._maps
                    and self.status.mode == link.MODE_FOLLOWING_WAYPOINT)

    @property
    def has_not_found_car(self) -> bool:
        """True if the robot drove around the Car and found too little of it; it then waits for another order."""
        is_newest = self.status.map_car_id == self._maps
        return is_newest and any(
            problem.code == NOT_FOUND for note in self.status.notifications for problem in note.problems)

    @property
    def has_mapped(self) -> bool:
        """True if the Operator has ordered a map of the Car."""
        return bool(self._maps)

    @property
    def maps_car(self) -> bool:
        """True while a map of the Car is the only order."""
        return bool(self._maps and "waypoint" not in self._wanted.content)

    def drive(self) -> None:
        """Order the next leg around the Car."""
        x, y, heading = LEGS[self._legs % len(LEGS)]
        self._legs += 1
        self.order(map_car_id=self._maps, max_speed_mps=1.0,
                   waypoint=link.Waypoint(id=self._legs, x=x, y=y, heading=heading))

    def lift(self) -> None:
        """Order the key to the height that is farther from its current one; keep the other orders."""
        wanted = {name: value for name, value in self._wanted.content.items() if name != "device_height_m"}
        self.order(**wanted, device_height_m=LOW_M if self.status.state.device_height > MIDDLE_M else HIGH_M)

    def press(self) -> None:
        """Order a press in addition to the current orders."""
        self._presses += 1
        self.order(**{**self._wanted.content, "press": link.ButtonPress(
            id=self._presses, buttons=[link.KEY_BUTTON_LOCK], strength=1.0, duration_s=PRESS_S)})

    @property
    def has_pressed(self) -> bool:
        """True if the latest press is reported as done."""
        return any(each.id == self._presses and not each.error for each in self.status.presses)

    @property
    def is_under_way(self) -> bool:
        """True while the latest leg is ordered and not completed."""
        return "waypoint" in self._wanted.content and not self.has_arrived

    @property
    def way_left_m(self) -> float:
        """Distance as the crow flies from the estimated position to the end of the latest leg."""
        x, y, _ = LEGS[(self._legs - 1) % len(LEGS)]
        return math.hypot(self.status.state.x - x, self.status.state.y - y)

    @property
    def has_arrived(self) -> bool:
        """True if the latest leg is completed or refused."""
        return bool(self.status.waypoint_id == self._legs and self.status.waypoint_result in (
            link.WAYPOINT_RESULT_REACHED, link.WAYPOINT_RESULT_REFUSED))

    def release_hold(self) -> None:
        """Resume after a fault, as the Operator does."""
        hold_id = self.status.hold_id
        if hold_id and self._wanted.content.get("resume_hold_id") != hold_id:
            self.order(**{**self._wanted.content, "resume_hold_id": hold_id})

    def begin(self, part: str, kind: str, duration_s: float, amount: float) -> float:
        """Inject a fault; return the robot's clock when it begins."""
        self._begun_s, self.ended_s = math.nan, math.inf
        answer = self._inject(part, kind, duration_s, amount)
        if not answer.accepted:
            raise FaultyRobotError(answer.message)
        self.wait_until(lambda: not math.isnan(self._begun_s), "the fault")
        return self._begun_s

    def forget(self) -> None:
        """Discard all recorded data except the newest."""
        for each in (self.seen, self.speeds, self.lifts):
            del each[:-KEPT]

    def wait_until(self, condition: Callable[[], Any], what: str, meanwhile: Callable[[], None] = lambda: None) -> None:
        """Wait for a condition, by wall time.

        Raises:
            FaultyRobotError: the limit has passed.
        """
        end_s = time.monotonic() + LIMIT_S
        while not condition():
            if time.monotonic() > end_s:
                said = [note.text for note in self.status.notifications]
                raise FaultyRobotError(f"{what} has not come to pass; the robot says {said}; see {self._stack.log}.")
            meanwhile()
            time.sleep(POLL_S)

    def _time_s(self, stamp_s: float) -> float:
        """Return the steady clock at a stamp that has just arrived: the stamp in simulation, else the machine's
        clock."""
        return stamp_s if self._kind.is_simulated else time.clock_gettime(time.CLOCK_BOOTTIME)

    def _take_faults(self, active: ActiveFaults) -> None:
        time_s = self._time_s(active.header.stamp.to_sec())
        if active.faults:
            self._begun_s = time_s
        else:
            self.ended_s = time_s

    def _take_status(self) -> None:
        status, car = robot_status_from(self.status), WELL
        if self._car:
            self._car.observe(status)
            car = CarSeen(self._car.problem, self._car.lock_state)
        self.seen.append(Seen(float(self.status.steady_time_s), status, car))

    def _take_truth(self, odometry: Any) -> None:
        self.truth = odometry
        self.speeds.append(Speed(self._time_s(odometry.header.stamp.to_sec()), fastest_of(odometry.twist.twist)))

    def _take_lift(self, state: Any) -> None:
        if not self.speeds:
            return
        time_s = state.time_us * 1e-6
        time_s = self._time_s(time_s + FIRMWARE_WRAP_S * round((self.speeds[-1].time_s - time_s) / FIRMWARE_WRAP_S))
        if self.lifts and time_s > self.lifts[-1].time_s:
            mps = (state.lift_height_m - self._height_m) / (time_s - self.lifts[-1].time_s)
            self.lifts.append(Speed(time_s, mps))
        elif not self.lifts:
            self.lifts.append(Speed(time_s, 0.0))
        self._height_m = state.lift_height_m
