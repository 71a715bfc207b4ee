"""Robot, key and Car in one world, with time in ticks and a Status only if the application needs one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import random
from collections import deque

from mtr_operator.domain.requests import DesiredState, Direction, Press
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.robot_link.virtual.keyholder import SERVO_TRAVEL_S
from mtr_operator.robot_link.virtual.robot import VirtualRobot
from mtr_simulation.car.ecu import Command
from mtr_simulation.car.honest.instants import STEP_NS, HonestInstants, Moved
from mtr_simulation.car.honest.radio.key_antenna import Attitude

from .carried_key import NS, TICK_S, CarriedKey
from .errors import RadioErrors
from .margin_forecast import MarginForecast

# Statuses without news are skipped, within two limits: the link must not appear interrupted (LINK_GAP_S), and poses
# between two Statuses must be interpolable (MAX_GAP_S).
_MEASURING_TICKS, _WAY_TICKS = 4, 9
_BUTTONS = {1: Command.LOCK, 2: Command.UNLOCK}
_SESSION_ID = 1


class RadioWorld:
    """Steps the virtual robot, and lets the Car poll the key.

    Attributes:
        moved: lock events on the Car's bus that have not been consumed yet, in order.
    """

    def __init__(self, seed: int, car: HonestInstants, robot: VirtualRobot, errors: RadioErrors, key_x_m: float):
        self.moved: deque[Moved] = deque()
        self._car = car
        self._robot = robot
        self._key = CarriedKey(robot, errors, key_x_m)
        self._errors = errors
        self._chance = random.Random(f"radio {seed}")
        self._desired = DesiredState(stop=True)
        self._commands = 0
        self._waypoint_id = self._press_id = 0
        self._is_way = False
        self._press: tuple[int, Command] | None = None
        self._handle = False
        self._waiting: list[Moved] = []
        self._margin_forecast = MarginForecast(car, errors.heading_rad)

    @property
    def time_ns(self) -> int:
        """Time of robot and Car."""
        return self._key.time_ns

    def take(self, desired: DesiredState) -> None:
        """Accept a desired state of the application."""
        if desired is not self._desired and desired != self._desired:
            self._commands += 1
            self._desired = desired
        waypoint, press = desired.waypoint, desired.press
        if waypoint is not None and waypoint.id != self._waypoint_id:
            self._waypoint_id, self._is_way = waypoint.id, waypoint.direction is Direction.ANY
            if self._is_way:
                sigma_m = self._errors.line_m
                self._key.line = (self._chance.gauss(0.0, sigma_m), self._chance.gauss(0.0, sigma_m))
        if press is not None and press.id != self._press_id:
            self._press_id = press.id
            self._order(press)
        self._robot.take(_SESSION_ID, self._commands, desired)

    def take_handle(self) -> None:
        """Pull the driver's handle; the Car reacts at its next step."""
        self._handle = True

    def next_status(self) -> RobotStatus:
        """Advance the time until there is news, or a Status is due."""
        left = (_WAY_TICKS if self._is_way else _MEASURING_TICKS) if self._robot.is_driving else 1
        while left > 0:
            ticks = self._quiet_ticks(left)
            self._pass(ticks)
            left -= ticks
            if self.moved or not self._robot.is_driving:
                break
        return self._robot.status()

    def _quiet_ticks(self, most: int) -> int:
        """Return the number of ticks until the next event of a straight drive, including the tick of the event."""
        due_ns = self._car.due_ns
        if self._waiting or self._press is not None or self._handle or (
                due_ns is not None and due_ns <= self.time_ns + round(most * TICK_S * NS)):
            return 1
        poll_ns = self._car.next_poll_ns(self.time_ns)
        return most if poll_ns is None else min(math.ceil((poll_ns - self.time_ns) / (TICK_S * NS)), most)

    def _pass(self, ticks: int) -> None:
        self._key.go(ticks)
        for time_ns, does in self._instants():
            place = self._key.at(time_ns)
            if does is None:
                self._car.poll(time_ns, place, *self._margin_forecast.margins_db(time_ns, place, self._key))
            elif isinstance(does, Command):
                self._car.press(time_ns, does, place, self._attitude())
            else:
                self._car.take_handle(time_ns, place, self._attitude())
        self._waiting += self._car.pass_time(self.time_ns)
        while self._waiting and self._waiting[0].told_ns <= self.time_ns:
            self.moved.append(self._waiting.pop(0))

    def _instants(self) -> list[tuple[int, Command | bool | None]]:
        """Return the events of the Car in this tick in order of time: polls (None), received presses, handle pulls."""
        found: list[tuple[int, Command | bool | None]] = [
            (time_ns, None) for time_ns in self._car.polls_ns(self._key.before_ns, self.time_ns)]
        if self._press is not None and self._press[0] <= self.time_ns:
            found.append(self._press)
            self._press = None
        if self._handle:
            self._handle = False
            found.append((self._key.before_ns + STEP_NS, True))
        return sorted(found, key=lambda each: each[0]) if len(found) > 1 else found

    def _order(self, press: Press) -> None:
        """Schedule a press: after the travel of the servo, the Car receives it if the button is held long enough."""
        start_ns = self.time_ns + round(SERVO_TRAVEL_S * NS)
        if press.duration_s * NS >= self._car.contact_ns and press.buttons[0] in _BUTTONS and not self._desired.stop:
            self._press = (-(-start_ns // STEP_NS) * STEP_NS + self._car.contact_ns, _BUTTONS[press.buttons[0]])

    def _attitude(self) -> Attitude:
        return Attitude(self._key.heading - self._errors.heading_rad)
