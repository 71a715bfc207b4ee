"""Thread that reads the CAN adapter, stamps each frame, and reopens the adapter after a loss."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import queue
import threading
import time
from abc import ABC, abstractmethod
from typing import Callable

import can

from mtr_operator.domain.errors import ConnectionFailed

from .adapter import shut_down
from .can_frame import CanFrame
from .clocks.frame_stamps import frame_time
from .drivers.health import AdapterHealth
from .drivers.slcan import StampedSlcanBus

_POLL_S = 0.1
_REOPEN_PERIOD_S = 1.0


class FrameSink(ABC):
    """Receiver of the reader's reports; called from its thread."""

    @abstractmethod
    def frame(self, frame: CanFrame) -> None:
        """Receive a data frame."""

    @abstractmethod
    def error_frame(self) -> None:
        """Report an error frame of the adapter."""

    @abstractmethod
    def frames_lost(self) -> None:
        """Report frames that were lost before they could be read."""

    @abstractmethod
    def fault(self, text: str) -> None:
        """Report the current fault of adapter or controller; empty without one."""

    @abstractmethod
    def reopened(self) -> None:
        """Report that the adapter was reopened."""

    def answered(self) -> None:  # noqa: B027, most have asked nothing
        """Report that the adapter answered a request of settled()."""

    def tick(self, now_s: float) -> None:  # noqa: B027, most have nothing to do
        """Advance the time, by the laptop's monotonic clock; called ten times a second and with each frame."""


class CanReader:
    """Owner of the bus between start() and stop().

    interface: python-can's name, which determines the stamps of the frames. clock: the laptop's, monotonic, in s.
    """

    def __init__(self, open_bus: Callable[[], can.BusABC], sink: FrameSink, interface: str = "",
                 clock: Callable[[], float] = time.monotonic):
        self._open_bus = open_bus
        self._sink = sink
        self._interface = interface
        self._clock = clock
        self._bus: can.BusABC | None = None
        self._stopping = threading.Event()
        self._outgoing: queue.SimpleQueue[tuple[can.Message, threading.Event]] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None
        self._health = AdapterHealth(interface, sink)

    def start(self) -> None:
        """Open the adapter, or raise ConnectionFailed; then read in a thread."""
        self._bus = self._opened()
        self._thread = threading.Thread(target=self._run, name="can-reader", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop the thread and close the adapter."""
        self._stopping.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None
        if self._bus is not None:
            shut_down(self._bus)
            self._bus = None

    def send(self, message: can.Message) -> threading.Event:
        """Queue a frame for the thread; the event is set when it has left, and never if the adapter fails."""
        left = threading.Event()
        self._outgoing.put((message, left))
        return left

    def settled(self) -> Callable[[], bool] | None:
        """Request a marker behind all previous frames; return a predicate that is true when they have been read. None
        if the adapter has no such marker, or is missing."""
        bus = self._bus
        if not isinstance(bus, StampedSlcanBus):
            return None
        # The thread handles a lost adapter.
        with contextlib.suppress(Exception):
            number = bus.request_flags()
            return lambda: bus.flags_answered >= number
        return None

    def _run(self) -> None:
        while not self._stopping.is_set():
            bus = self._bus
            if bus is None:
                self._reopen()
                continue
            try:
                self._read(bus)
            # Drivers raise any exception of their vendor's library.
            except Exception as error:
                self._sink.fault(f"The CAN adapter has failed: {' '.join(str(error).split())}.")
                shut_down(bus)
                self._bus = None
        # The last frames may deactivate outputs, so they are still sent; the adapter may be lost.
        with contextlib.suppress(Exception):
            self._send_all()

    def _opened(self) -> can.BusABC:
        bus = self._open_bus()
        if isinstance(bus, StampedSlcanBus):
            bus.answered = self._sink.answered
        return bus

    def _send_all(self) -> None:
        """Send the queue; without an adapter discard it, because it would be sent too late."""
        while not self._outgoing.empty():
            message, left = self._outgoing.get()
            if self._bus is not None:
                self._bus.send(message)
                left.set()

    def _read(self, bus: can.BusABC) -> None:
        self._sink.tick(self._clock())
        self._send_all()
        message = bus.recv(_POLL_S)
        now = self._clock()
        if message is not None and message.is_error_frame:
            self._health.error_frame(message)
        elif message is not None and not message.is_remote_frame:
            self._health.frame()
            self._sink.frame(self._frame(bus, message, now))
        self._health.look(bus, now)

    def _frame(self, bus: can.BusABC, message: can.Message, now_s: float) -> CanFrame:
        arrival_s, stamp_s, kind = frame_time(self._interface, message, now_s)
        stamp_ms = getattr(bus, "stamp_ms", None)
        return CanFrame(message.arbitration_id, message.is_extended_id, bytes(message.data), arrival_s, stamp_ms,
                        stamp_s, kind if stamp_ms is None else None, message.is_fd)

    def _reopen(self) -> None:
        self._send_all()
        if self._stopping.wait(_REOPEN_PERIOD_S):
            return
        try:
            bus = self._opened()
        except ConnectionFailed as error:
            self._sink.fault(str(error))
            return
        # For example, a terminal may vanish while it is opened. Without this thread, no further frame would be
        # received.
        except Exception as error:
            self._sink.fault(f"The CAN adapter has failed: {' '.join(str(error).split())}.")
            return
        # Frames that were queued while the adapter was being opened would be sent too late as well.
        self._send_all()
        self._bus = bus
        self._health = AdapterHealth(self._interface, self._sink)
        self._sink.reopened()
        self._sink.fault("")
