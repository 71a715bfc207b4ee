"""Log of a Car's bus that replaces the bus: played at the speed of the robot's clock, from the first Status on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
from typing import Iterator, Mapping, Sequence

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.interfaces.car_bus import BusMonitor
from mtr_operator.domain.ports import CarEvent, CarLink, LockFacts, LockState
from mtr_operator.domain.results.refused import Refused
from mtr_operator.domain.results.session_record import CAN_ADAPTER
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.supervision.car_signals import CarSignals

from ..can_frame import CanFrame
from ..clocks.stamp_kind import StampKind
from ..lock_watch import LockWatch
from ..profile import CarProfile, load_profile
from .log_buses import LogBuses
from .read_log import ReadLog
from .text.lines import LoggedFrame

# Time for which a jump of the log's time, or the end of a gap, is reported: longer than the evaluation of a Status.
_TOLD_S = 1.0
_PLAYED = "none: the log {} was played"
_NOT_CONNECTED = "The CAN log is not open."


def played_log(session: Mapping[str, str]) -> str:
    """Return the name of the log that a test played instead of a bus, from its record; empty for a real bus."""
    begin, end = _PLAYED.split("{}")
    adapter = session.get(CAN_ADAPTER, "")
    return adapter[len(begin):-len(end)] if adapter.startswith(begin) and adapter.endswith(end) else ""


def played_frame(frame: LoggedFrame, begin_s: float, bus: str) -> CanFrame:
    """Return a frame of a log whose times begin at begin_s of the robot's clock, which times frames and Statuses."""
    return CanFrame(frame.can_id, frame.is_extended, frame.data, begin_s + frame.time_s, kind=StampKind.ARRIVAL,
                    is_fd=frame.is_fd, bus=bus)


class LogCarLink(CarLink, BusMonitor):
    """Link to a Car that is replayed from a log. path: a log of any kind, see read_log. profile: see CanCarLink.

    The log determines the Car's behaviour, regardless of the robot: its first frame is at the first Status.
    """

    def __init__(self, path: pathlib.Path, profile: str):
        self._path = path
        self._profile_name = profile
        self._profile: CarProfile | None = None
        self._watch: LockWatch | None = None
        self._buses: LogBuses | None = None
        self._log: ReadLog | None = None
        self._frames: Iterator[LoggedFrame] = iter(())
        self._next: LoggedFrame | None = None
        self._begin_s = self._stamp_s = math.nan
        self._noted, self._noted_until_s = "", -math.inf

    def connect(self) -> None:
        """See CarLink; ConnectionFailed if the log contains no frame."""
        self._profile = profile = load_profile(self._profile_name)
        self._watch, self._buses = LockWatch(profile), LogBuses(profile)
        self._log = ReadLog(self._path, profile.identifiers)
        self._frames = iter(self._log)
        self._next = next(self._frames, None)
        self._begin_s = math.nan
        self._noted, self._noted_until_s = self._log.newest, -math.inf

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        watch, buses = self._watch, self._buses
        if watch is None or buses is None:
            raise ConnectionFailed(_NOT_CONNECTED)
        if math.isnan(self._begin_s) and self._next is not None:
            self._begin_s = status.stamp_s - self._next.time_s
        while self._next is not None and self._begin_s + self._next.time_s <= status.stamp_s:
            watch.frame(played_frame(self._next, self._begin_s, buses.bus_of(self._next)))
            self._next = next(self._frames, None)
        self._stamp_s = status.stamp_s
        self._look_at_log()
        watch.status(status, status.stamp_s)
        return watch.release(status.stamp_s)

    def _look_at_log(self) -> None:
        """Report a gap or jump at its position, not before it and not at the end of the log."""
        if self._log is not None and self._log.newest != self._noted:
            # The frame after a gap arrives at the end of the gap.
            next_s = -math.inf if self._next is None else self._begin_s + self._next.time_s
            self._noted, self._noted_until_s = self._log.newest, max(self._stamp_s, next_s) + _TOLD_S

    @property
    def lock_state(self) -> LockState:
        return LockState.UNKNOWN if self._watch is None else self._watch.lock_state

    @property
    def facts(self) -> LockFacts:
        return LockFacts() if self._profile is None else self._profile.facts

    @property
    def signals(self) -> CarSignals:
        return () if self._watch is None else self._watch.signals

    @property
    def notices(self) -> Sequence[str]:
        """See BusMonitor: faults of the log, as far as it has been read."""
        notice = "" if self._log is None else self._log.notice
        watched = () if self._watch is None else self._watch.notices
        return (*((notice,) if notice else ()), *watched)

    @property
    def refused(self) -> Refused:
        return Refused() if self._watch is None else self._watch.refused

    @property
    def record(self) -> Mapping[str, str]:
        return {CAN_ADAPTER: _PLAYED.format(self._path.name)}

    @property
    def problem(self) -> str:
        if self._watch is None or self._log is None:
            return _NOT_CONNECTED
        if self._next is None and self._watch.problem:
            return self._log.ending or f"The CAN log {self._path} has come to its end."
        if self._next is not None and self._stamp_s < self._noted_until_s:
            return self._noted
        return self._watch.problem

    def close(self) -> None:
        self._frames, self._next, self._watch = iter(()), None, None
