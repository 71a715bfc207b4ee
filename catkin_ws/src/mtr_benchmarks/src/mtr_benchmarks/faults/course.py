"""Brings the robot into a state, injects a fault, and records what happens."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Dict

from mtr_proto import robot_link_pb2 as link

from .judge import (
    LIFT_STANDS_MPS,
    Outcome,
    end_speed_mps,
    invalid_because,
    modes_during,
    standstill_s,
    told_since,
)
from .matrix import DRIVING, GOES_ON, HELD, LOST, MAPPING, Cell
from .robot import MOVES_MPS, FaultyRobot, PutBackError

# Recorded time after the end of a fault, s of the robot's time.
SEEN_AFTER_S = 3.0
# Least remaining path when a fault begins, so that the path does not end during the fault: 2 s at up to 1 m/s.
ENOUGH_WAY_M = 3.0
# A waiting robot has been stopped for this time, s.
REST_S = 1.5
# Speed at which the lift counts as moving, m/s; its maximum is 0.15.
LIFTS_MPS = 0.12
READY, WAITING, LIFTING = "ready", "waiting", "lifting"
# Number of consecutive maps without the Car after which an Operator puts the robot back, as it asks.
ENOUGH_TRIES = 3
OUT_OF_ORDER = (link.MODE_FAULT, link.MODE_STARTING, link.MODE_UNSPECIFIED)


class Course:
    """One robot from its start; the states must be requested in the order of the matrix."""

    def __init__(self, robot: FaultyRobot):
        self._robot = robot
        self._not_found = 0
        self._ways: Dict[str, Callable[[], None]] = {
            READY: self._to_ready, MAPPING: self._to_mapping, DRIVING: self._to_driving, WAITING: self._to_waiting,
            LIFTING: self._to_lifting}

    def to(self, state: str) -> None:
        """Bring the robot into a state without a hold.

        Raises:
            FaultyRobotError: the robot does not reach the state.
        """
        robot = self._robot
        robot.wait_until(lambda: not robot.status.hold_id, "the end of the hold that the fault before left",
                         robot.release_hold)
        self._ways[state]()

    def run(self, cell: Cell) -> Outcome:
        """Run one cell, starting with its state."""
        robot = self._robot
        self.to(cell.state)
        speed_mps, begun_s = robot.speed_mps, robot.begin(cell.part, cell.kind, cell.for_s, cell.amount)
        if cell.expected.presses:
            robot.press()
        end_s = begun_s + cell.for_s
        robot.wait_until(lambda: robot.now_s > end_s + SEEN_AFTER_S, "the time after the fault")
        back_s = end_s + cell.expected.back_s
        robot.wait_until(lambda: robot.now_s > back_s or robot.status.mode not in OUT_OF_ORDER, "its end")
        # A fault that is timed by the machine's clock may end some hundredths of a second earlier in the robot's time.
        end_s = min(end_s, robot.ended_s)
        seen = [each for each in robot.seen if each.time_s > begun_s - 1.0]
        return Outcome(speed_mps, standstill_s(robot.speeds, begun_s, end_s), told_since(seen, begun_s),
                       modes_during(seen, begun_s, end_s), self._then(), invalid_because(seen, begun_s),
                       standstill_s(robot.lifts, begun_s, end_s, LIFT_STANDS_MPS),
                       end_speed_mps(robot.speeds, begun_s, end_s), cell.expected.presses and robot.has_pressed)

    def _then(self) -> str:
        status = self._robot.status
        if status.mode in OUT_OF_ORDER:
            return LOST
        return HELD if status.hold_id else GOES_ON

    def _to_ready(self) -> None:
        self._robot.wait_until(lambda: self._robot.status.mode == link.MODE_READY_TO_MAP_CAR, "readiness")

    def _to_mapping(self) -> None:
        robot = self._robot

        def go_on() -> None:
            robot.release_hold()
            self._map_again_if_not_found()
            if robot.knows_car or not robot.maps_car:
                robot.map_car()
        if not robot.maps_car:
            robot.wait_until(lambda: robot.status.mode not in OUT_OF_ORDER, "a robot that is well")
        robot.wait_until(lambda: robot.status.mode == link.MODE_MAPPING_CAR and robot.speed_mps > MOVES_MPS,
                         "a drive round the Car", go_on)
        self._not_found = 0

    def _to_mapped(self) -> None:
        robot = self._robot
        if not robot.has_mapped:
            robot.wait_until(lambda: robot.status.mode not in OUT_OF_ORDER, "a robot that is well")
            robot.map_car()
        def go_on() -> None:
            robot.release_hold()
            self._map_again_if_not_found()
        robot.wait_until(lambda: robot.knows_car, "a map of the Car", go_on)
        self._not_found = 0

    def _map_again_if_not_found(self) -> None:
        robot = self._robot
        if not robot.has_not_found_car:
            return
        self._not_found += 1
        if self._not_found >= ENOUGH_TRIES:
            raise PutBackError("The robot has not found the Car again and again, and asks to be put back.")
        robot.map_car()

    def _to_driving(self) -> None:
        robot = self._robot
        self._to_mapped()

        def go_on() -> None:
            robot.release_hold()
            if not has_way():
                robot.drive()

        def has_way() -> bool:
            return robot.is_under_way and robot.way_left_m > ENOUGH_WAY_M
        robot.wait_until(lambda: has_way() and robot.speed_mps > MOVES_MPS, "a drive", go_on)

    def _to_waiting(self) -> None:
        robot = self._robot
        if not robot.has_arrived:
            self._to_driving()
        # A robot that was on hold resumes its waypoint and corrects its position.
        since_s = robot.now_s
        robot.wait_until(lambda: robot.now_s > since_s + REST_S and robot.has_arrived and robot.has_stood(REST_S),
                         "the end of the way", robot.release_hold)

    def _to_lifting(self) -> None:
        self._to_waiting()
        self._robot.lift()
        self._robot.wait_until(lambda: self._robot.lift_mps > LIFTS_MPS, "a lift under way", self._robot.release_hold)
