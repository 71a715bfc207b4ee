"""Holds: after a fault, a stop, an obstacle, manual driving or a silence the robot waits for the Operator."""
# SPDX-License-Identifier: Apache-2.0
import math

from mtr_core.liveness import NS
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import Goal
from mtr_core.schedule import STATE_MACHINE
from mtr_core.states import Result

from . import problems
from .observation import Observation
from .parameters import Parameters

MICROSECONDS_PER_S = 1e6
# The voltage of a battery recovers slightly when the robot stops; only a charged battery can cause another hold.
RECHARGED = 0.05
# Load steps and corrupt messages are shorter than this.
EMPTY_FOR_S = 10.0
# Tick times are compared with half a period of tolerance, so that rounding has no effect.
HALF_TICK_S = 0.5 * STATE_MACHINE.period_ns * NS


class Hold:
    """At most one hold; a new cause makes a new hold, which the Operator has to check again.

    Attributes:
        id: not 0 while the robot is on hold.
        reason: its sentence.
    """

    def __init__(self, parameters: Parameters):
        """resume_by_operator is false for a robot without people nearby, such as a simulated one: it has no holds."""
        self._parameters = parameters
        self._was_held_empty = False
        self._empty_since_s = math.inf
        self._updated_s = math.nan
        self._silent_since_s, self._was_held_silent = math.inf, False
        self._newest_id = self.id = 0
        self.reason = NO_PROBLEM
        self._seen_drives = self._seen_blockages = self._seen_resets = self._seen_stops = -1
        self._seen_jams = -1

    def update(self, seen: Observation, goal: Goal) -> None:
        """Process an observation: start a hold for its causes, or end it at the Operator's request."""
        if self.id and seen.desired.link_alive and seen.desired.resume_hold_id == self.id:
            self.id, self.reason = 0, NO_PROBLEM
        drive, pause_s = seen.drive, seen.now_s - self._updated_s
        self._updated_s = seen.now_s
        self._note_silence(seen)
        was_blocked = 0 <= self._seen_blockages < drive.blockages
        was_driven = 0 <= self._seen_drives < drive.manual_drives
        was_reset = 0 <= self._seen_resets < seen.firmware_resets
        self._seen_blockages, self._seen_drives = drive.blockages, drive.manual_drives
        was_stopped = 0 <= self._seen_stops < seen.emergency.stops
        self._seen_resets, self._seen_stops = seen.firmware_resets, seen.emergency.stops
        has_given_up = 0 <= self._seen_jams < seen.lift_jams
        self._seen_jams = seen.lift_jams
        # A person who releases an emergency stop is next to the robot. After service a key height alone moves the lift.
        is_service = seen.emergency.is_service
        stop = problems.HELD_SERVICE() if is_service else problems.HELD_EMERGENCY()
        if was_stopped or (seen.emergency.is_engaged and self.reason != stop):
            self.begin(stop, seen, was_ordered=is_service and bool(seen.desired.session_id))
        elif was_driven or (drive.is_manual and self.reason != problems.HELD_MANUAL()):
            self.begin(problems.HELD_MANUAL(), seen)
        elif seen.motion.is_about(goal) and seen.motion.result is Result.BLOCKED:
            self.begin(problems.HELD_BLOCKED_BECAUSE(cause=seen.motion.message), seen)
        elif was_blocked and goal.waypoint.id:
            self.begin(problems.HELD_BLOCKED(), seen)
        elif has_given_up:
            # A key height moves the lift even without a waypoint.
            self.begin(problems.HELD_LIFT(), seen, was_ordered=bool(seen.desired.session_id))
        elif was_reset:
            self.begin(problems.HELD_BOARD(), seen)
        elif pause_s > self._parameters.silent_after_s:
            self.begin(problems.HELD_PAUSE(pause_s=pause_s), seen)
        else:
            self._watch_orders(seen)
            self._watch_battery(seen)

    def _watch_orders(self, seen: Observation) -> None:
        """Watch stop and silence, which do not replace another reason, because its cause still has to be checked."""
        if seen.desired.link_alive:
            if seen.desired.stop and not self.id:
                self.begin(problems.HELD_STOP(), seen)
        elif not self._was_held_silent and self._is_long_silent(seen):
            self._was_held_silent = True
            # A robot on hold gets a new id as well, so that a resume order from before the silence is no longer valid.
            self.begin(self.reason or problems.HELD_LINK(), seen)

    def _note_silence(self, seen: Observation) -> None:
        if seen.desired.link_alive:
            self._silent_since_s, self._was_held_silent = math.inf, False
        else:
            self._silent_since_s = min(self._silent_since_s, seen.now_s)

    def _is_long_silent(self, seen: Observation) -> bool:
        return seen.now_s - self._silent_since_s > self._parameters.hold_after_lost_s + HALF_TICK_S

    def _watch_battery(self, seen: Observation) -> None:
        # An unknown charge is NaN and causes no hold.
        is_empty = seen.battery < self._parameters.empty_battery
        self._empty_since_s = min(self._empty_since_s, seen.now_s) if is_empty else math.inf
        if seen.battery >= self._parameters.empty_battery + RECHARGED:
            self._was_held_empty = False
        if seen.now_s - self._empty_since_s >= EMPTY_FOR_S and not self._was_held_empty and is_ordered(seen):
            self._was_held_empty = True
            self.begin(problems.HELD_BATTERY(percent=100.0 * seen.battery), seen)

    def begin(self, reason: Problem, seen: Observation, was_ordered: bool = False) -> None:
        """Hold the robot if an order could move it. was_ordered: such an order will return by itself."""
        if not (self._parameters.resume_by_operator and (was_ordered or is_ordered(seen))):
            return
        # The steady time makes the id unique, even across a restart of this node.
        self._newest_id = self.id = max(self._newest_id + 1, round(seen.now_s * MICROSECONDS_PER_S))
        self.reason = reason


def is_ordered(seen: Observation) -> bool:
    """Return True if the application has an order that moves the robot, even during a temporary stop."""
    desired = seen.desired
    return bool(desired.session_id and (desired.waypoint.id or desired.map_car_id or desired.check_car_id))
