"""The link to the Car: a CAN adapter behind python-can, and the lock events on the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import threading
import time
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence

import can

from mtr_operator.domain.assistance import ExtenderPort, HandlePort
from mtr_operator.domain.distance_feed import DistanceFeed
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.interfaces.car_bus import BusMonitor, BusRecorder, CarEquipment
from mtr_operator.domain.ports import BusMark, BusMessages, BusTraffic, CarEvent, CarLink, LockFacts, LockState
from mtr_operator.domain.results.refused import Refused
from mtr_operator.domain.results.session_record import CAN_ADAPTER, CAN_STAMPS
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.supervision.car_signals import CarSignals, first_active, unknown_unless_active

from .adapter import AdapterSettings, open_adapter
from .bus_trouble import BusTrouble
from .can_frame import CanFrame
from .catch_up import CatchUp
from .further.buses import FurtherBuses
from .further.cycles import CycleCheck
from .lock_watch import LockWatch
from .log.bus_log import BusLog
from .log.kept_log import KeptLog
from .message_table import MessageTable
from .outputs.outputs import Outputs
from .phone.car_signal import CarSignalFeed, feed_of
from .profile import CarProfile, load_profile
from .reader import CanReader, FrameSink
from .traffic import TrafficMeter

if TYPE_CHECKING:
    from .uds.poller import StatePoller

_NOT_CONNECTED = "The Car's CAN bus is not connected."


def _poller(profile: CarProfile, settings: AdapterSettings,
            send: Callable[[can.Message], threading.Event]) -> StatePoller | None:
    """Return the poller of the Car's state; None for a Car that sends it. ConnectionFailed on an adapter that only
    listens."""
    if profile.poll is None:
        return None
    if settings.is_listening:
        raise ConnectionFailed(f"The car profile {profile.name} asks the Car for its lock state (uds_poll), and the "
                               "CAN adapter only listens; choose normal mode (--can-normal) where the Car may be "
                               "asked, or a profile with a state that it sends.")
    from .uds.poller import StatePoller
    return StatePoller(profile.poll, send)


class CanCarLink(CarLink, BusMonitor, BusRecorder, CarEquipment, FrameSink):
    """Lock watch on the CAN bus; it sends nothing unless opened in normal mode.

    profile: name of a shipped car profile, or path of a YAML file. options: passed to python-can's driver. clock: the
    laptop's, monotonic, in s. is_listening, data_bitrate: see AdapterSettings. further: adapters of the further buses
    that the profile names. databases: see load_profile.

    Attributes:
        profile: the loaded car profile, None before connect().
        frames_received: data frames of any message since the start.
    """

    READER = CanReader

    def __init__(self, interface: str, channel: str, bitrate: int = 500_000, profile: str = "mtr_demo_car",
                 options: dict[str, Any] | None = None, *, clock: Callable[[], float] = time.monotonic,
                 is_listening: bool = True, data_bitrate: int | None = None,
                 further: Mapping[str, AdapterSettings] | None = None, databases: pathlib.Path | None = None):
        self._settings = AdapterSettings(interface, str(channel), bitrate, dict(options or {}), is_listening,
                                         data_bitrate)
        self._profile_name, self._databases, self._clock = str(profile), databases, clock
        self._watch: LockWatch | None = None
        self._reader: CanReader | None = None
        self._changed = threading.Condition()
        self._catch_up = CatchUp(self._changed)
        self._trouble = BusTrouble(self._settings)
        self._log = KeptLog()
        self._traffic = TrafficMeter(bitrate, data_bitrate)
        self._table = MessageTable()
        self._outputs: Outputs | None = None
        self._poller: StatePoller | None = None
        self._further = FurtherBuses(self._settings, dict(further or {}), clock)
        self._cycles = CycleCheck()
        self._phone: DistanceFeed | None = None
        self.profile: CarProfile | None = None
        self.frames_received = 0

    def connect(self) -> None:
        if self._reader is not None:
            return
        self.profile = profile = load_profile(self._profile_name, self._databases)
        self._poller = _poller(profile, self._settings, self._send)
        self._watch = LockWatch(profile)
        self._cycles = CycleCheck(profile)
        self._table = MessageTable(self.profile.message_names)
        self._phone = feed_of(profile.phone)
        reader = self.READER(lambda: open_adapter(self._settings), self, self._settings.interface, self._clock)
        reader.start()
        try:
            self._further.start(profile, self)
            if self._phone is not None:
                self._phone.connect()
        except ConnectionFailed:
            self._further.stop()
            reader.stop()
            raise
        self._reader = reader
        self._outputs = Outputs(profile, self._settings.is_listening, self._send, self._output_refusal)

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        arrival_s = self._clock()
        watch = self._watch
        if self._reader is None or watch is None:
            raise ConnectionFailed(_NOT_CONNECTED)
        with self._changed:
            watch.status(status, arrival_s)
            logged = self._log.frames
            self._catch_up.wait(lambda: bool(self._trouble.fault) or watch.has_caught_up(), status.waits_for_answer,
                                self._reader.settled)
            self._trouble.status(status.stamp_s)
            told_s = self._clock()
            self._log.status(logged, arrival_s, told_s, "" if watch.stamps is None else watch.stamps.name)
            return watch.release(told_s)

    @property
    def lock_state(self) -> LockState:
        with self._changed:
            return LockState.UNKNOWN if self._watch is None or self._trouble.problem else self._watch.lock_state

    @property
    def signals(self) -> CarSignals:
        with self._changed:
            if self._watch is None:
                return ()
            signals = self._watch.signals
            if self._trouble.problem or self._further.problem:
                signals = unknown_unless_active(signals)
            return signals

    @property
    def facts(self) -> LockFacts:
        return LockFacts() if self.profile is None else self.profile.facts

    @property
    def handle(self) -> HandlePort | None:
        """See CarEquipment: as declared by the profile."""
        return None if self._outputs is None else self._outputs.handle

    @property
    def extender(self) -> ExtenderPort | None:
        """See CarEquipment: as declared by the profile."""
        return None if self._outputs is None else self._outputs.extender

    @property
    def distance_feed(self) -> DistanceFeed | None:
        """See CarEquipment: as declared by the profile."""
        return self._phone

    @property
    def traffic(self) -> BusTraffic | None:
        with self._changed:
            if self.profile is None or self._watch is None:
                return None
            now = self._traffic.traffic(self._clock(), self.profile.cycle_time_s)
            stamps = self._watch.stamps
            return replace(now, clock_problem=self._watch.clock_problem, stamps="" if stamps is None else stamps.value)

    @property
    def record(self) -> Mapping[str, str]:
        stamps = None if self._watch is None else self._watch.stamps
        timed = {} if stamps is None else {CAN_STAMPS: stamps.text}
        return {CAN_ADAPTER: self._settings.text, **self._further.record, **timed}

    @property
    def notices(self) -> Sequence[str]:
        idle = () if self._outputs is None else self._outputs.notices
        with self._changed:
            watched = () if self._watch is None else self._watch.notices
            return (*idle, *self._cycles.notices, *watched)

    def log_to(self, path: pathlib.Path | None) -> None:
        log = None if path is None else BusLog(path, is_fd=self._settings.data_bitrate_bps is not None
                                               or self._further.is_fd)
        with self._changed:
            former = self._log.change(log)
        if former is not None:
            former.close()

    @property
    def log_problem(self) -> str:
        return self._log.problem

    @property
    def mark(self) -> BusMark | None:
        return self._log.mark

    @property
    def messages(self) -> BusMessages | None:
        with self._changed:
            return self._table.messages(self._clock())

    @property
    def refused(self) -> Refused:
        with self._changed:
            return Refused() if self._watch is None else self._watch.refused

    @property
    def problem(self) -> str:
        with self._changed:
            if self._watch is None:
                return _NOT_CONNECTED
            return self._trouble.problem or self._further.problem or self._watch.problem

    def close(self) -> None:
        if self._outputs is not None:
            self._outputs.close()
        reader, self._reader = self._reader, None
        if self._phone is not None:
            self._phone.close()
        self._further.stop()
        if reader is not None:
            reader.stop()
        self.log_to(None)

    def _output_refusal(self) -> str:
        active = first_active(self.signals)
        return "" if active is None else f"No output at the Car is switched. {active.sentence}"

    def _send(self, message: can.Message) -> threading.Event:
        """Send through the current reader; without one, discard the message."""
        return threading.Event() if self._reader is None else self._reader.send(message)

    def frame(self, frame: CanFrame) -> None:
        with self._changed:
            if isinstance(self._phone, CarSignalFeed):
                self._phone.frame(frame)
            if frame.bus:
                self._of_further_bus(frame)
                return
            self._trouble.frame(frame)
            if self._poller is not None:
                self._poller.frame(frame)
            if self._watch is not None:
                self._watch.frame(frame)
                self._cycles.frame(frame, self._watch.local_s)
                is_counted = self._watch.is_alive_message if self._watch.is_only_on_change else \
                    self._watch.is_lock_message
                self._traffic.frame(frame, is_counted)
                self._log.frame(frame, self._watch.local_s)
            self._table.frame(frame)
            self.frames_received += 1
            self._changed.notify_all()

    def _of_further_bus(self, frame: CanFrame) -> None:
        watch = self._watch
        self.frames_received += 1
        if watch is not None:
            watch.frame(frame)
            if watch.has_time:
                self._log.frame(frame, watch.local_s, self._further.channel(frame.bus))

    def tick(self, now_s: float) -> None:
        if self._poller is not None:
            with self._changed:
                self._poller.tick(now_s)

    def error_frame(self) -> None:
        with self._changed:
            self._trouble.error_frame()
            self._log.error_frame()

    def frames_lost(self) -> None:
        with self._changed:
            self._trouble.frames_lost()
            if self._watch is not None and self._watch.is_only_on_change:
                self._watch.forget_state()

    def fault(self, text: str) -> None:
        with self._changed:
            self._trouble.fault = text
            self._changed.notify_all()

    def answered(self) -> None:
        with self._changed:
            self._changed.notify_all()

    def reopened(self) -> None:
        if self._outputs is not None:
            self._outputs.reopened()
        with self._changed:
            if self._watch is not None:
                self._watch.restart()
            self._log.restart()
