"""Opens CAN adapters through python-can; every fault is reported as a sentence."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import errno
import logging
import os
import re
import stat
import time
from dataclasses import dataclass, field
from typing import Any

import can

from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter

from .drivers import ixxat
from .drivers.kernel_link import check_link
from .drivers.options import IXXAT, SLCAN, SOCKETCAN, Unsupported, fd_options, listening_options, rate_of, takes_part
from .drivers.slcan import StampedSlcanBus

_MIN_BITRATE = 10_000
_MAX_BITRATE = 1_000_000
# ISO 11898-2 transceivers for CAN FD with signal improvement.
_MAX_DATA_BITRATE = 8_000_000
# Time in which an slcan adapter answers the commands that open it.
_ANSWER_LIMIT_S = 1.0
_POLL_S = 0.05
_SYSTEM_ERROR = re.compile(r"\(\d+, ['\"]([^'\"]*)['\"]\)")

# Exceptions carry the same texts as the drivers' log, which adds hints for programmers.
logging.getLogger("can").addHandler(logging.NullHandler())


@dataclass(frozen=True)
class AdapterSettings:
    """Adapter of the Car's CAN bus. options are passed to python-can's driver unchanged.

    is_listening: it sends nothing, not even an acknowledge. data_bitrate_bps: of CAN FD frames, None for classic CAN.
    """

    interface: str
    channel: str
    bitrate_bps: int = 500_000
    options: dict[str, Any] = field(default_factory=dict)
    is_listening: bool = True
    data_bitrate_bps: int | None = None

    def __post_init__(self) -> None:
        known = sorted(can.VALID_INTERFACES)
        if self.interface not in known:
            raise InvalidParameter(f"CAN interface is {self.interface!r}; allowed are {', '.join(known)}.")
        if not str(self.channel):
            raise InvalidParameter("CAN channel is empty; give the adapter's port, e.g. /dev/ttyACM0, can0 or "
                                   "PCAN_USBBUS1.")
        if isinstance(self.bitrate_bps, bool) or not isinstance(self.bitrate_bps, int) \
                or not _MIN_BITRATE <= self.bitrate_bps <= _MAX_BITRATE:
            raise InvalidParameter(f"CAN bit rate is {self.bitrate_bps}; allowed is {_MIN_BITRATE} to "
                                   f"{_MAX_BITRATE} bit/s.")
        data_bps = self.data_bitrate_bps
        if data_bps is not None and not (type(data_bps) is int and self.bitrate_bps <= data_bps <= _MAX_DATA_BITRATE):
            raise InvalidParameter(f"CAN FD data bit rate is {data_bps}; allowed is {self.bitrate_bps}, the bit rate, "
                                   f"to {_MAX_DATA_BITRATE} bit/s.")

    @property
    def text(self) -> str:
        """Description of the opened adapter, as in the record of a test."""
        fd = "" if self.data_bitrate_bps is None else f", CAN FD with {self.data_bitrate_bps} bit/s"
        mode = "listens only" if self.is_listening else "takes part in the bus (normal mode)"
        return f"{self.interface} {self.channel}, {self.bitrate_bps} bit/s{fd}, {mode}"

    def __str__(self) -> str:
        return f"CAN adapter {self.channel} ({self.interface})"


def open_adapter(settings: AdapterSettings) -> can.BusABC:
    """Open the adapter, or raise ConnectionFailed."""
    if settings.interface == SLCAN and settings.channel.startswith("/"):
        _check_device(settings.channel)
    if settings.interface == SOCKETCAN:
        check_link(settings.channel, settings.bitrate_bps, settings.data_bitrate_bps, settings.is_listening)
    try:
        options = {**_driver_options(settings), **settings.options}
        if settings.interface != SLCAN:
            return _listening(_open(settings, options), settings)
        bus = StampedSlcanBus(settings.channel, bitrate=settings.bitrate_bps, **options)
    except Unsupported as error:
        raise ConnectionFailed(str(error)) from None
    except ConnectionFailed:
        raise
    # Drivers raise any exception of their vendor's library.
    except Exception as error:
        if settings.interface == SLCAN and os.strerror(errno.ENOTTY) in str(error):
            raise _no_serial_port(settings.channel) from None
        raise ConnectionFailed(f"Cannot open the {settings} at {settings.bitrate_bps} bit/s: {_one_line(error)}.") \
            from None
    try:
        _wait_for_answer(bus, settings)
    except BaseException:
        shut_down(bus)
        raise
    return bus


def _open(settings: AdapterSettings, options: dict[str, Any]) -> can.BusABC:
    rate_bps = settings.bitrate_bps
    if settings.data_bitrate_bps is None:
        rate_bps = rate_of(settings.interface, rate_bps)
    is_ordered = settings.interface == IXXAT and settings.is_listening
    with ixxat.ordered_to_listen() if is_ordered else contextlib.nullcontext():
        return can.Bus(interface=settings.interface, channel=settings.channel, bitrate=rate_bps, **options)


def _driver_options(settings: AdapterSettings) -> dict[str, Any]:
    options = listening_options(settings.interface) if settings.is_listening else {}
    if settings.interface == IXXAT:
        options.update(ixxat.ROOM)
    if settings.data_bitrate_bps is not None:
        options.update(fd_options(settings.interface, settings.bitrate_bps, settings.data_bitrate_bps))
    return options


def _listening(bus: can.BusABC, settings: AdapterSettings) -> can.BusABC:
    """Return the adapter; close it and raise if it is not in the ordered listen-only mode."""
    is_ixxat = settings.interface == IXXAT
    if settings.is_listening and (ixxat.takes_part(bus) if is_ixxat else takes_part(settings.interface, bus)):
        shut_down(bus)
        raise ConnectionFailed(f"The {settings} does not take the order to listen only; end other programs that use "
                               "it, take another adapter, or choose normal mode (--can-normal) for a bench of one "
                               "node.")
    return bus


def shut_down(bus: can.BusABC) -> None:
    """Close the adapter, even if it was unplugged."""
    try:
        bus.shutdown()
    # The adapter may be unplugged.
    except Exception:
        serial_port = getattr(bus, "serialPortOrig", None)
        if serial_port is not None:
            serial_port.close()


def _check_device(path: str) -> None:
    if not os.path.exists(path):
        raise ConnectionFailed(f"There is no CAN adapter at {path}; check the channel and the USB plug.")
    if not stat.S_ISCHR(os.stat(path).st_mode):
        raise _no_serial_port(path)


def _no_serial_port(path: str) -> ConnectionFailed:
    return ConnectionFailed(f"{path} is no serial port; give the CAN adapter's, e.g. /dev/ttyACM0.")


def _one_line(error: Exception) -> str:
    # pyserial shows the argument tuple of the system's error.
    text = _SYSTEM_ERROR.sub(r"\1", str(error))
    return " ".join(text.split()).rstrip(".")


def _wait_for_answer(bus: StampedSlcanBus, settings: AdapterSettings) -> None:
    deadline = time.monotonic() + _ANSWER_LIMIT_S
    try:
        while not bus.answers and time.monotonic() < deadline:
            bus.recv(_POLL_S)
    except (can.CanError, OSError) as error:
        raise ConnectionFailed(f"The {settings} has gone: {error}.") from None
    if not bus.answers:
        reason = "sends something else than the slcan protocol" if bus.malformed else "does not answer"
        raise ConnectionFailed(f"The {settings} {reason}; check the channel, and that the device is a CAN adapter.")
