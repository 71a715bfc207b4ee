"""One pass of an axis: the approach until the Car unlocks, and the retreat until it locks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field

from ..actions.car import Car
from ..actions.distance import Distance
from ..actions.line_watch import LineWatch
from ..actions.lock_history import Expected
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..geometry.axes import Axis
from ..geometry.outline import origin_error
from ..ports import PASSIVE_ENTRY, LockState
from ..requests import Direction
from ..results.frame_history import KnownFrame
from ..results.line_result import LineStatus
from .autolock_parameters import AutolockParameters
from .autolock_result import LOCK, UNLOCK, pass_word
from .autolock_resume import come_back, is_on_axis

_VICINITY = "the Remote key's vicinity"
# Before the place where a former pass unlocked the slow part begins: the way of a reaction, and of what varies.
_REACTION_S, _VARIES_M = 1.3, 0.25
# Room to straighten and to get up to speed, behind where the slow part begins.
_RUN_UP_M = 0.1


@dataclass
class Measured:
    """One of the two measurements of a pass; time_s: robot time from which on it holds."""

    status: LineStatus = LineStatus.INVALID
    distance: Distance | None = None
    time_s: float = math.inf


@dataclass
class AxisPass:
    """Attributes: number: from 1. speed_mps: its limit. step_m: of an approach in steps, None in one go."""

    number: int
    speed_mps: float
    step_m: float | None = None
    unlock: Measured = field(default_factory=Measured)
    lock: Measured = field(default_factory=Measured)

    @property
    def is_complete(self) -> bool:
        """The Car has unlocked and locked."""
        return self.unlock.distance is not None and self.lock.distance is not None


class Course:
    """What the robot does on one axis."""

    def __init__(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car):
        self._line = line
        self._parameters = parameters
        self._robot = robot
        self._car = car
        # Of the first pass, None before it.
        self._frame: KnownFrame | None = None

    @property
    def is_frame_left(self) -> bool:
        """True when the robot has another Car coordinate system than in the first pass, so that none belongs to it."""
        now = self._robot.frame
        return self._frame is not None and (now is None or not now.is_same(self._frame))

    def measure(self, this: AxisPass, former: AxisPass | None = None) -> None:
        """Fill a pass, with what is kept of it; former: one that tells where the Car reacts. Raises LineInvalid."""
        unlock_word, lock_word = pass_word(UNLOCK, this.number), pass_word(LOCK, this.number)
        _take_up(this.unlock, self._robot.kept(unlock_word))
        _take_up(this.lock, self._robot.kept(lock_word))
        if this.unlock.distance is None:
            slow_m = self._go_to_start() if former is None else self._go_back(former)
        if self.is_frame_left:
            raise LineInvalid("The Car coordinate system was corrected during the measurement.")
        self._frame = self._robot.frame
        with self._robot.watched(self._parameters) as watch:
            if this.unlock.distance is None:
                self._approach(this, watch, slow_m)
                self._record(this.unlock, watch)
                self._robot.keep(unlock_word, this.unlock.status, this.unlock.distance)
            elif this.lock.distance is None:
                come_back(self._line.ray, this.unlock.distance, self._robot)
            if this.lock.distance is None:
                self._robot.set_maximum_speed(this.speed_mps)
                self._retreat(watch, is_unlocked=this.unlock.distance is not None)
                self._record(this.lock, watch)
                self._robot.keep(lock_word, this.lock.status, this.lock.distance)

    def _go_to_start(self) -> float:
        """To where an axis begins; the distance at which the straightening ends."""
        line, parameters, robot = self._line, self._parameters, self._robot
        robot.say(f"axis {line.number} ({line.side.replace('_', ' ')}): go to the start")
        robot.set_maximum_speed(parameters.maximum_speed_mps)
        robot.go_to(line.ray, parameters.maximum_distance_m)
        robot.wait_until_reached()
        self._wait_for_lock(parameters.maximum_distance_m)
        return parameters.straightened_distance_m

    def _go_back(self, former: AxisPass) -> float:
        """To where one more pass begins; the distance from which on it is slow."""
        parameters, robot = self._parameters, self._robot
        if former.unlock.distance is None or former.lock.distance is None or not is_on_axis(
                self._line.ray, parameters, robot):
            return self._go_to_start()
        reach_m = _REACTION_S * former.speed_mps + _VARIES_M
        slow_m = min(former.unlock.distance.distance_m + reach_m, parameters.straightened_distance_m)
        start_m = min(max(slow_m, former.lock.distance.distance_m) + _RUN_UP_M, parameters.maximum_distance_m)
        robot.set_maximum_speed(parameters.maximum_speed_mps)
        if robot.key_distance(self._line.ray, robot.now_s, 0.0).distance_m < start_m:
            robot.go_to(self._line.ray, start_m, Direction.BACKWARD)
            robot.wait_until_reached()
        self._wait_for_lock(start_m)
        return slow_m

    def _wait_for_lock(self, distance_m: float) -> None:
        robot, car, timeout_s = self._robot, self._car, self._parameters.lock_timeout_s
        robot.wait(timeout_s, or_when=lambda: car.is_locked() and not robot.trouble())
        if robot.trouble():
            raise LineInvalid(robot.trouble())
        if not car.is_locked():
            raise LineInvalid(
                f"The Car was still unlocked {timeout_s:g} s after the robot had reached the starting "
                f"distance of {distance_m:g} m; lock it with its key, or increase maximum_distance_m if "
                "it locks farther away.")

    def _approach(self, this: AxisPass, watch: LineWatch, slow_m: float) -> None:
        parameters, robot, axis = self._parameters, self._robot, self._line.ray
        robot.say("approach until the Car unlocks" if this.number == 1
                  else f"pass {this.number}: approach until the Car unlocks")
        watch.expect(Expected(LockState.UNLOCKED, PASSIVE_ENTRY, _VICINITY, robot.now_s))
        robot.go_to(axis, slow_m, Direction.FORWARD)
        robot.wait_until_reached(or_when=lambda: watch.answer)
        watch.ray = axis
        robot.set_maximum_speed(this.speed_mps)
        if this.step_m is not None:
            self._step_nearer(watch, slow_m, this.step_m)
        if not watch.answer:
            robot.go_to(axis, parameters.minimum_distance_m, Direction.FORWARD)
            robot.wait_until_reached(or_when=lambda: watch.answer)
        robot.wait(parameters.response_timeout_s + watch.settles_s, or_when=lambda: watch.answer)

    def _step_nearer(self, watch: LineWatch, from_m: float, step_m: float) -> None:
        """Stand after each step for as long as the Car may take; ends where it reacts, or a step before the minimum."""
        parameters, robot = self._parameters, self._robot
        distance_m = from_m - step_m
        while not watch.answer and distance_m > parameters.minimum_distance_m:
            robot.go_to(self._line.ray, distance_m, Direction.FORWARD)
            robot.wait_until_reached()
            robot.wait(parameters.response_timeout_s + watch.settles_s, or_when=lambda: watch.answer)
            distance_m -= step_m

    def _retreat(self, watch: LineWatch, is_unlocked: bool) -> None:
        parameters, robot = self._parameters, self._robot
        robot.say("retreat until the Car locks")
        watch.ray = self._line.ray
        if is_unlocked:
            watch.expect(Expected(LockState.LOCKED, PASSIVE_ENTRY, _VICINITY, robot.now_s))
        else:
            watch.close()
        robot.go_to(self._line.ray, parameters.straightened_distance_m, Direction.BACKWARD)
        robot.wait_until_reached(or_when=lambda: watch.answer)
        robot.wait(parameters.response_timeout_s + watch.settles_s, or_when=lambda: watch.answer)
        # What a single frame says may be a glitch: the one before was followed by the retreat, this one by nothing.
        robot.wait(watch.confirmed_s - robot.now_s if watch.answer else 0.0)

    def _record(self, measured: Measured, watch: LineWatch) -> None:
        event, parameters, axis = watch.answer, self._parameters, self._line.ray
        if event is None:
            measured.status, measured.time_s = LineStatus.NOT_REACHED, watch.now_s
            return
        distance = self._robot.key_distance(axis, event.time_s, event.time_sigma_s,
                                            origin_error(axis, self._car.dimensions()))
        watch.check_distance(distance, parameters.minimum_distance_m, parameters.maximum_distance_m,
                             parameters.maximum_speed_mps)
        measured.distance = distance.answered_by(event)
        measured.status, measured.time_s = LineStatus.OK, event.time_s


def _take_up(measured: Measured, kept: Distance | None) -> None:
    if kept is not None:
        measured.distance, measured.status, measured.time_s = kept, LineStatus.OK, kept.robot_time_s
