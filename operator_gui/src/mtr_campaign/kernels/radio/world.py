"""Robot, key and Car in one place: time passes in ticks, and only what somebody has to see becomes a Status."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import random
from collections import deque

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_operator.domain.requests import DesiredState, Direction, Press
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.robot_link.virtual.keyholder import SERVO_TRAVEL_S
from mtr_operator.robot_link.virtual.robot import VirtualRobot
from mtr_simulation.car.ecu import Command
from mtr_simulation.car.honest.instants import STEP_NS, HonestInstants, Moved
from mtr_simulation.car.honest.radio.key_antenna import Attitude

from .errors import RadioErrors

# The application's own: a Status every tenth of a second, of which those without news are left out as long as the link
# is not taken for interrupted (LINK_GAP_S) and a pose between two of them is known (MAX_GAP_S).
TICK_S = 0.1
_MEASURING_TICKS, _WAY_TICKS = 4, 9
_NS = 1_000_000_000
# The margins of so many polls are computed at once while the key goes straight on.
_AHEAD, _AHEAD_NS = 24, 10 * _NS
# So far from where it was expected the margin of the radio is another one; fading changes within decimetres.
_SAME_PLACE_M = 1e-3
_SAME_HEADING_RAD = 1e-3
_BUTTONS = {1: Command.LOCK, 2: Command.UNLOCK}
_SESSION_ID = 1

Point = tuple[float, float, float]
Margins = tuple[FloatArray, FloatArray]


class RadioWorld:
    """Steps the virtual robot and has the Car look at the key.

    Attributes:
        moved: what the Car's bus has told, in order, until somebody takes it.
        time_ns: of both.
    """

    def __init__(self, seed: int, car: HonestInstants, robot: VirtualRobot, errors: RadioErrors, key_x_m: float):
        self.moved: deque[Moved] = deque()
        self.time_ns = round(robot.time_s * _NS)
        self._car = car
        self._robot = robot
        self._errors = errors
        self._key_x_m = key_x_m
        self._chance = random.Random(f"radio {seed}")
        self._line = (0.0, 0.0)
        self._desired = DesiredState(stop=True)
        self._commands = 0
        self._waypoint_id = self._press_id = 0
        self._is_way = False
        self._press: tuple[int, Command] | None = None
        self._handle = False
        self._waiting: list[Moved] = []
        self._ahead: dict[int, tuple[Point, float, Margins]] = {}
        self._key = self._key_now()
        self._heading = robot.pose.heading

    def take(self, desired: DesiredState) -> None:
        """A Command of the application."""
        if desired != self._desired:
            self._commands += 1
            self._desired = desired
        waypoint, press = desired.waypoint, desired.press
        if waypoint is not None and waypoint.id != self._waypoint_id:
            self._waypoint_id, self._is_way = waypoint.id, waypoint.direction is Direction.ANY
            if self._is_way:
                sigma_m = self._errors.line_m
                self._line = (self._chance.gauss(0.0, sigma_m), self._chance.gauss(0.0, sigma_m))
        if press is not None and press.id != self._press_id:
            self._press_id = press.id
            self._order(press)
        self._robot.take(_SESSION_ID, self._commands, desired)

    def take_handle(self) -> None:
        """A hand takes the driver's handle; the Car answers at its next step."""
        self._handle = True

    def next_status(self) -> RobotStatus:
        """Let time pass until there is news, or a Status is due anyway."""
        left = (_WAY_TICKS if self._is_way else _MEASURING_TICKS) if self._robot.is_driving else 1
        while left > 0:
            ticks = self._quiet_ticks(left)
            self._pass(ticks)
            left -= ticks
            if self.moved or not self._robot.is_driving:
                break
        return self._robot.status()

    def _quiet_ticks(self, most: int) -> int:
        """Up to the end of the tick in which something happens next, on a way on which the robot goes straight on."""
        end_ns = self.time_ns + round(most * TICK_S * _NS)
        due_ns = self._car.due_ns
        if self._waiting or self._press is not None or self._handle or (due_ns is not None and due_ns <= end_ns):
            return 1
        polls = self._car.polls_ns(self.time_ns, end_ns)
        return min(math.ceil((polls[0] - self.time_ns) / (TICK_S * _NS)), most) if polls else most

    def _pass(self, ticks: int) -> None:
        before_ns, before = self.time_ns, self._key
        self._robot.step(ticks * TICK_S)
        self.time_ns, self._key = round(self._robot.time_s * _NS), self._key_now()
        self._heading = self._robot.pose.heading
        for time_ns, does in self._instants(before_ns):
            part = (time_ns - before_ns) / (self.time_ns - before_ns)
            place = (before[0] + part * (self._key[0] - before[0]), before[1] + part * (self._key[1] - before[1]),
                     before[2] + part * (self._key[2] - before[2]))
            if does is None:
                self._car.poll(time_ns, place, self._margins(time_ns, place, before, ticks * TICK_S))
            elif isinstance(does, Command):
                self._car.press(time_ns, does, place, self._attitude())
            else:
                self._car.take_handle(time_ns, place, self._attitude())
        self._waiting += self._car.pass_time(self.time_ns)
        while self._waiting and self._waiting[0].told_ns <= self.time_ns:
            self.moved.append(self._waiting.pop(0))

    def _instants(self, before_ns: int) -> list[tuple[int, Command | bool | None]]:
        """What the Car does in this tick: looks for its key (None), receives a press, or is taken by its handle."""
        found: list[tuple[int, Command | bool | None]] = [
            (time_ns, None) for time_ns in self._car.polls_ns(before_ns, self.time_ns)]
        if self._press is not None and self._press[0] <= self.time_ns:
            found.append(self._press)
            self._press = None
        if self._handle:
            self._handle = False
            found.append((before_ns + STEP_NS, True))
        return sorted(found, key=lambda each: each[0])

    def _margins(self, time_ns: int, place: Point, before: Point, gone_s: float) -> Margins:
        known = self._ahead.get(time_ns)
        if known is None or math.dist(known[0], place) > _SAME_PLACE_M or abs(
                known[1] - self._heading) > _SAME_HEADING_RAD:
            self._look_ahead(time_ns, place, before, gone_s)
            known = self._ahead[time_ns]
        return known[2]

    def _look_ahead(self, time_ns: int, place: Point, before: Point, gone_s: float) -> None:
        """Margins of this poll and of the next ones, where the key is then if it goes on as it did for gone_s."""
        speed = [(now - then) / gone_s for now, then in zip(self._key, before)]
        times_ns = [time_ns, *self._car.polls_ns(time_ns, time_ns + _AHEAD_NS)][:_AHEAD]
        seconds = (np.array(times_ns) - time_ns) / _NS
        places = np.array(place) + seconds[:, None] * speed
        unlock_db, lock_db = self._car.margins.polled_db(places, self._attitude())
        self._ahead = {at: ((float(x), float(y), float(z)), self._heading, (unlock, lock)) for at, (x, y, z), unlock,
                       lock in zip(times_ns, places, unlock_db, lock_db)}

    def _order(self, press: Press) -> None:
        """The servo reaches the button, holds it, and the Car receives what is held long enough."""
        start_ns = self.time_ns + round(SERVO_TRAVEL_S * _NS)
        if press.duration_s * _NS >= self._car.contact_ns and press.buttons[0] in _BUTTONS and not self._desired.stop:
            self._press = (-(-start_ns // STEP_NS) * STEP_NS + self._car.contact_ns, _BUTTONS[press.buttons[0]])

    def _attitude(self) -> Attitude:
        return Attitude(self._heading - self._errors.heading_rad)

    def _key_now(self) -> Point:
        return self._errors.true_key(self._robot.pose, self._key_x_m, self._robot.key_height_m, self._line)
