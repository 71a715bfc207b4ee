"""One handle request, judged and kept before the robot goes on, and the Car locked again after it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, replace

from ...actions.car import Car
from ...actions.line_watch import LineWatch
from ...actions.lock_history import PRESS_SIGMA_S, Expected
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...geometry.ray import Ray
from ...ports import HANDLE, PASSIVE_ENTRY, LockState
from ...requests import Direction
from ...results.line_result import LineStatus
from ..line_search.attempt import AttemptMade
from ..line_search.moves import wake_key
from ..press.button import LOCK_BUTTON
from .parameters import BUTTON, HandleRequestParameters

# A press near the Car fails by a lapse alone; so many in a row are no lapse.
LOCK_PRESSES = 5
# So many requests that came too late, and the axis is measured again.
_MAX_LATE = 3


@dataclass(frozen=True)
class Requester:
    """Makes the requests of one axis.

    Attributes:
        ray: where the key is carried. watch: of the axis.
    """

    ray: Ray
    parameters: HandleRequestParameters
    robot: Robot
    car: Car
    watch: LineWatch

    def request(self, word: str) -> tuple[AttemptMade, str]:
        """Take the handle where the robot stands, it has settled; what came of it, and who took it.

        word: under which the request is kept. LineInvalid when something else moved the Car's locks, or the Car is not
        locked before or after it; RobotFailed when nobody takes the handle.
        """
        self._have_locked()
        for _ in range(_MAX_LATE):
            made, by, rest_s = self._request_once()
            if made.worked or rest_s <= self.parameters.key_rest_limit_s:
                self.robot.keep(word, LineStatus.OK if made.worked else LineStatus.NOT_REACHED, made.place)
                # Before the robot drives on: as the key goes away the Car may lock by itself.
                self._have_locked()
                return made, by
            wake_key(self.ray, made.place.distance_m, self.parameters, self.robot)
        raise LineInvalid(f"The handle was taken {_MAX_LATE} times only after the key had stood for more than "
                          f"{self.parameters.key_rest_limit_s:g} s, when it may sleep; take it sooner, or increase "
                          "key_rest_limit_s if the key stays awake.")

    def _request_once(self) -> tuple[AttemptMade, str, float]:
        """The third is for how long the key had stood when the handle was taken, in s."""
        watch, parameters = self.watch, self.parameters
        # A change from here on to the request has another reason; when the handle is taken nobody knows yet.
        watch.hold()
        here_m = self.robot.key_distance(self.ray, self.robot.now_s, 0.0).distance_m
        with self.car.handle_taken(here_m, parameters.handle_timeout_s) as taken:
            rest_s, until_s = self.robot.rest_s, taken.taken_s + parameters.response_timeout_s
            place = self.robot.key_distance(self.ray, taken.taken_s, 0.0)
            watch.expect(Expected(LockState.UNLOCKED, self._cause, f"the handle request at {here_m:.2f} m",
                                  taken.asked_s, until_s, PRESS_SIGMA_S))
            watch.check_distance(place, parameters.minimum_distance_m, parameters.maximum_distance_m, 0.0)
            self.robot.wait(until_s - self.robot.now_s, or_when=lambda: watch.answer)
        event = watch.answer
        if event is None:
            watch.close()
            return AttemptMade(place, False), taken.by, rest_s
        self.robot.wait(watch.confirmed_s - self.robot.now_s)
        return AttemptMade(replace(place, source=event.source), True), taken.by, rest_s

    @property
    def _cause(self) -> str:
        """A bus that does not tell a handle from other passive entry tells both by the same word."""
        return HANDLE if HANDLE in self.car.facts.sources else PASSIVE_ENTRY

    def _have_locked(self) -> None:
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
            self.robot.wait(parameters.response_timeout_s, or_when=lambda: self.watch.is_locked)

    def _leave_until_locked(self) -> None:
        """To the end of the axis and back to where the robot stands."""
        here_m = self.robot.key_distance(self.ray, self.robot.now_s, 0.0).distance_m
        self.robot.go_to(self.ray, self.parameters.maximum_distance_m, Direction.BACKWARD)
        self.robot.wait_until_reached()
        self.robot.wait(self.parameters.lock_timeout_s, or_when=lambda: self.watch.is_locked)
        self.robot.go_to(self.ray, here_m, Direction.FORWARD)
        self.robot.wait_until_reached()
