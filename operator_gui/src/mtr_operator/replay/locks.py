"""The changes of the Car's locks anew, from the log of its bus, by a profile: as they were told with each Status."""
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
    """The parts of the live link on a log, in the order in which frames and Statuses came.

    phone: is given each frame, too.

    Attributes:
        watch: what follows the locks. facts: of the profile. frames: of the log so far. has_state: one of them was the
            message that tells the state. is_short: the log has ended before the test did.
            has_marks: the test has noted how far the log had come with each Status.
    """

    def __init__(self, profile: CarProfile, log: ReadLog, phone: ReplayedPhone | None = None, *,
                 is_played: bool = False):
        """is_played: the test played the log from its first Status on, in place of a bus."""
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
        """Events that a live link would have told with this Status."""
        if self._is_played:
            return self._play(moment.status)
        self.has_marks = self.has_marks or moment.mark is not None
        mark = moment.mark or BusMark()
        self._read_to(mark.frames, mark)
        self.watch.status(moment.status, mark.arrival_s)
        self._read_to(mark.released, mark)
        return self.watch.release(mark.told_s)

    def _play(self, status: RobotStatus) -> list[CarEvent]:
        """As LogCarLink did."""
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
