"""What the application asks of the robot while no test runs: to stand, and what the Operator calibrates."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass, replace

from mtr_operator.domain.ports import ButtonPress, CarLink, DesiredState, RobotStatus

from ..events import RobotNews
from .watched_link import WatchedRobotLink

# Wall time for which one step waits for a Status; the desired state is sent again after that.
STEP_S = 0.1


class CarLook(enum.Enum):
    """What the Operator has the robot do with the Car between two tests."""

    CHECK = "check where it stands"
    MAP = "map it again"
    STOP = "stop"


@dataclass(frozen=True)
class CalibrationOrder:
    """What the Operator tries. None and no button leave height and buttons as they are."""

    key_height_m: float | None
    buttons: tuple[int, ...]
    strength: float
    duration_s: float


class IdleSession:
    """One Status, one answer; without an order the answer asks for nothing."""

    def __init__(self, robot: WatchedRobotLink, car: CarLink):
        self._robot = robot
        self._car = car
        self._desired = DesiredState()
        self._press_id = self._check_id = self._map_id = 0
        self._heard = False
        self.silent_s = 0.0

    def order(self, order: CalibrationOrder) -> None:
        """Have the robot do this from now on."""
        press = self._desired.press
        if order.buttons:
            self._press_id += 1
            press = ButtonPress(self._press_id, order.buttons, order.strength, order.duration_s)
        height_m = self._desired.key_height_m if order.key_height_m is None else order.key_height_m
        self._desired = replace(self._desired, key_height_m=height_m, press=press)

    def look_at_car(self, again: CarLook) -> None:
        """Have the robot check or map the Car, or stop doing so; it moves for that."""
        if again is CarLook.CHECK:
            self._check_id += 1
        elif again is CarLook.MAP:
            self._map_id += 1
        self._desired = replace(self._desired, stop=again is CarLook.STOP, check_car_id=self._check_id,
                                map_car_id=self._map_id)

    def use_car(self, car: CarLink) -> None:
        """Watch the Car through another link from now on."""
        self._car = car

    def step(self) -> RobotNews | None:
        """Take a Status and answer it; None when none came."""
        status = self._robot.next_status(STEP_S)
        if status is None:
            self.silent_s += STEP_S
            if self._heard:
                self._robot.send(self._desired)
            return None
        self._heard, self.silent_s = True, 0.0
        self._car.observe(status)
        self._forget_done_press(status)
        self._robot.send(self._desired)
        return RobotNews(status, self._car.lock_state, self._car.problem, None, self._robot.is_secret)

    def _forget_done_press(self, status: RobotStatus) -> None:
        press = self._desired.press
        if press is not None and any(done.id == press.id for done in status.presses):
            self._desired = replace(self._desired, press=None)
