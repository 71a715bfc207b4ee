"""Recomputes all measurements of a test: the Car's reactions from the log, and the key's positions from the recorded
poses. The expectations are as in the test, because the robot's actions are unchanged."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Iterable, Mapping

from mtr_operator.domain.actions.distance import Distance, measure_at
from mtr_operator.domain.actions.lock_history import Expected, LockHistory
from mtr_operator.domain.actions.pose_history import PoseHistory, PoseUnknown
from mtr_operator.domain.actions.trouble import LineInvalid
from mtr_operator.domain.geometry.outline import origin_error
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.ports import CarEvent, LockState
from mtr_operator.domain.results.course import ALLOWED, CLOSED, EXPECTED, HELD, UNWATCHED, WATCHED
from mtr_operator.domain.results.journal import FURTHER, LINE, LINE_BEGUN, LINE_RESUMED, POINT
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus
from mtr_operator.domain.scenarios.digital_key.result import DigitalKeyResult
from mtr_operator.storage.recorded.course_file import Entry, Moment

from .locks import ReplayedLocks
from .phone import ReplayedPhone


@dataclass(frozen=True)
class Point:
    """One measurement: name, recorded and recomputed values. doubt: reason why it would be invalid now."""

    word: str
    status: LineStatus
    distance: Distance | None
    new_status: LineStatus
    new_distance: Distance | None
    doubt: str = ""


@dataclass
class Attempt:
    """Line from its start to its result; values: of the recorded result, empty without one."""

    number: int
    points: list[Point] = field(default_factory=list)
    values: Mapping[str, Any] = field(default_factory=dict)
    # Point after the last one, for a line that was recorded as invalid.
    after: Point | None = None
    # Place of a measured phone distance.
    place: DigitalKeyResult | None = None


class _Watch:
    """Locks of a line as watched by the test."""

    def __init__(self, history: LockHistory):
        self.history = history
        self.expected: Expected | None = None
        self.doubt = ""
        self.is_on = True

    def try_to(self, step: Any) -> None:
        try:
            step()
        except LineInvalid as error:
            self.doubt = self.doubt or str(error)


class Points:
    """Measurements, updated with the course of consecutive runs; rays: of the lines by their number. phone: of a test
    with a phone's distance from the Car's bus."""

    def __init__(self, rays: Mapping[int, Ray], car: CarDimensions, phone: ReplayedPhone | None = None):
        self.attempts: list[Attempt] = []
        self.phone = phone
        self._current: Attempt | None = None
        self._rays = rays
        self._car = car

    def follow(self, entries: Iterable[Entry], locks: ReplayedLocks) -> None:
        """Follow one run."""
        poses, watch, before = PoseHistory(), None, None
        self._forget(poses)
        for entry in entries:
            if isinstance(entry, Moment):
                self._take(entry, before, poses)
                before = entry.status
                self._feed(watch, locks.take(entry))
                if self.phone is not None:
                    self.phone.observe(before)
            elif entry.kind == WATCHED:
                watch = _Watch(_history(locks, entry.values))
                if self.phone is not None and before is not None:
                    self.phone.begin(before.stamp_s)
            elif entry.kind in (LINE_BEGUN, LINE_RESUMED, FURTHER):
                self._begin_line(entry.kind, int(entry.values["line"]))
            elif entry.kind == LINE and self._current is not None:
                self._end_line(self._current, entry.values["result"], watch, poses)
            elif watch is not None and before is not None:
                self._note(entry.kind, entry.values, watch, poses, before.stamp_s)

    def _take(self, moment: Moment, before: RobotStatus | None, poses: PoseHistory) -> None:
        status = moment.status
        if before is not None and (before.car_frame.revision != status.car_frame.revision
                                   or before.robot_session_id != status.robot_session_id):
            self._forget(poses)
        poses.add(status)

    def _forget(self, poses: PoseHistory) -> None:
        """Discard the state at a new run, session or frame: earlier data does not apply to it."""
        poses.clear()
        if self.phone is not None:
            self.phone.forget()

    def _begin_line(self, kind: str, number: int) -> None:
        former = next((each for each in reversed(self.attempts) if each.number == number), None)
        if kind == LINE_BEGUN or former is None:
            former = Attempt(number)
            self.attempts.append(former)
        self._current = former

    @staticmethod
    def _feed(watch: _Watch | None, events: Iterable[CarEvent]) -> None:
        for event in events:
            if watch is not None and watch.is_on:
                watch.try_to(partial(watch.history.take, event))

    def _note(self, kind: str, values: Mapping[str, Any], watch: _Watch, poses: PoseHistory, now_s: float) -> None:
        history = watch.history
        if kind == HELD:
            history.hold()
        elif kind == ALLOWED:
            history.allow_lock()
        elif kind == CLOSED:
            history.close(now_s)
        elif kind == UNWATCHED:
            watch.is_on = False
        elif kind == EXPECTED:
            watch.expected = expected = _expected(values)
            watch.try_to(lambda: history.expect(expected))
        elif kind == POINT and self._current is not None:
            point = self._point(self._current, values, watch, poses)
            if self.phone is not None:
                point = self._at_place(self._current, self.phone, point, poses, now_s)
            self._current.points.append(point)

    @staticmethod
    def _at_place(attempt: Attempt, phone: ReplayedPhone, point: Point, poses: PoseHistory, now_s: float) -> Point:
        """Evaluate the phone's distance; the locks do not matter."""
        if point.new_distance is None:
            return point
        try:
            attempt.place = phone.result(attempt.number, point.new_distance, poses, now_s)
        except (LineInvalid, PoseUnknown) as error:
            return dataclasses.replace(point, new_status=LineStatus.INVALID, doubt=str(error))
        return dataclasses.replace(point, new_status=attempt.place.status, doubt=attempt.place.reason)

    def _end_line(self, attempt: Attempt, result: Mapping[str, Any], watch: _Watch | None, poses: PoseHistory) -> None:
        attempt.values = result
        if result.get("reason") and watch is not None and watch.expected is not None:
            attempt.after = self._now(attempt, watch.expected.what, watch, poses, None)

    def _point(self, attempt: Attempt, values: Mapping[str, Any], watch: _Watch, poses: PoseHistory) -> Point:
        kept = values["distance"]
        known: dict[str, Any] = {name: math.nan if value is None else value for name, value in (kept or {}).items()}
        distance = Distance(**known) if known else None
        now = self._now(attempt, str(values["word"]), watch, poses, distance)
        return dataclasses.replace(now, status=LineStatus(values["status"]), distance=distance)

    def _now(self, attempt: Attempt, word: str, watch: _Watch, poses: PoseHistory, kept: Distance | None) -> Point:
        """Evaluate locks and poses for the current expectation."""
        answer, ray = watch.history.answer, self._rays.get(attempt.number)
        status = LineStatus.INVALID if watch.doubt else LineStatus.NOT_REACHED if answer is None else LineStatus.OK
        new, doubt = None, watch.doubt
        try:
            if ray is not None:
                new = self._distance(ray, watch, answer, kept, poses)
        except PoseUnknown as error:
            status, doubt = LineStatus.INVALID, doubt or str(error)
        return Point(word, LineStatus.INVALID, None, status, new, doubt)

    def _distance(self, ray: Ray, watch: _Watch, answer: CarEvent | None, kept: Distance | None,
                  poses: PoseHistory) -> Distance | None:
        """Return the distance: in an approach at the event; with button or handle at the position of the attempt."""
        if watch.expected is not None and math.isinf(watch.expected.until_s):
            if answer is None or watch.doubt:
                return None
            distance = measure_at(ray, poses, answer.time_s, answer.time_sigma_s, origin_error(ray, self._car))
            return distance.answered_by(answer)
        if kept is None:
            return None
        return measure_at(ray, poses, kept.robot_time_s, 0.0, origin_error(ray, self._car))


def _history(locks: ReplayedLocks, values: Mapping[str, Any]) -> LockHistory:
    state, unlocked_s = locks.watch.lock_state, values.get("unlocked_s")
    known = LockState(values["state"]) if state is LockState.UNKNOWN else state
    return LockHistory(known, locks.facts, unlocked_s)


def _expected(values: Mapping[str, Any]) -> Expected:
    known = dict(values)
    known["state"] = LockState(known["state"])
    # JSON has no infinity.
    known["until_s"] = math.inf if known.get("until_s") is None else known["until_s"]
    return Expected(**known)
