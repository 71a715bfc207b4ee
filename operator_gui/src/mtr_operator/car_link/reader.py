"""Thread that reads the CAN adapter, stamps each frame, and opens the adapter again when it has gone."""
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
    """Takes what the reader sees; called from its thread."""

    @abstractmethod
    def frame(self, frame: CanFrame) -> None:
        """A data frame."""

    @abstractmethod
    def error_frame(self) -> None:
        """The adapter reports an error on the bus."""

    @abstractmethod
    def frames_lost(self) -> None:
        """The adapter reports frames that were lost before they could be read."""

    @abstractmethod
    def fault(self, text: str) -> None:
        """What is wrong with adapter or controller now; empty when nothing is."""

    @abstractmethod
    def reopened(self) -> None:
        """The adapter was opened again."""

    def answered(self) -> None:  # noqa: B027, most have asked nothing
        """The adapter has said the word for which it was asked."""

    def tick(self, now_s: float) -> None:  # noqa: B027, most have nothing to do
        """Time has passed, by the laptop's monotonic clock; ten times a second and with each frame."""


class CanReader:
    """Owns the bus between start() and stop().

    interface: python-can's word, which tells how frames are stamped. clock: the laptop's, monotonic, in s.
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
        """End the thread and close the adapter."""
        self._stopping.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None
        if self._bus is not None:
            shut_down(self._bus)
            self._bus = None

    def send(self, message: can.Message) -> threading.Event:
        """Have a frame sent by the thread; the event is set when it has left, and never when the adapter fails."""
        left = threading.Event()
        self._outgoing.put((message, left))
        return left

    def settled(self) -> Callable[[], bool] | None:
        """Have the adapter say a word behind all frames of before; what is given tells whether they have been read.
        None: this one has no such word, or is not there."""
        bus = self._bus
        if not isinstance(bus, StampedSlcanBus):
            return None
        # An adapter that has gone is the thread's business.
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
            # Drivers raise whatever their vendor's library does.
            except Exception as error:
                self._sink.fault(f"The CAN adapter has failed: {' '.join(str(error).split())}.")
                shut_down(bus)
                self._bus = None
        # What is let go with the last order shall not stay taken; the adapter may have gone.
        with contextlib.suppress(Exception):
            self._send_all()

    def _opened(self) -> can.BusABC:
        bus = self._open_bus()
        if isinstance(bus, StampedSlcanBus):
            bus.answered = self._sink.answered
        return bus

    def _send_all(self) -> None:
        """What waits; nothing of it when there is no adapter, for it would come too late."""
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
        # Of a terminal that goes while it is opened, for one; without this thread nobody would notice the next frame.
        except Exception as error:
            self._sink.fault(f"The CAN adapter has failed: {' '.join(str(error).split())}.")
            return
        # What was asked for while the adapter was being opened would come too late, as well.
        self._send_all()
        self._bus = bus
        self._health = AdapterHealth(self._interface, self._sink)
        self._sink.reopened()
        self._sink.fault("")
