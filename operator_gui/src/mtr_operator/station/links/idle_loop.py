"""What the application asks of the robot while no test runs: nothing, to stand, or what the Operator calibrates."""
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

# Wall time after which an order gives way to the application that controls the robot. Statuses of the first moments may
# be older than the end of this application's own last session.
FOREIGN_S = 1.0
# Wall time after which the robot lets another application take over from a silent one.
ABANDONED_S = 3.0
# Wall time for which one step waits for a Status; the desired state is sent again after that.
STEP_S = 0.1


class CarRequest(enum.Enum):
    """What the Operator has the robot do with the Car between two tests."""

    CHECK = "check where it stands"
    MAP = "map it again"
    STOP = "stop"


@dataclass(frozen=True)
class CalibrationRequest:
    """What the Operator tries. None and no button leave height and buttons as they are."""

    key_height_m: float | None
    buttons: tuple[int, ...]
    strength: float
    duration_s: float


class IdleLoop:
    """One Status, one answer; before a request the answer only watches, so that another application can have the robot.

    Attributes:
        claims: true while this application wants the robot: for a paused test, or since an order.
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
        # When the robot was last seen without another application, and without one that has fallen silent.
        self._free_s = self._attended_s = clock()
        self.silent_s = 0.0

    def calibrate(self, request: CalibrationRequest) -> None:
        """Have the robot do this from now on; what a stop has ended stays ended."""
        self._claim()
        press = self._desired.press
        if request.buttons:
            self._press_id += 1
            press = Press(self._press_id, request.buttons, request.strength, request.duration_s)
        height_m = self._desired.key_height_m if request.key_height_m is None else request.key_height_m
        self._desired = replace(self._desired, key_height_m=height_m, press=press)
        if self._desired.stop:
            # The robot would go on mapping or checking under an order that still stands.
            self._desired = replace(self._desired, stop=False, map_car_id=0, check_car_id=0)

    def request_car(self, request: CarRequest) -> None:
        """Have the robot check or map the Car, or stop doing so; it moves for that."""
        self._claim()
        if request is CarRequest.CHECK:
            self._check_id += 1
        elif request is CarRequest.MAP:
            self._map_id += 1
        self._desired = replace(self._desired, stop=request is CarRequest.STOP, check_car_id=self._check_id,
                                map_car_id=self._map_id)

    def set_area(self, corners: tuple[Point, ...], origin_id: int) -> None:
        """Have the robot keep inside this area from now on, without corners in none; it does not move for that."""
        self._claim()
        self._area_id += 1
        self._desired = replace(self._desired, area=AreaOrder(self._area_id, origin_id, corners))

    def leave_service(self, agreement_id: int) -> None:
        """Release service mode for the Operator; nothing moves for that."""
        self._claim()
        self._desired = replace(self._desired, stop=True, leave_service_id=agreement_id)

    @property
    def has_order(self) -> bool:
        """True while something is wanted for which the robot may move."""
        wanted = self._desired
        key = (wanted.key_height_m, wanted.press)
        return not wanted.stop and any([wanted.map_car_id, wanted.check_car_id, *(each is not None for each in key)])

    def use_car(self, car: CarLink) -> None:
        """Watch the Car through another link from now on."""
        self._car = car

    def step(self) -> RobotSnapshot | None:
        """Take a Status and answer it; None when none came."""
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
        """Drop what is ordered while another application keeps the robot: it would begin when that one ends."""
        now_s = self._clock()
        if not status.is_abandoned:
            self._attended_s = now_s
        if status.is_abandoned or not status.controlled_by_other:
            self._free_s = now_s
        if self.claims and now_s - self._free_s >= FOREIGN_S:
            self.claims, self._desired = False, DesiredState()
            self._robot.give_way()

    def _forget_service(self, status: RobotStatus) -> None:
        """A release that has expired or has ended service mode is of no further use."""
        released = self._desired.leave_service_id
        if released and (status.service is None or status.service.agreement_id != released):
            self._desired = replace(self._desired, leave_service_id=0)

    def _forget_done_press(self, status: RobotStatus) -> None:
        press = self._desired.press
        if press is not None and any(done.id == press.id for done in status.presses):
            self._desired = replace(self._desired, press=None)
