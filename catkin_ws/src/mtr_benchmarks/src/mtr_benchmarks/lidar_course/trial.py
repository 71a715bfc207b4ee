"""Runs trials in which one LiDAR fails on the way to an obstacle; records contacts and the Operator's messages."""
# SPDX-License-Identifier: Apache-2.0
import math
import time
from typing import List, NamedTuple

from mtr_proto import robot_link_pb2 as link

from ..faults.robot import POLL_S, FaultyRobot
from .site import LEGS, Leg, Place, clearance_m

SPEED_MPS = 0.7
# Driven distance at which the fault begins, m; at 0.0 it begins before the robot starts.
BEGINS_M = (0.0, 0.8, 2.0)
# Time after the beginning of the fault during which the robot tries to drive on, s.
WATCHED_S = 12.0
REST_S = 1.0
# The visible parts of a wall stop the robot when the sector, to both sides, is narrower.
NARROW_DEG = 10.0
# Prefix of drive control's problem codes.
OWN_CODES = "drive_control."


class Trial(NamedTuple):
    """One trial. amount: of the fault, degrees for a sector. begins_m: driven distance at which the fault begins."""

    lidar: str
    kind: str
    amount: float
    obstacle: str
    begins_m: float

    @property
    def is_narrow(self) -> bool:
        """True for a sector that need not be reported."""
        return 0.0 < self.amount < NARROW_DEG

    @property
    def name(self) -> str:
        """Name for a person."""
        extent = f" by {self.amount:g} deg" if self.amount else ""
        return f"{self.lidar} {self.kind}{extent}, {self.obstacle} ahead, after {self.begins_m:g} m"


class Outcome(NamedTuple):
    """Result of one trial.

    Attributes:
        clearance_m: least distance of the outline from the obstacle, 0 for a contact.
        stood: the robot was stopped at the end.
        messages: distinct messages of drive control that the Operator received.
    """

    trial: Trial
    clearance_m: float
    stood: bool
    messages: List[str]

    @property
    def names_lidar(self) -> bool:
        """True if the Operator received the name of the LiDAR, and of the sector if only a part of its view failed."""
        lidar = self.trial.lidar.replace("_lidar", " LiDAR")
        named = [text for text in self.messages if f"The {lidar}" in text]
        return any("degrees" in text for text in named) if self.trial.amount else bool(named)


class Driver:
    """Drives the legs of the course with a robot that has mapped the Car."""

    def __init__(self, robot: FaultyRobot):
        self._robot = robot
        self._waypoints = 0

    def prepare(self) -> None:
        """Map the Car."""
        robot = self._robot
        robot.wait_until(lambda: robot.status.mode == link.MODE_READY_TO_MAP_CAR, "readiness")
        robot.map_car()
        robot.wait_until(lambda: robot.knows_car, "a map of the Car", robot.release_hold)

    def run(self, trial: Trial) -> Outcome:
        """Run one trial from the beginning of its leg; afterwards the robot has no faults and no hold."""
        robot, leg = self._robot, LEGS[trial.obstacle]
        self._go_to_start(leg)
        robot.forget()
        if trial.begins_m:
            self._order(leg.end)
            robot.wait_until(lambda: self._driven_m(leg) > trial.begins_m, "the way before the fault")
            start_s = robot.begin(trial.lidar, trial.kind, WATCHED_S, trial.amount)
        else:
            start_s = robot.begin(trial.lidar, trial.kind, WATCHED_S, trial.amount)
            self._order(leg.end)
        least_m = math.inf
        while robot.now_s < start_s + WATCHED_S:
            least_m = min(least_m, clearance_m(leg, self._place()))
            robot.release_hold()
            time.sleep(POLL_S)
        stood = robot.has_stood(REST_S)
        robot.wait_until(lambda: not math.isinf(robot.ended_s), "the end of the fault")
        texts = [problem.text for each in robot.seen if each.time_s > start_s
                 for problems in each.status.problems() for problem in problems
                 if problem.code.startswith(OWN_CODES)]
        return Outcome(trial, least_m, stood, list(dict.fromkeys(texts)))

    def _go_to_start(self, leg: Leg) -> None:
        robot = self._robot
        self._order(leg.start)
        robot.wait_until(lambda: self._has_arrived and robot.has_stood(REST_S), "the beginning of the leg",
                         robot.release_hold)

    @property
    def _has_arrived(self) -> bool:
        status = self._robot.status
        return bool(status.waypoint_id == self._waypoints and status.waypoint_result == link.WAYPOINT_RESULT_REACHED)

    def _order(self, place: Place) -> None:
        self._waypoints += 1
        self._robot.order(map_car_id=1, max_speed_mps=SPEED_MPS, waypoint=link.Waypoint(
            id=self._waypoints, x=place.x_m, y=place.y_m, heading=place.heading_rad))

    def _place(self) -> Place:
        pose = self._robot.truth.pose.pose
        return Place(pose.position.x, pose.position.y, 2.0 * math.atan2(pose.orientation.z, pose.orientation.w))

    def _driven_m(self, leg: Leg) -> float:
        return math.hypot(self._place().x_m - leg.start.x_m, self._place().y_m - leg.start.y_m)
