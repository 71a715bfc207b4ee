"""State of an adapter's controller, driver by driver: bus-off, error-passive, frames lost by overrun.

A lasting fault is reported until it is over; errors and lost frames are counted at arrival. Drivers with a state query
are polled often enough to report within half a second.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Protocol

import can

from .slcan import FLAG_BUS_ERROR, FLAG_ERROR_PASSIVE, StampedSlcanBus

# With one more pass of the reader, a fault is reported within half a second.
LOOK_PERIOD_S = 0.2
BUS_OFF = ("The CAN adapter reports errors on the bus or has left it (bus-off); check bit rate, plug and "
           "termination.")
REFUSES = ("The CAN adapter does not take the order to listen only (L of slcan), and stays closed; use another adapter "
           "or firmware, or choose normal mode (--can-normal) for a bench of one node.")
PASSIVE = "The CAN adapter is error-passive; check bit rate, plug and termination."
# Status bits of PCAN-Basic, from python-can's can.interfaces.pcan.basic.
_PCAN_OVERRUN, _PCAN_BUS_OFF, _PCAN_QUEUE_OVERRUN, _PCAN_PASSIVE = 0x02, 0x10, 0x40, 0x40000
# Linux' include/uapi/linux/can/error.h: classes in the identifier, the controller's state in the second byte.
_KERNEL_CONTROLLER, _KERNEL_BUS_OFF, _KERNEL_RESTARTED = 0x004, 0x040, 0x100
_KERNEL_RECEIVE_OVERFLOW, _KERNEL_PASSIVE, _KERNEL_ACTIVE = 0x01, 0x30, 0x40


class HealthSink(Protocol):
    """Receiver of the reports; see FrameSink."""

    def error_frame(self) -> None:
        """Report an error frame on the bus."""

    def frames_lost(self) -> None:
        """Report that frames were lost before they could be read."""

    def fault(self, text: str) -> None:
        """Report a lasting fault; an empty text ends it."""


class _State(NamedTuple):
    fault: str = ""
    overruns: int = 0


class AdapterHealth:
    """State of one adapter since it was opened. interface: python-can's name."""

    def __init__(self, interface: str, sink: HealthSink):
        self._look: Callable[[Any], _State | None] = _LOOKS.get(interface, lambda: _plain)()
        self._is_kernels = interface == "socketcan"
        self._sink = sink
        self._looked_s: float | None = None
        self._overruns: int | None = None
        self._fault = ""

    def frame(self) -> None:
        """Record a frame: a controller that was bus-off has recovered."""
        if self._is_kernels:
            self._say("")

    def error_frame(self, message: can.Message) -> None:
        """Record an error frame of the driver."""
        if not self._is_kernels or not self._controller(message.arbitration_id, bytes(message.data)):
            self._sink.error_frame()

    def look(self, bus: can.BusABC, now_s: float) -> None:
        """Query the driver, if it supports queries and the period has passed."""
        if self._looked_s is None or now_s - self._looked_s >= LOOK_PERIOD_S:
            self._looked_s = now_s
            self._take(self._look(bus))

    def _take(self, state: _State | None) -> None:
        if state is None:
            return
        if self._overruns is not None and state.overruns > self._overruns:
            self._sink.frames_lost()
        self._overruns = state.overruns
        self._say(state.fault)

    def _controller(self, classes: int, data: bytes) -> bool:
        """Return True if an error frame of the kernel reports only the controller's state."""
        state = data[1] if classes & _KERNEL_CONTROLLER and len(data) > 1 else 0
        if state & _KERNEL_RECEIVE_OVERFLOW:
            self._sink.frames_lost()
        if classes & _KERNEL_BUS_OFF:
            self._say(BUS_OFF)
        elif state & _KERNEL_PASSIVE:
            self._say(PASSIVE)
        elif classes & _KERNEL_RESTARTED or state & _KERNEL_ACTIVE:
            self._say("")
        return bool(classes & (_KERNEL_BUS_OFF | _KERNEL_RESTARTED)) or bool(state)

    def _say(self, fault: str) -> None:
        if fault != self._fault:
            self._fault = fault
            self._sink.fault(fault)


def _slcan(bus: Any) -> _State | None:
    if not isinstance(bus, StampedSlcanBus):
        return None
    bus.request_flags()
    if bus.refuses:
        return _State(REFUSES, bus.overruns)
    flags = bus.flags
    return _State(BUS_OFF if flags & FLAG_BUS_ERROR else PASSIVE if flags & FLAG_ERROR_PASSIVE else "", bus.overruns)


class _PcanCounter:
    """Overrun detector: PCAN-Basic reports an overrun as a state that the next reading clears; this class counts it."""

    def __init__(self) -> None:
        self._count = 0

    def __call__(self, bus: Any) -> _State:
        status = int(bus.status())
        self._count += bool(status & (_PCAN_OVERRUN | _PCAN_QUEUE_OVERRUN))
        return _State(BUS_OFF if status & _PCAN_BUS_OFF else PASSIVE if status & _PCAN_PASSIVE else "", self._count)


def _kvaser(bus: Any) -> _State:
    return _State(_of_state(bus), int(bus.get_stats().overruns))


def _plain(bus: Any) -> _State:
    return _State(_of_state(bus))


def _of_state(bus: Any) -> str:
    return BUS_OFF if getattr(bus, "state", None) is can.BusState.ERROR else ""


def _no_look(_: Any) -> None:
    """Return no state: the kernel reports its interface's state by error frames."""


# Query of a bus by interface; one instance for each adapter.
_LOOKS: dict[str, Callable[[], Callable[[Any], _State | None]]] = {
    "slcan": lambda: _slcan, "pcan": _PcanCounter, "kvaser": lambda: _kvaser, "socketcan": lambda: _no_look}
