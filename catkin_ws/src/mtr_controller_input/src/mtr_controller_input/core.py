"""The manual controller: converts its state to a velocity, a motion lock and a lift rate."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Sequence, Tuple

from mtr_core.liveness import is_fresh
from mtr_core.problems import NO_PROBLEM, Problem

from . import problems
from .parameters import Parameters


class Joy(NamedTuple):
    """State of all axes (-1 to 1) and buttons (1: held) of the controller."""

    axes: Tuple[float, ...]
    buttons: Tuple[int, ...]


# Age of a message whose driver sets no stamps.
UNKNOWN_AGE_S = math.nan


class Velocity(NamedTuple):
    """Velocity of base_link; active False: no manual command."""

    linear_mps: float
    angular_radps: float
    active: bool


RELEASED = Velocity(0.0, 0.0, False)


@dataclass(frozen=True)
class Outcome:
    """Result of a tick; lock_reason is empty if the robot may move."""

    velocity: Velocity = RELEASED
    lift_mps: float = 0.0
    lock_reason: Problem = NO_PROBLEM


class Controller:
    """Decides at each tick; stores whether the controller is lost or its emergency stop pressed.

    It is a source of the emergency stop. Because the state before its start is unknown, it starts as if the stop were
    pressed, and a person has to release it. After a loss the robot stops until the controller is back with no button
    held.
    """

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._joy: Optional[Joy] = None
        self._heard_s = self._changed_s = 0.0
        self._stop = problems.NOT_RELEASED()
        self._release_since_s: Optional[float] = None
        self._lost = NO_PROBLEM
        self._old_stamps = NO_PROBLEM

    def take(self, joy: Joy, now_s: float, age_s: float = UNKNOWN_AGE_S) -> None:
        """Process the next message of the controller's driver.

        age_s: from its stamp to its arrival. A message of a played recording is old; it may stop the robot, but neither
        moves it nor releases anything.
        """
        # Process the stop at once, so that a short press is not missed before the next tick.
        if _is_held(joy.buttons, self._parameters.e_stop_button):
            self._stop = problems.EMERGENCY_STOP()
        if not math.isnan(age_s) and not is_fresh(age_s, self._parameters.silent_after_s):
            self._old_stamps = problems.OLD_STAMPS(age_s=age_s)
            return
        if joy != self._joy:
            self._changed_s = now_s
        self._joy, self._heard_s = joy, now_s
        self._old_stamps = NO_PROBLEM

    def step(self, now_s: float, is_present: bool = True, intrusion: Problem = NO_PROBLEM) -> Outcome:
        """Decide at a tick.

        Args:
            is_present: the controller's device exists.
            intrusion: another node publishes on the driver's topic.
        """
        if intrusion:
            # As after a loss of the controller, the robot stays locked until the buttons are released.
            self._lost, self._release_since_s = problems.LOST(), None
            return Outcome(lock_reason=intrusion)
        if self._joy is None:
            return Outcome(lock_reason=self._old_stamps or problems.NOT_HEARD())
        wanted = velocity(self._parameters, self._joy.axes, self._joy.buttons)
        self._watch(now_s, is_present, wanted, self._lift(self._joy.axes))
        self._watch_release(now_s, self._joy.buttons)
        if self._stop:
            return Outcome(lock_reason=self._stop)
        if self._lost:
            return Outcome(lock_reason=self._lost)
        return Outcome(wanted, self._lift(self._joy.axes) if wanted.active else 0.0)

    def _watch(self, now_s: float, is_present: bool, wanted: Velocity, lift_mps: float) -> None:
        if not is_present or not 0.0 <= now_s - self._heard_s <= self._parameters.silent_after_s:
            self._lost = self._old_stamps or problems.LOST()
        elif _moves(wanted, lift_mps) and now_s - self._changed_s > self._parameters.frozen_after_s:
            self._lost = problems.FROZEN()
        elif not wanted.active:
            self._lost = NO_PROBLEM

    def _watch_release(self, now_s: float, buttons: Sequence[int]) -> None:
        held = {index for index, value in enumerate(buttons) if value == 1}
        if self._lost or held != set(self._parameters.release_buttons):
            self._release_since_s = None
        elif self._release_since_s is None:
            self._release_since_s = now_s
        elif now_s - self._release_since_s >= self._parameters.release_after_s:
            self._stop = NO_PROBLEM

    def _lift(self, axes: Sequence[float]) -> float:
        return self._parameters.lift_mps * _deflection(self._parameters, axes, self._parameters.lift_axis)


def velocity(parameters: Parameters, axes: Sequence[float], buttons: Sequence[int]) -> Velocity:
    """Return the velocity for the controller's state. A missing axis or button counts as released."""
    if _is_held(buttons, parameters.fast_button):
        linear_mps, angular_radps = parameters.fast_mps, parameters.fast_radps
    elif _is_held(buttons, parameters.slow_button):
        linear_mps, angular_radps = parameters.slow_mps, parameters.slow_radps
    else:
        return RELEASED
    return Velocity(linear_mps * _deflection(parameters, axes, parameters.linear_axis),
                    angular_radps * _deflection(parameters, axes, parameters.angular_axis), True)


def _moves(wanted: Velocity, lift_mps: float) -> bool:
    return wanted.active and (wanted.linear_mps, wanted.angular_radps, lift_mps) != (0.0, 0.0, 0.0)


def _is_held(buttons: Sequence[int], index: int) -> bool:
    return index < len(buttons) and buttons[index] == 1


def _deflection(parameters: Parameters, axes: Sequence[float], index: int) -> float:
    value = axes[index] if index < len(axes) else 0.0
    if not math.isfinite(value) or abs(value) < parameters.dead_zone:
        return 0.0
    return min(max(value, -1.0), 1.0)
