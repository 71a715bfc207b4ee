"""Device side of the serial-line CAN protocol (Lawicel CAN232 manual, version 3), as in USB adapters.

The module only processes bytes: no device, no clock.
"""
# SPDX-License-Identifier: Apache-2.0
import collections
from typing import Callable, Deque, Dict, NamedTuple

from .can_port import SentFrame

OK = b"\r"
ERROR = b"\a"
VERSION = b"V1013"
SERIAL_NUMBER = b"NMTR1"

# Bits of the answer to F.
STATUS_ERROR_WARNING = 0x04
STATUS_DATA_OVERRUN = 0x08
STATUS_ERROR_PASSIVE = 0x20
STATUS_BUS_ERROR = 0x80
STATUS_BUS_OFF = STATUS_ERROR_WARNING | STATUS_ERROR_PASSIVE | STATUS_BUS_ERROR

_BITRATES = b"012345678"
# The stamp counts milliseconds and restarts every minute.
_STAMP_MODULO_MS = 60_000
# Largest number of received frames that nothing has read.
_MAX_SENT = 64
_MAX_LINE = len("Tiiiiiiiildddddddddddddddd")


class _Shape(NamedTuple):
    """Format of a frame command: digits of the identifier, highest identifier, whether data follow, answer."""

    id_digits: int
    highest_id: int
    has_data: bool
    answer: bytes


_FRAMES: Dict[bytes, _Shape] = {
    b"t": _Shape(3, 0x7FF, True, b"z"),
    b"T": _Shape(8, 0x1FFFFFFF, True, b"Z"),
    b"r": _Shape(3, 0x7FF, False, b"z"),
    b"R": _Shape(8, 0x1FFFFFFF, False, b"Z"),
}


class SlcanAdapter:
    """State of an adapter and its answers to the host.

    Attributes:
        is_open: the host receives frames.
        stamps: frames carry a time stamp; unchanged by closing and opening.
        bus_off: the controller has left the bus: no frames in either direction, and F reports it.
        overrun: a frame was lost because a buffer was full; the next F reports it once.
        transmitted: number of frames that the host sent to the bus.
        sent: the newest of them with data, until they are read.
    """

    def __init__(self) -> None:
        self.is_open = False
        self.stamps = False
        self.bus_off = False
        self.overrun = False
        self.transmitted = 0
        self.sent: Deque[SentFrame] = collections.deque(maxlen=_MAX_SENT)
        self._configured = False
        self._listen_only = False
        self._line = bytearray()
        self._commands: Dict[bytes, Callable[[bytes], bytes]] = {
            b"S": self._set_bitrate,
            b"s": self._set_timing_registers,
            b"O": self._open,
            b"L": self._open_listen_only,
            b"C": self._close,
            b"Z": self._set_stamps,
            b"F": self._status,
            b"V": lambda argument: ERROR if argument else VERSION + OK,
            b"N": lambda argument: ERROR if argument else SERIAL_NUMBER + OK,
        }

    def receive(self, data: bytes) -> bytes:
        """Process bytes from the host; return the answers to the completed lines."""
        answers = bytearray()
        for byte in data:
            if byte != OK[0]:
                # Only one byte beyond the longest line is stored, which makes the line invalid.
                self._line.extend((byte,) if len(self._line) <= _MAX_LINE else ())
                continue
            line = bytes(self._line)
            self._line.clear()
            answers += self._answer(line)
        return bytes(answers)

    def encode(self, can_id: int, data: bytes, time_ns: int) -> bytes:
        """Return the line with a received data frame for the host; identifiers above 0x7FF are extended."""
        head = f"t{can_id:03X}" if can_id <= 0x7FF else f"T{can_id:08X}"
        stamp = f"{time_ns // 1_000_000 % _STAMP_MODULO_MS:04X}" if self.stamps else ""
        return f"{head}{len(data)}{data.hex().upper()}{stamp}\r".encode()

    def _answer(self, line: bytes) -> bytes:
        if not line:
            return OK
        if line[:1] in _FRAMES:
            return self._transmit(_FRAMES[line[:1]], line[1:])
        command = self._commands.get(line[:1])
        return command(line[1:]) if command else ERROR

    def _set_bitrate(self, argument: bytes) -> bytes:
        return self._configure(len(argument) == 1 and argument in _BITRATES)

    def _set_timing_registers(self, argument: bytes) -> bytes:
        return self._configure(len(argument) == 4 and _is_hex(argument))

    def _configure(self, valid: bool) -> bytes:
        if self.is_open or not valid:
            return ERROR
        self._configured = True
        return OK

    def _open(self, argument: bytes, listen_only: bool = False) -> bytes:
        if argument or self.is_open or not self._configured:
            return ERROR
        self.is_open, self._listen_only = True, listen_only
        return OK

    def _open_listen_only(self, argument: bytes) -> bytes:
        return self._open(argument, listen_only=True)

    def _close(self, argument: bytes) -> bytes:
        if argument or not self.is_open:
            return ERROR
        self.is_open = False
        return OK

    def _set_stamps(self, argument: bytes) -> bytes:
        if self.is_open or argument not in (b"0", b"1"):
            return ERROR
        self.stamps = argument == b"1"
        return OK

    def _status(self, argument: bytes) -> bytes:
        if argument or not self.is_open:
            return ERROR
        flags = (STATUS_BUS_OFF if self.bus_off else 0) | (STATUS_DATA_OVERRUN if self.overrun else 0)
        self.overrun = False
        return b"F%02X\r" % flags

    def _transmit(self, shape: _Shape, argument: bytes) -> bytes:
        if not self.is_open or self._listen_only or self.bus_off or not _is_frame(shape, argument):
            return ERROR
        self.transmitted += 1
        if shape.has_data:
            digits = shape.id_digits
            self.sent.append(SentFrame(int(argument[:digits], 16), bytes.fromhex(argument[digits + 1 :].decode())))
        return shape.answer + OK


def _is_hex(text: bytes) -> bool:
    return all(byte in b"0123456789ABCDEFabcdef" for byte in text)


def _is_frame(shape: _Shape, argument: bytes) -> bool:
    head = shape.id_digits + 1
    if len(argument) < head or not _is_hex(argument) or argument[head - 1 : head] not in b"012345678":
        return False
    length = int(argument[head - 1 : head]) if shape.has_data else 0
    return int(argument[: head - 1], 16) <= shape.highest_id and len(argument) == head + 2 * length
