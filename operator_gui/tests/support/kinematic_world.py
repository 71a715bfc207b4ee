"""A kinematic robot and a Car with an unlock and a lock radius, on one virtual clock, with faults on request."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.assistance import OUTPUT, ExtenderPort, HandlePort
from mtr_operator.domain.ports import HANDLE, KEY_BUTTON, PASSIVE_ENTRY, CarEvent, LockFacts, LockState
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.robot_status import CarDimensions, CarFrame, Mode, PressReport, WaypointResult

STATUS_PERIOD_S = 0.1
STEPS = 10
CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
KEY_X_M = 0.25
# A button works this long after it went down.
REACTION_S = 0.137


class World:
    """Virtual time, robot and Car.

    Attributes:
        unlock_m, lock_m: distances of the key from the Car's outline at which the locks move.
        press_range_m: distance of the key from the Car's centre up to which a button works.
        spoil: changes a Status before it leaves; returning None loses it.
        car_problem: sentence of the Car's bus at a time.
        refuses: reason why a waypoint is refused, empty when it is not.
        press_delay_s, reaction_s: from an order to the press, and from the press to the locks.
        foreign: changes of the locks by something else: time, whether locked then, source.
        source_of: what the Car says for the true source of a change. facts: what is known of the Car beforehand.
        check: what a self-check finds, None for a robot that knows none.
        frame: Car coordinate system of the poses.
        handle_m: distance of the key from the Car's outline up to which a hand at the handle unlocks.
        output: takes the handle; extender: switches an extender; phone: tells its distance; each None for a Car
            without one.
    """

    def __init__(self):
        self.unlock_m, self.lock_m, self.press_range_m = 1.5, 2.5, 5.2
        self.time_s, self.x, self.y, self.heading, self.speed_mps = 1.0, 4.0, 2.6, math.pi, 0.0
        self.near, self.facts = False, LockFacts(frozenset({PASSIVE_ENTRY, KEY_BUTTON}))
        self.height_m, self.locked, self.car, self.mode = 0.35, True, CAR, Mode.FOLLOWING_WAYPOINT
        self.spoil = lambda status: status
        self.car_problem = lambda time_s: ""
        self.refuses = lambda waypoint: ""
        self.source_of = lambda source: source
        self.check, self.frame, self.checked_id = None, CarFrame(), 0
        self.desired, self.waypoint, self.result, self.message = None, None, WaypointResult.NONE, ""
        self.press_delay_s, self.reaction_s, self.foreign = 0.03, REACTION_S, []
        self.handle_m, self.output, self.extender, self.phone = 1.5, None, None, None
        self.pressed, self.presses, self.toggles, self.events = set(), [], [], []
        self.signals = lambda time_s: ()

    def take(self, desired):
        self.desired = desired
        if desired.key_height_m is not None:
            self.height_m = desired.key_height_m
        waypoint = desired.waypoint
        if waypoint is not None and (self.waypoint is None or waypoint.id != self.waypoint.id):
            self.waypoint, self.message = waypoint, self.refuses(waypoint)
            self.result = WaypointResult.REFUSED if self.message else WaypointResult.PENDING
        self.checked_id = desired.check_car_id
        press = desired.press
        if press is not None and press.id not in self.pressed:
            self.pressed.add(press.id)
            start_s = self.time_s + self.press_delay_s
            self.presses.append(PressReport(press.id, start_s, start_s + press.duration_s))
            if math.hypot(*self.key()) <= self.press_range_m:
                self.toggles.append((start_s + self.reaction_s, press.buttons[0] == 1))

    def key(self):
        return self.x + KEY_X_M * math.cos(self.heading), self.y + KEY_X_M * math.sin(self.heading)

    def step(self):
        for _ in range(STEPS):
            self.time_s = round(self.time_s + STATUS_PERIOD_S / STEPS, 9)
            self._drive(STATUS_PERIOD_S / STEPS)
            self._watch_key()

    def _drive(self, dt_s):
        self.speed_mps = 0.0
        waypoint = self.waypoint
        if waypoint is None or self.result is not WaypointResult.PENDING or self.desired.stop or \
                self.desired.waypoint is None:
            return
        goal = waypoint.pose
        if waypoint.direction is Direction.ANY:  # on the way around the Car; only where it ends matters here
            self.x, self.y, self.heading = goal.x, goal.y, goal.heading
        dx, dy = goal.x - self.x, goal.y - self.y
        left_m, step_m = math.hypot(dx, dy), self.desired.max_speed_mps * dt_s
        if left_m <= step_m:
            self.x, self.y, self.heading, self.result = goal.x, goal.y, goal.heading, WaypointResult.REACHED
            return
        self.x, self.y = self.x + dx / left_m * step_m, self.y + dy / left_m * step_m
        self.speed_mps = self.desired.max_speed_mps

    def gap_m(self):
        x, y = self.key()
        return math.hypot(max(abs(x) - CAR.length / 2, 0.0), max(abs(y) - CAR.width / 2, 0.0))

    def take_handle(self):
        extender = self.extender
        nearer_m = extender.nearer_m if extender is not None and extender.is_on else 0.0
        if self.gap_m() - nearer_m <= self.handle_m:
            self.foreign.append((self.time_s + self.reaction_s, False, HANDLE))

    def _watch_key(self):
        gap_m = self.gap_m()
        # A departure that was no arrival locks nothing, as in the simulated Car.
        if not self.near and gap_m < self.unlock_m:
            self.near = True
            self.turn_locks(False, self.time_s, PASSIVE_ENTRY)
        elif self.near and self.unlock_m < gap_m and self.lock_m < gap_m and self.lock_m > 0:
            self.near = False
            self.turn_locks(True, self.time_s, PASSIVE_ENTRY)
        for toggle in [toggle for toggle in self.toggles if toggle[0] <= self.time_s]:
            self.toggles.remove(toggle)
            self.turn_locks(toggle[1], toggle[0], KEY_BUTTON)
        for change in [change for change in self.foreign if change[0] <= self.time_s]:
            self.foreign.remove(change)
            self.turn_locks(change[1], change[0], change[2])

    def turn_locks(self, locked, time_s, source):
        if locked is not self.locked:
            self.locked = locked
            state = LockState.LOCKED if locked else LockState.UNLOCKED
            self.events.append(CarEvent(time_s, 0.005, state, self.source_of(source)))


class FakeHandle(HandlePort):
    """Takes the world's handle so long after it was asked for; never with None. `asked` are the distances told."""

    def __init__(self, world, by=OUTPUT, delay_s=0.0):
        self.world, self.by, self.delay_s, self.asked, self.due_s, self.released = world, by, delay_s, [], None, 0

    def request(self, distance_m):
        self.asked.append(distance_m)
        self.due_s = None if self.delay_s is None else self.world.time_s + self.delay_s

    def is_taken(self):
        if self.due_s is None or self.world.time_s < self.due_s:
            return False
        if self.due_s > -math.inf:
            self.world.take_handle()
            self.due_s = -math.inf
        return True

    def release(self):
        self.due_s, self.released = None, self.released + 1


class FakeExtender(ExtenderPort):
    """Lets the handle of the world's Car find a key that is so many metres farther away, once it is switched on;
    `switched` are the orders. It is switched so long after it was asked for; never with None."""

    def __init__(self, world, nearer_m=0.0, by=OUTPUT, delay_s=0.0):
        self.world, self.nearer_m, self.by, self.delay_s = world, nearer_m, by, delay_s
        self.switched, self.wanted, self.due_s, self.is_on = [], False, math.inf, False

    def switch(self, is_on):
        self.switched.append(is_on)
        self.wanted, self.due_s = is_on, math.inf if self.delay_s is None else self.world.time_s + self.delay_s

    def is_switched(self):
        if self.world.time_s < self.due_s:
            return False
        self.is_on = self.wanted
        return True

    def release(self):
        self.due_s = math.inf
