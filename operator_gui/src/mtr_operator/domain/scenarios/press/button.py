"""One press of the Remote key's button, judged and kept before the robot goes on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Protocol

from ...actions.line_watch import LineWatch
from ...actions.lock_history import PRESS_SIGMA_S, Expected
from ...actions.robot import Robot
from ...geometry.ray import Ray
from ...ports import KEY_BUTTON, LockState
from ...results.line_result import LineStatus
from ..line_search.attempt import AttemptMade

LOCK_BUTTON, UNLOCK_BUTTON = 1, 2
# The press that changes the Car's present state: button and state that it should lead to.
_CHANGING_PRESS = {LockState.LOCKED: (UNLOCK_BUTTON, LockState.UNLOCKED),
                   LockState.UNLOCKED: (LOCK_BUTTON, LockState.LOCKED)}


def changing_button(locks: LockState) -> int:
    """The button that changes a state of the locks; LookupError for one that is not known."""
    return _CHANGING_PRESS[locks][0]


class PressParameters(Protocol):
    """What a press needs of a scenario's parameters."""

    @property
    def press_strength(self) -> float:
        """Travel of the button, 0 to 1."""

    @property
    def press_duration_s(self) -> float:
        """How long it is held down."""

    @property
    def response_timeout_s(self) -> float:
        """How long the Car may take."""

    @property
    def minimum_distance_m(self) -> float:
        """Nearest place on the ray."""

    @property
    def maximum_distance_m(self) -> float:
        """Farthest place on the ray."""


def press_once(radial: Ray, watch: LineWatch, parameters: PressParameters, robot: Robot, word: str) -> AttemptMade:
    """Press where the robot stands; it has settled. word: under which the press is kept.

    LineInvalid when it was no clean press, or when something else moved the Car's locks.
    """
    button, expected = _CHANGING_PRESS[watch.lock_state]
    # A change from here on to the press' beginning has another reason; when it begins is known when it is over.
    watch.hold()
    press = robot.press(button, parameters.press_strength, parameters.press_duration_s)
    place = robot.key_distance(radial, press.start_s, 0.0)
    watch.expect(Expected(expected, KEY_BUTTON, f"the press at {place.distance_m:.2f} m", press.start_s,
                          press.start_s + parameters.response_timeout_s, PRESS_SIGMA_S))
    watch.check_distance(place, parameters.minimum_distance_m, parameters.maximum_distance_m, 0.0)
    robot.wait(press.start_s + parameters.response_timeout_s + watch.settles_s - robot.now_s,
               or_when=lambda: watch.answer)
    if watch.answer is None:
        watch.close()
        robot.keep(word, LineStatus.NOT_REACHED, place)
        return AttemptMade(place, False)
    robot.wait(watch.confirmed_s - robot.now_s)
    made = AttemptMade(place.answered_by(watch.answer), True)
    robot.keep(word, LineStatus.OK, made.place)
    return made
