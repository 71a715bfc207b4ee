"""Requests to the robot while no test runs: none, a stop, or the Operator's calibration."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import time
from dataclasses import dataclass, replace
from typing import Callable

from mtr_operator.domain.eventlog.event_log import EventLog
from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.interfaces.car_bus import BusMonitor
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.ports import CarLink
from mtr_operator.domain.requests import AreaOrder, DesiredState, Press
from mtr_operator.domain.robot_status import RobotStatus

from ..bus.time_line import TimeLine
from ..events import RobotSnapshot, known_facts
from .watched_link import WatchedRobotLink

# Wall time after which an order yields to another application that controls the robot. The first Statuses may precede
# the end of this application's own last session.
FOREIGN_S = 1.0
# Wall time of silence after which the robot accepts another application.
ABANDONED_S = 3.0
# Wall time for which one step waits for a Status; then the desired state is sent again.
STEP_S = 0.1


class CarRequest(enum.Enum):
    """Requests of the Operator on the Car between two tests."""

    CHECK = "check where it stands"
    MAP = "map it again"
    STOP = "stop"


@dataclass(frozen=True)
class CalibrationRequest:
    """Calibration request. None and no button leave height and buttons unchanged."""

    key_height_m: float | None
    buttons: tuple[int, ...]
    strength: float
    duration_s: float


class IdleLoop:
    """One Status, one answer. Before a request the answers only watch, so that another application can control the
    robot.

    Attributes:
        claims: True while this application claims the robot: for a paused test, or after an order.
    """

    def __init__(self, robot: WatchedRobotLink, car: CarLink, resumed_hold: Callable[[int], int] = lambda _: 0,
                 event_log: EventLog | None = None, time_line: TimeLine | None = None, *, claims: bool = False,
                 clock: Callable[[], float] = time.monotonic):
        self._robot = robot
        self._event_log, self._time_line = event_log or EventLog(), time_line or TimeLine()
        self._resumed_hold = resumed_hold
        self._car = car
        self._desired = DesiredState()
        self._press_id = self._check_id = self._map_id = self._area_id = 0
        self._has_status = False
        self.claims, self._released_hold = claims, resumed_hold(0)
        self._clock = clock
        # Last times at which the robot had no other controller, and no silent one.
        self._free_s = self._attended_s = clock()
        self.silent_s = 0.0

    def calibrate(self, request: CalibrationRequest) -> None:
        """Request this from now on; a stop remains effective for earlier requests."""
        self._claim()
        press = self._desired.press
        if request.buttons:
            self._press_id += 1
            press = Press(self._press_id, request.buttons, request.strength, request.duration_s)
        height_m = self._desired.key_height_m if request.key_height_m is None else request.key_height_m
        self._desired = replace(self._desired, key_height_m=height_m, press=press)
        if self._desired.stop:
            # Otherwise the robot would resume mapping or checking under the previous order.
            self._desired = replace(self._desired, stop=False, map_car_id=0, check_car_id=0)

    def request_car(self, request: CarRequest) -> None:
        """Request a check or mapping of the Car, or its end; the robot moves for that."""
        self._claim()
        if request is CarRequest.CHECK:
            self._check_id += 1
        elif request is CarRequest.MAP:
            self._map_id += 1
        self._desired = replace(self._desired, stop=request is CarRequest.STOP, check_car_id=self._check_id,
                                map_car_id=self._map_id)

    def set_area(self, corners: tuple[Point, ...], origin_id: int) -> None:
        """Request that the robot stays in this area from now on, without corners in none; it does not move for that."""
        self._claim()
        self._area_id += 1
        self._desired = replace(self._desired, area=AreaOrder(self._area_id, origin_id, corners))

    def leave_service(self, agreement_id: int) -> None:
        """Release service mode for the Operator, without motion."""
        self._claim()
        self._desired = replace(self._desired, stop=True, leave_service_id=agreement_id)

    @property
    def has_order(self) -> bool:
        """True while an order is active for which the robot may move."""
        wanted = self._desired
        key = (wanted.key_height_m, wanted.press)
        return not wanted.stop and any([wanted.map_car_id, wanted.check_car_id, *(each is not None for each in key)])

    def use_car(self, car: CarLink) -> None:
        """Watch the Car through another link from now on."""
        self._car = car

    def step(self) -> RobotSnapshot | None:
        """Take a Status and answer it; return None without one."""
        status = self._robot.next_status(STEP_S)
        if status is None:
            self.silent_s += STEP_S
            if self._has_status:
                self._answer()
            return None
        self._has_status, self.silent_s = True, 0.0
        events, bus = self._car.observe(status), part(self._car, BusMonitor)
        self._time_line.learn(status, events, self._car.lock_state)
        self._event_log.learn(status, events, self._car.problem)
        self._forget_done_press(status)
        self._release_hold(status)
        self._forget_service(status)
        self._give_way(status)
        self._answer()
        if self._clock() - self._attended_s >= ABANDONED_S:
            status = replace(status, controlled_by_other=False)
        return RobotSnapshot(status, self._car.lock_state, self._car.problem, None, self._robot.is_secret,
                             bus.traffic, known_facts(self._car), self._robot.is_exposed,
                             signals=tuple(bus.signals))

    def _claim(self) -> None:
        self.claims, self._free_s = True, self._clock()

    def _answer(self) -> None:
        if self.claims:
            self._robot.send(self._desired)
        else:
            self._robot.watch()

    def _release_hold(self, status: RobotStatus) -> None:
        released = self._resumed_hold(status.hold_id)
        if released != self._released_hold:
            self._claim()
        self._released_hold = released
        self._desired = replace(self._desired, resume_hold_id=released)

    def _give_way(self, status: RobotStatus) -> None:
        """Drop orders while another application controls the robot: they would start when that one ends."""
        now_s = self._clock()
        if not status.is_abandoned:
            self._attended_s = now_s
        if status.is_abandoned or not status.controlled_by_other:
            self._free_s = now_s
        if self.claims and now_s - self._free_s >= FOREIGN_S:
            self.claims, self._desired = False, DesiredState()
            self._robot.give_way()

    def _forget_service(self, status: RobotStatus) -> None:
        """Discard a release that has expired or has ended service mode."""
        released = self._desired.leave_service_id
        if released and (status.service is None or status.service.agreement_id != released):
            self._desired = replace(self._desired, leave_service_id=0)

    def _forget_done_press(self, status: RobotStatus) -> None:
        press = self._desired.press
        if press is not None and any(done.id == press.id for done in status.presses):
            self._desired = replace(self._desired, press=None)
