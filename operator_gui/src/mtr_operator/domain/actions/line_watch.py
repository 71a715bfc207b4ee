"""Watches a line while it is measured: the Car's locks, the key's height, the robot's place on the line."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from ..geometry.ray import Ray
from ..ports import CarEvent, LockState
from ..results.course import ALLOWED, CLOSED, EXPECTED, HELD, WATCHED
from ..results.journal import plain_fields
from ..robot_status import RobotStatus
from .control_loop import ControlLoop
from .distance import Distance, measure
from .lock_history import Expected, LockHistory
from .pose_history import sample_of
from .tolerances import Tolerances
from .trouble import LineInvalid

# What was measured so shortly before a trouble was told is doubtful too: a Status is late by some tenths of a second.
_TOLD_LATE_S = 1.0
# What a line may not have been disturbed by, by the robot's counters.
INTERVENTIONS = {
    "manual_drives": "The robot was driven by hand during the measurement.",
    "manual_lifts": "The Remote key was moved by hand during the measurement.",
    "replans": "The robot planned its path anew during the measurement.",
    "blockages": "An obstacle, or sensors that saw nothing, stopped the robot during the measurement.",
    "lock_stops": "A motion lock stopped the robot during the measurement.",
    "firmware_resets": "The board of lift and servos restarted during the measurement.",
    "clock_steps": "The robot's clock was set during the measurement.",
}


class LineWatch:
    """One line, from its first Status on. Raises LineInvalid as soon as something is not as it should be.

    judges_locks: False where the Car may lock and unlock as it likes.

    Attributes:
        ray: the line on which the Remote key has to be carried from now on, None as long as it need not be.
    """

    def __init__(self, loop: ControlLoop, tolerances: Tolerances, *, judges_locks: bool = True):
        self.ray: Ray | None = None
        self._loop = loop
        self._tolerances = tolerances
        self._judges_locks = judges_locks
        self._history = LockHistory(self.lock_state, loop.car_link.facts, _unlocked_s(loop.events))
        self._newest = loop.events[-1] if loop.events else None
        self._before = loop.status.interventions
        loop.context.course.note(WATCHED, {"state": self._history.state.value, "unlocked_s": _unlocked_s(loop.events)})

    @property
    def now_s(self) -> float:
        """Robot time."""
        return self._loop.now_s

    @property
    def lock_state(self) -> LockState:
        """State of the locks now; LineInvalid when it is not known."""
        state = self._loop.car_link.lock_state
        if state is LockState.UNKNOWN:
            raise LineInvalid("The Car does not say whether it is locked.")
        return state

    @property
    def answer(self) -> CarEvent | None:
        """The change that was expected last, None while it has not come."""
        return self._history.answer

    def hold(self) -> None:
        """See LockHistory."""
        self._loop.context.course.note(HELD, {})
        self._history.hold()

    def allow_lock(self) -> None:
        """See LockHistory."""
        self._loop.context.course.note(ALLOWED, {})
        self._history.allow_lock()

    @property
    def is_locked(self) -> bool:
        """True when the changes so far leave the Car locked: no change of it is still to be told."""
        return self._history.state is LockState.LOCKED

    def expect(self, expected: Expected) -> None:
        """See LockHistory."""
        self._loop.context.course.note(EXPECTED, plain_fields(expected))
        self._history.expect(expected)

    def close(self) -> None:
        """See LockHistory."""
        self._loop.context.course.note(CLOSED, {})
        self._history.close(self._loop.now_s)

    @property
    def settles_s(self) -> float:
        """How late a change is told at most, so that an answer has to be waited for."""
        return self._loop.car_link.facts.settles_s

    @property
    def confirmed_s(self) -> float:
        """Robot time from which on the answer is to be believed if nothing takes it back."""
        return math.inf if self.answer is None else self.answer.time_s + self._loop.car_link.facts.confirm_s

    def check(self, status: RobotStatus) -> None:
        """Judge the newest Status and the changes that came with it."""
        for event in self._new_events() if self._judges_locks else ():
            self._history.take(event)
        self._check_interventions(status)
        self._check_height(status)
        if self.ray is not None:
            self._check_place(measure(self.ray, sample_of(status), 0.0))

    def check_distance(self, distance: Distance, low_m: float, high_m: float, speed_mps: float) -> None:
        """Judge the place of something measured: on the stretch from low_m to high_m, not faster than speed_mps."""
        margin_m = 3.0 * distance.uncertainty_m if math.isfinite(distance.uncertainty_m) else 0.0
        margin_m += self._tolerances.lateral_tolerance_m
        if not low_m - margin_m <= distance.distance_m <= high_m + margin_m:
            raise LineInvalid(f"The Car reacted at {distance.distance_m:.2f} m, where the robot was not to be: the "
                              f"line reaches from {low_m:.2f} to {high_m:.2f} m.")
        limit_mps = speed_mps + self._tolerances.speed_tolerance_mps
        if not abs(distance.speed_mps) <= limit_mps:
            raise LineInvalid(f"The robot was too fast for a measurement: {abs(distance.speed_mps):.2f} m/s; "
                              f"allowed is {limit_mps:.2f} m/s.")
        self._check_place(distance)

    def _new_events(self) -> list[CarEvent]:
        events, newest = self._loop.events, self._newest
        known = next((index for index in range(len(events) - 1, -1, -1) if events[index] is newest), -1)
        self._newest = events[-1] if events else newest
        return events[known + 1:]

    def _check_interventions(self, status: RobotStatus) -> None:
        if status.interventions == self._before:
            return
        for name, sentence in INTERVENTIONS.items():
            if getattr(status.interventions, name) != getattr(self._before, name):
                raise LineInvalid(sentence, since_s=status.stamp_s - _TOLD_LATE_S)

    def _check_height(self, status: RobotStatus) -> None:
        wanted_m, tolerance_m = self._loop.desired.key_height_m, self._tolerances.height_tolerance_m
        if wanted_m is None or abs(status.key_height_m - wanted_m) <= tolerance_m:
            return
        since_s = status.stamp_s - _TOLD_LATE_S
        if math.isnan(status.key_height_m):
            raise LineInvalid("The robot does not know the height of the Remote key.", since_s=since_s)
        raise LineInvalid(f"The Remote key is at {100.0 * status.key_height_m:.0f} cm instead of "
                          f"{100.0 * wanted_m:g} cm; allowed are {100.0 * tolerance_m:g} cm of difference.",
                          since_s=since_s)

    def _check_place(self, place: Distance) -> None:
        since_s = place.robot_time_s - _TOLD_LATE_S
        lateral_m, heading_rad = self._tolerances.lateral_tolerance_m, self._tolerances.heading_tolerance_rad
        if not abs(place.lateral_m) <= lateral_m:
            raise LineInvalid(f"The Remote key was {100.0 * abs(place.lateral_m):.0f} cm beside the line; allowed are "
                              f"{100.0 * lateral_m:g} cm.", since_s=since_s)
        if not abs(place.heading_rad) <= heading_rad:
            raise LineInvalid(f"The robot was turned by {math.degrees(abs(place.heading_rad)):.1f} degrees from the "
                              f"line; allowed are {math.degrees(heading_rad):g} degrees.", since_s=since_s)


def _unlocked_s(events: list[CarEvent]) -> float | None:
    """When the Car was unlocked last, None when it is locked or nobody saw it."""
    changes = [event for event in events if not event.doubt]
    return changes[-1].time_s if changes and changes[-1].lock_state is LockState.UNLOCKED else None
