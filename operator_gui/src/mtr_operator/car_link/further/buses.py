"""Further buses of the Car, with one adapter each, used only for their frames."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Callable, Mapping

from mtr_operator.domain.errors import BusRefused, ConnectionFailed
from mtr_operator.domain.results.session_record import CAN_ADAPTER_OF_BUS

from ..adapter import AdapterSettings, open_adapter
from ..can_frame import CanFrame
from ..reader import CanReader, FrameSink

if TYPE_CHECKING:
    from ..profile import CarProfile


class FurtherBuses:
    """Owner of the adapters between start() and stop(). first: of the bus of the state. settings: by the name of the
    bus."""

    def __init__(self, first: AdapterSettings, settings: Mapping[str, AdapterSettings], clock: Callable[[], float]):
        self._first, self._settings = first, settings
        self._clock = clock
        self._open: dict[str, tuple[CanReader, _Bus]] = {}
        self._names: tuple[str, ...] = ()

    def start(self, profile: CarProfile, sink: FrameSink) -> None:
        """Open an adapter for each bus that the profile names; BusRefused names the bus whose adapter cannot be
        opened."""
        self._names = profile.further.buses
        try:
            for name in self._names:
                self._start(name, sink)
        except ConnectionFailed:
            self.stop()
            raise

    def _start(self, name: str, sink: FrameSink) -> None:
        settings = self._settings.get(name)
        if settings is None:
            raise BusRefused(f"The car profile needs the bus {name}, too; name its adapter "
                             f"(--can-bus {name}=INTERFACE:CHANNEL:BITRATE).", name)
        if (settings.interface, settings.channel) in self._taken():
            raise BusRefused(f"Further bus {name}: The {settings} is that of another bus already; give each bus an "
                             "adapter of its own.", name)
        bus = _Bus(name, sink)
        reader = CanReader(lambda: open_adapter(settings), bus, settings.interface, self._clock)
        try:
            reader.start()
        except ConnectionFailed as error:
            raise BusRefused(f"Further bus {name}: {error}", name) from None
        self._open[name] = reader, bus

    def _taken(self) -> set[tuple[str, str]]:
        """Return interface and channel of each open adapter."""
        used = (self._first, *(self._settings[name] for name in self._open))
        return {(settings.interface, settings.channel) for settings in used}

    @property
    def is_fd(self) -> bool:
        """True if one of the adapters may carry CAN FD frames."""
        return any(self._settings[name].data_bitrate_bps is not None for name in self._open)

    @property
    def record(self) -> dict[str, str]:
        """Settings of each bus' adapter, for the record of a test."""
        return {CAN_ADAPTER_OF_BUS.format(name): self._settings[name].text for name in self._open}

    def channel(self, name: str) -> int:
        """Return the channel of a bus in a log; 0 is the bus of the state."""
        return 1 + self._names.index(name)

    @property
    def problem(self) -> str:
        """Fault of one of the adapters; empty without one."""
        return next((bus.problem for _, bus in self._open.values() if bus.problem), "")

    def stop(self) -> None:
        """Close the adapters."""
        while self._open:
            _, (reader, _) = self._open.popitem()
            reader.stop()


class _Bus(FrameSink):
    """Marks frames with the name of their bus."""

    def __init__(self, name: str, sink: FrameSink):
        self.problem = ""
        self._name = name
        self._sink = sink

    def frame(self, frame: CanFrame) -> None:
        self._sink.frame(replace(frame, bus=self._name))

    def error_frame(self) -> None:
        """See FrameSink: a single error frame does not invalidate the further signals."""

    def frames_lost(self) -> None:
        """See FrameSink: a missing cause is reported with the change."""

    def fault(self, text: str) -> None:
        self.problem = f"Further bus {self._name}: {text}" if text else ""

    def reopened(self) -> None:
        pass
