"""Further buses of the Car: an adapter each, that only gives its frames."""
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
    """Owns the adapters between start() and stop(). first: of the bus that tells the state. settings: by the name of
    the bus."""

    def __init__(self, first: AdapterSettings, settings: Mapping[str, AdapterSettings], clock: Callable[[], float]):
        self._first, self._settings = first, settings
        self._clock = clock
        self._open: dict[str, tuple[CanReader, _Bus]] = {}
        self._names: tuple[str, ...] = ()

    def start(self, profile: CarProfile, sink: FrameSink) -> None:
        """Open an adapter for each bus that the profile names; BusRefused names the one for which that fails."""
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
        """Interface and channel of each adapter that is open."""
        used = (self._first, *(self._settings[name] for name in self._open))
        return {(settings.interface, settings.channel) for settings in used}

    @property
    def is_fd(self) -> bool:
        """True when one of them may carry CAN FD frames."""
        return any(self._settings[name].data_bitrate_bps is not None for name in self._open)

    @property
    def record(self) -> dict[str, str]:
        """How the adapter of each bus is opened, for the record of a test."""
        return {CAN_ADAPTER_OF_BUS.format(name): self._settings[name].text for name in self._open}

    def channel(self, name: str) -> int:
        """Of a bus in a log; 0 is that of the state."""
        return 1 + self._names.index(name)

    @property
    def problem(self) -> str:
        """What is wrong with one of them; empty when nothing is."""
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
        """See FrameSink: one alone takes nothing from what is told beside the state."""

    def frames_lost(self) -> None:
        """See FrameSink: a cause that is missing is told with the change."""

    def fault(self, text: str) -> None:
        self.problem = f"Further bus {self._name}: {text}" if text else ""

    def reopened(self) -> None:
        pass
