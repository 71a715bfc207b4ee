"""Brings the robot into a state, lets a part have a fault there, and says what was seen."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Dict

from mtr_proto import robot_link_pb2 as link

from .judge import STANDS_MPS, Outcome, invalid_because, standstill_s, told_since
from .matrix import GOES_ON, HELD, LOST, Cell
from .robot import MOVES_MPS, FaultyRobot

# After a fault the robot has that long to come back by itself, s of its time.
SEEN_AFTER_S = 3.0
READY, DRIVING, WAITING = "ready", "driving", "waiting"


class Course:
    """One robot from its start on; `to` has to be called with states in the order of the matrix."""

    def __init__(self, robot: FaultyRobot):
        self._robot = robot
        self._ways: Dict[str, Callable[[], None]] = {
            READY: self._to_ready, DRIVING: self._to_driving, WAITING: self._to_waiting}

    def to(self, state: str) -> None:
        """Bring the robot into a state, held by nothing; FaultyRobotError when it does not get there."""
        robot = self._robot
        robot.wait_until(lambda: not robot.status.hold_id, "the end of the hold that the fault before left",
                         robot.release_hold)
        self._ways[state]()

    def run(self, cell: Cell) -> Outcome:
        """One cell, from its state on."""
        robot = self._robot
        self.to(cell.state)
        speed_mps, begun_s = robot.speed_mps, robot.begin(cell.part, cell.kind, cell.for_s, cell.amount)
        end_s = begun_s + cell.for_s
        robot.wait_until(lambda: robot.now_s > end_s + SEEN_AFTER_S, "the time after the fault")
        statuses = [each for each in robot.statuses if each.stamp_s > begun_s - 1.0]
        during = [each for each in statuses if begun_s < each.stamp_s <= end_s + 0.5]
        return Outcome(speed_mps, standstill_s(robot.speeds, begun_s, end_s), told_since(statuses, begun_s),
                       list(dict.fromkeys(each.mode.name.lower() for each in during)), self._then(),
                       invalid_because(statuses, begun_s))

    def _then(self) -> str:
        status = self._robot.status
        if status.mode in (link.MODE_FAULT, link.MODE_STARTING):
            return LOST
        return HELD if status.hold_id else GOES_ON

    def _to_ready(self) -> None:
        self._robot.wait_until(lambda: self._robot.status.mode == link.MODE_READY_TO_MAP_CAR, "readiness")

    def _to_mapped(self) -> None:
        robot = self._robot
        if not robot.has_orders:
            self._to_ready()
            robot.order(map_car_id=1)
        robot.wait_until(lambda: robot.status.car.mapped and robot.status.mode == link.MODE_FOLLOWING_WAYPOINT,
                         "a map of the Car", robot.release_hold)

    def _to_driving(self) -> None:
        robot = self._robot
        self._to_mapped()

        def go_on() -> None:
            robot.release_hold()
            if robot.has_arrived:
                robot.drive()
        if not robot.is_under_way:
            robot.drive()
        robot.wait_until(lambda: robot.speed_mps > MOVES_MPS, "a drive", go_on)

    def _to_waiting(self) -> None:
        robot = self._robot
        if not robot.has_arrived:
            self._to_driving()
        robot.wait_until(lambda: robot.has_arrived and robot.speed_mps < STANDS_MPS, "the end of the way",
                         robot.release_hold)
