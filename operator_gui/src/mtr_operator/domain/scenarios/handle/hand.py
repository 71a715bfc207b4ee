"""A hand at the Car's handle: what came of it, and the Car locked again after it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from ...actions.car import Car
from ...actions.line_watch import LineWatch
from ...actions.lock_history import PRESS_SIGMA_S, Expected
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...geometry.outline import origin_error
from ...geometry.ray import Ray
from ...ports import HANDLE, PASSIVE_ENTRY, LockState
from ...requests import Direction
from ..line_search.attempt import AttemptMade
from ..press.button import LOCK_BUTTON

# How the Car is locked again: the robot presses the key's button, or the key goes away.
BUTTON, ITSELF = "button", "itself"
# A press near the Car fails by a lapse alone; so many in a row are no lapse.
LOCK_PRESSES = 5


class HandleParameters(Protocol):
    """What a hand needs of a scenario's parameters; m and s."""

    @property
    def minimum_distance_m(self) -> float:
        """Nearest place of the key when the handle is taken."""

    @property
    def maximum_distance_m(self) -> float:
        """Starting distance of the line, to which the robot goes when the Car is to lock by itself."""

    @property
    def settle_time_s(self) -> float:
        """Standstill before each request."""

    @property
    def response_timeout_s(self) -> float:
        """How long the Car may take to unlock."""

    @property
    def handle_timeout_s(self) -> float:
        """How long a person may take to come to the handle."""

    @property
    def relock(self) -> str:
        """BUTTON or ITSELF."""

    @property
    def press_strength(self) -> float:
        """Travel of the lock button, 1 is pressed down fully."""

    @property
    def press_duration_s(self) -> float:
        """How long it is held down."""

    @property
    def lock_timeout_s(self) -> float:
        """How long the Car may take to lock by itself."""


@dataclass(frozen=True)
class HandTaken:
    """One request at the handle. by: who took it. rest_s: for how long the key had stood then, by Robot.rest_s."""

    made: AttemptMade
    by: str
    rest_s: float


@dataclass(frozen=True)
class Hand:
    """Takes the handle on one line.

    Attributes:
        ray: where the key is carried. watch: of the line.
    """

    ray: Ray
    parameters: HandleParameters
    robot: Robot
    car: Car
    watch: LineWatch

    def take(self) -> HandTaken:
        """Take the handle of the locked Car where the robot stands, it has settled.

        LineInvalid when something else moved the Car's locks; RobotFailed when nobody takes the handle.
        """
        watch, parameters = self.watch, self.parameters
        # A change from here on to the request has another reason; when the handle is taken nobody knows yet.
        watch.hold()
        here_m = self.robot.key_distance(self.ray, self.robot.now_s, 0.0).distance_m
        with self.car.handle_taken(here_m, parameters.handle_timeout_s) as taken:
            rest_s, until_s = self.robot.rest_s, taken.taken_s + parameters.response_timeout_s
            place = self.robot.key_distance(self.ray, taken.taken_s, 0.0,
                                            origin_error(self.ray, self.car.dimensions()))
            watch.expect(Expected(LockState.UNLOCKED, self._cause, f"the handle request at {here_m:.2f} m",
                                  taken.asked_s, until_s, PRESS_SIGMA_S))
            watch.check_distance(place, parameters.minimum_distance_m, parameters.maximum_distance_m, 0.0)
            self.robot.wait(until_s + watch.settles_s - self.robot.now_s, or_when=lambda: watch.answer)
        event = watch.answer
        if event is None:
            watch.close()
            return HandTaken(AttemptMade(place, False), taken.by, rest_s)
        self.robot.wait(watch.confirmed_s - self.robot.now_s)
        return HandTaken(AttemptMade(place.answered_by(event), True), taken.by, rest_s)

    @property
    def _cause(self) -> str:
        """A bus that does not tell a handle from other passive entry tells both by the same word."""
        return HANDLE if HANDLE in self.car.facts.sources else PASSIVE_ENTRY

    def have_locked(self) -> None:
        """Lock the Car, unless it is; LineInvalid when it stays unlocked."""
        if self.watch.is_locked:
            return
        self.watch.allow_lock()
        self.robot.say("have the Car locked again")
        if self.parameters.relock == BUTTON:
            self._lock_by_button()
        if not self.watch.is_locked:
            self._leave_until_locked()
        self.robot.wait(max(self.car.facts.confirm_s, self.parameters.settle_time_s))
        if not self.watch.is_locked:
            raise LineInvalid("The Car was not locked again, not even "
                              f"{self.parameters.lock_timeout_s:g} s after the key had gone away; lock it, and see "
                              "whether its key's lock button and its own lock work.")

    def _lock_by_button(self) -> None:
        parameters, presses = self.parameters, 0
        while not self.watch.is_locked and presses < LOCK_PRESSES:
            presses += 1
            self.robot.press(LOCK_BUTTON, parameters.press_strength, parameters.press_duration_s)
            self.robot.wait(parameters.response_timeout_s + self.watch.settles_s,
                            or_when=lambda: self.watch.is_locked)

    def _leave_until_locked(self) -> None:
        """To the end of the axis and back to where the robot stands."""
        here_m = self.robot.key_distance(self.ray, self.robot.now_s, 0.0).distance_m
        self.robot.go_to(self.ray, self.parameters.maximum_distance_m, Direction.BACKWARD)
        self.robot.wait_until_reached()
        self.robot.wait(self.parameters.lock_timeout_s, or_when=lambda: self.watch.is_locked)
        self.robot.go_to(self.ray, here_m, Direction.FORWARD)
        self.robot.wait_until_reached()
