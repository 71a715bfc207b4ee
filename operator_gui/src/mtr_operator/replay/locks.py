"""Recomputes the lock changes of the Car from the log of its bus and a profile, as reported with each Status."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Iterator

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.clocks.stamp_kind import StampKind
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.log.log_buses import LogBuses
from mtr_operator.car_link.log.log_car import played_frame
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.car_link.log.text.lines import LoggedFrame
from mtr_operator.car_link.profile import CarProfile
from mtr_operator.domain.ports import BusMark, CarEvent
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.storage.recorded.course_file import Moment

from .phone import ReplayedPhone


class ReplayedLocks:
    """Parts of the live link applied to a log, in the recorded order of frames and Statuses.

    phone: receives each frame, too.

    Attributes:
        watch: follower of the locks. facts: of the profile. frames: of the log so far. has_state: the log contains the
            message of the state. is_short: the log ended before the test.
            has_marks: the test recorded the position of the log at each Status.
    """

    def __init__(self, profile: CarProfile, log: ReadLog, phone: ReplayedPhone | None = None, *,
                 is_played: bool = False):
        """is_played: the test played the log from its first Status on, instead of a bus."""
        self._buses = LogBuses(profile)
        self._phone = phone
        self.watch = LockWatch(profile)
        self.facts = profile.facts
        self.frames = 0
        self.has_state = self.is_short = self.has_marks = False
        self._is_played = is_played
        self._next: LoggedFrame | None = None
        self._log: Iterator[LoggedFrame] = iter(log)
        self._restarts = 0
        self._first_s = math.nan

    def take(self, moment: Moment) -> list[CarEvent]:
        """Return the events that a live link would have reported with this Status."""
        if self._is_played:
            return self._play(moment.status)
        self.has_marks = self.has_marks or moment.mark is not None
        mark = moment.mark or BusMark()
        self._read_to(mark.frames, mark)
        self.watch.status(moment.status, mark.arrival_s)
        self._read_to(mark.released, mark)
        return self.watch.release(mark.told_s)

    def _play(self, status: RobotStatus) -> list[CarEvent]:
        """Advance as LogCarLink does."""
        if math.isnan(self._first_s):
            self._next = next(self._log, None)
            self._first_s = status.stamp_s - (0.0 if self._next is None else self._next.time_s)
        while self._next is not None and self._first_s + self._next.time_s <= status.stamp_s:
            self.frames += 1
            self.watch.frame(played_frame(self._next, self._first_s, self._buses.bus_of(self._next)))
            self.has_state = self.has_state or self.watch.is_lock_message
            self._next = next(self._log, None)
        self.watch.status(status, status.stamp_s)
        return self.watch.release(status.stamp_s)

    def _read_to(self, count: int, mark: BusMark) -> None:
        if mark.restarts != self._restarts:
            self._restarts = mark.restarts
            self.watch.restart()
        while self.frames < count:
            frame = next(self._log, None)
            if frame is None:
                self.is_short = True
                return
            self.frames += 1
            known = self._frame(frame, mark)
            if self._phone is not None:
                self._phone.frame(known)
            self.watch.frame(known)
            self.has_state = self.has_state or self.watch.is_lock_message

    def _frame(self, frame: LoggedFrame, mark: BusMark) -> CanFrame:
        if math.isnan(self._first_s):
            self._first_s = frame.time_s
        local_s = mark.origin_s + (frame.time_s - self._first_s)
        kind = StampKind[mark.stamps] if mark.stamps else StampKind.ARRIVAL
        stamp_s = local_s if kind is StampKind.ADAPTER else None
        return CanFrame(frame.can_id, frame.is_extended, frame.data, local_s, None, stamp_s, kind, frame.is_fd,
                        self._buses.bus_of(frame))
