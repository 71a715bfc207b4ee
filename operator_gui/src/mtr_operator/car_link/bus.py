"""The link to the Car: a CAN adapter behind python-can, and the lock events on the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import threading
import time
from dataclasses import replace
from typing import Any, Callable, Mapping, Sequence

import can

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import (
    BusMark,
    BusMessages,
    BusTraffic,
    CarEvent,
    CarLink,
    HandlePort,
    LockFacts,
    LockState,
    Refused,
)
from mtr_operator.domain.results.session_record import CAN_ADAPTER, CAN_STAMPS
from mtr_operator.domain.robot_status import RobotStatus

from .adapter import AdapterSettings, open_adapter
from .bus_trouble import BusTrouble
from .can_frame import CanFrame
from .handle import BusHandle
from .lock_watch import LockWatch
from .log.bus_log import BusLog
from .message_table import MessageTable
from .profile import CarProfile, load_profile
from .reader import CanReader, FrameSink
from .traffic import TrafficMeter

# Wall time for which observe() waits at most for the bus to catch up.
CATCH_UP_LIMIT_S = 0.25
_NOT_CONNECTED = "The Car's CAN bus is not connected."
_OUTPUT_IDLE = ("The car's profile names an output that takes the handle, and the CAN adapter only listens: a person "
                "takes it; choose normal mode (--can-normal) to have it switched.")


class CanCarLink(CarLink, FrameSink):
    """Watches the locks on the CAN bus, and sends nothing on it unless it is opened in normal mode.

    profile: name of a shipped car profile, or path of a YAML file. options: passed to python-can's driver.
    clock: the laptop's, monotonic, in s. is_listening, data_bitrate: see AdapterSettings.

    Attributes:
        profile: the loaded car profile, None before connect().
        frames_received: data frames of any message since the start.
    """

    def __init__(self, interface: str, channel: str, bitrate: int = 500_000, profile: str = "mtr_demo_car",
                 options: dict[str, Any] | None = None, *, clock: Callable[[], float] = time.monotonic,
                 is_listening: bool = True, data_bitrate: int | None = None):
        self._settings = AdapterSettings(interface, str(channel), bitrate, dict(options or {}), is_listening,
                                         data_bitrate)
        self._profile_name = str(profile)
        self._clock = clock
        self._watch: LockWatch | None = None
        self._reader: CanReader | None = None
        self._changed = threading.Condition()
        self._trouble = BusTrouble(self._settings)
        self._log: BusLog | None = None
        self._mark: BusMark | None = None
        self._restarts = 0
        self._traffic = TrafficMeter(bitrate, data_bitrate)
        self._table = MessageTable()
        self._handle: HandlePort | None = None
        self.profile: CarProfile | None = None
        self.frames_received = 0

    def connect(self) -> None:
        """See CarLink."""
        if self._reader is not None:
            return
        self.profile = load_profile(self._profile_name)
        self._watch = LockWatch(self.profile)
        self._table = MessageTable(self.profile.message_names)
        reader = CanReader(lambda: open_adapter(self._settings), self, self._settings.interface, self._clock)
        reader.start()
        self._reader = reader
        output = self.profile.handle_output
        self._handle = None if output is None or self._settings.is_listening else BusHandle(output, self._send)

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """See CarLink."""
        arrival_s = self._clock()
        watch = self._watch
        if self._reader is None or watch is None:
            raise ConnectionFailed(_NOT_CONNECTED)
        with self._changed:
            watch.status(status, arrival_s)
            logged = 0 if self._log is None else self._log.frames
            self._changed.wait_for(lambda: bool(self._trouble.fault) or watch.has_caught_up(), CATCH_UP_LIMIT_S)
            self._trouble.status(status.stamp_s)
            told_s = self._clock()
            if self._log is not None:
                stamps = "" if watch.stamps is None else watch.stamps.name
                self._mark = BusMark(logged, self._log.frames, arrival_s, told_s, self._log.origin_s, stamps,
                                     self._restarts)
            return watch.release(told_s)

    @property
    def lock_state(self) -> LockState:
        """See CarLink."""
        with self._changed:
            return LockState.UNKNOWN if self._watch is None or self._trouble.problem else self._watch.lock_state

    @property
    def facts(self) -> LockFacts:
        """See CarLink."""
        return LockFacts() if self.profile is None else self.profile.facts

    @property
    def handle(self) -> HandlePort | None:
        """See CarLink: what the profile declares."""
        return self._handle

    @property
    def traffic(self) -> BusTraffic | None:
        """See CarLink."""
        with self._changed:
            if self.profile is None or self._watch is None:
                return None
            now = self._traffic.traffic(self._clock(), self.profile.cycle_time_s)
            stamps = self._watch.stamps
            return replace(now, clock_problem=self._watch.clock_problem, stamps="" if stamps is None else stamps.value)

    @property
    def record(self) -> Mapping[str, str]:
        """See CarLink."""
        stamps = None if self._watch is None else self._watch.stamps
        timed = {} if stamps is None else {CAN_STAMPS: stamps.text}
        return {CAN_ADAPTER: self._settings.text, **timed}

    @property
    def notices(self) -> Sequence[str]:
        """See CarLink."""
        has_idle_output = self.profile is not None and self.profile.handle_output is not None and self._handle is None
        return (_OUTPUT_IDLE,) if has_idle_output else ()

    def log_to(self, path: pathlib.Path | None) -> None:
        """See CarLink."""
        log = None if path is None else BusLog(path)
        with self._changed:
            former, self._log, self._mark, self._restarts = self._log, log, None, 0
        if former is not None:
            former.close()

    @property
    def log_problem(self) -> str:
        """See CarLink."""
        return "" if self._log is None else self._log.problem

    @property
    def mark(self) -> BusMark | None:
        """See CarLink."""
        return self._mark

    @property
    def messages(self) -> BusMessages | None:
        """See CarLink."""
        with self._changed:
            return self._table.messages(self._clock())

    @property
    def refused(self) -> Refused:
        """See CarLink."""
        with self._changed:
            return Refused() if self._watch is None else self._watch.refused

    @property
    def problem(self) -> str:
        """See CarLink."""
        with self._changed:
            if self._watch is None:
                return _NOT_CONNECTED
            return self._trouble.problem or self._watch.problem

    def close(self) -> None:
        """See CarLink."""
        if self._handle is not None:
            self._handle.release()
        reader, self._reader = self._reader, None
        if reader is not None:
            reader.stop()
        self.log_to(None)

    def _send(self, message: can.Message) -> threading.Event:
        """Through the reader at hand; without one nothing is sent any more."""
        return threading.Event() if self._reader is None else self._reader.send(message)

    def frame(self, frame: CanFrame) -> None:
        """See FrameSink."""
        with self._changed:
            self._trouble.frame(frame)
            if self._watch is not None:
                self._watch.frame(frame)
                self._traffic.frame(frame, self._watch.is_lock_message)
                if self._log is not None:
                    self._log.frame(frame, self._watch.local_s)
            self._table.frame(frame)
            self.frames_received += 1
            self._changed.notify_all()

    def error_frame(self) -> None:
        """See FrameSink."""
        with self._changed:
            self._trouble.error_frame()
            if self._log is not None:
                self._log.error_frame()

    def frames_lost(self) -> None:
        """See FrameSink."""
        with self._changed:
            self._trouble.frames_lost()

    def fault(self, text: str) -> None:
        """See FrameSink."""
        with self._changed:
            self._trouble.fault = text
            self._changed.notify_all()

    def reopened(self) -> None:
        """See FrameSink."""
        with self._changed:
            if self._watch is not None:
                self._watch.restart()
            if self._log is not None:
                self._log.restart()
                self._restarts += 1
