"""Serial-line CAN adapters (slcan) with the time stamps that python-can's own driver does not read.

With Z1 such an adapter adds four hexadecimal digits to each frame: milliseconds that restart each minute (Lawicel
CAN232 manual). The driver also reads byte by byte; at the frame rates of an accelerated simulation that costs a
processor core, so this class reads whole blocks.

Listen-only mode is `L` by that manual. The firmware of the CANable (canable-fw, and cantact-fw before it) lacks `L`,
answers only V, and listens if M1 preceded O. An adapter by the manual rejects M1, because its M sets a filter of eight
digits.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
import threading
import time
from typing import Any, Callable

import can
import serial
from can.exceptions import error_check
from can.interfaces.slcan import slcanBus

# Answer of the CANable to V: its version and the address of its source.
_CANABLE = re.compile(r"can(able|tact)", re.IGNORECASE)
_LINE_END = re.compile(rb"[\r\a]")
# int() would also accept signs, spaces and underscores as digits.
_DIGITS = re.compile(r"[0-9A-Fa-f]*")
_REFUSED = "\a"
_MAX_LINE = 512
_SERIAL_TIMEOUT_S = 0.05
_MAX_CLASSIC_DATA = 8
# Data bytes by the length code of a CAN FD frame, ISO 11898-1.
_FD_LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)
_STAMP_DIGITS = 4
_STAMP_LIMIT_MS = 60_000
# Characters before the data, for each kind of frame line.
_HEAD = {"t": 5, "r": 5, "T": 10, "R": 10, "d": 5, "D": 10, "b": 5, "B": 10}
_STANDARD_HEAD, _STANDARD_BITS, _EXTENDED_BITS = 5, 11, 29
_WITH_DATA, _FD = "tTdDbB", "dDbB"

# Bits of the answer to F; it clears the first two.
FLAG_RECEIVE_FULL = 0x01
FLAG_DATA_OVERRUN = 0x08
FLAG_ERROR_PASSIVE = 0x20
FLAG_BUS_ERROR = 0x80


class StampedSlcanBus(slcanBus):
    """slcan adapter.

    Attributes:
        stamp_ms: adapter's stamp of the frame that recv returned last, None without one.
        flags: newest answer to request_flags(), 0 before the first.
        flags_answered: number of these answers. answered: called at each, in the reading thread.
        overruns: answers that reported lost frames.
        answers: valid slcan lines; malformed: invalid lines.
        refuses: the adapter does not accept listen-only mode.
    """

    def __init__(self, channel: str, data_bitrate: int | None = None, **options: Any):
        """data_bitrate: in bit/s, for adapters with CAN FD."""
        self._data_bitrate = data_bitrate
        self.stamp_ms: int | None = None
        self.flags = self.overruns = self.flags_answered = 0
        self.answered: Callable[[], None] = lambda: None
        self._flags_asked, self._asking = 0, threading.Lock()
        self.answers = 0
        self.malformed = 0
        self.refuses = False
        # Result of the previous command: None without an answer.
        self._is_refused: bool | None = None
        super().__init__(channel, timeout=_SERIAL_TIMEOUT_S, **{"sleep_after_open": 0.0, **options})

    def set_bitrate(self, bitrate: int, data_bitrate: int | None = None) -> None:
        """Set the bit rate, the driver's first command; raise an error if another program uses the adapter."""
        try:
            self.serialPortOrig.exclusive = True
        except serial.SerialException:
            raise can.CanInitializationError("another program uses it") from None
        super().set_bitrate(bitrate, data_bitrate or self._data_bitrate)

    def open(self) -> None:
        """Open the channel with time stamps; an adapter without them rejects Z1 and opens all the same."""
        self.close()
        self._write("Z1")
        # The mode persists over closing and opening.
        self._write("M1" if self._listen_only else "M0")
        super().open()
        self._write("V")

    def request_flags(self) -> int:
        """Request the controller's state, from any thread; the answer follows all previous frames. Return the number of
        answers at which this request is answered."""
        with self._asking:
            self._flags_asked += 1
            self._write("F")
            return self._flags_asked

    def _read(self, timeout: float | None) -> str | None:
        deadline = None if timeout is None else time.monotonic() + timeout
        while True:
            end = _LINE_END.search(self._buffer)
            if end:
                line = bytes(self._buffer[:end.end()])
                del self._buffer[:end.end()]
                return line.decode("ascii", errors="replace")
            if len(self._buffer) > _MAX_LINE:
                self._buffer.clear()
                self.malformed += 1
            if deadline is not None and time.monotonic() > deadline:
                return None
            with error_check("Could not read from serial device"):
                self._buffer.extend(self.serialPortOrig.read(max(1, self.serialPortOrig.in_waiting)))

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        line = self._read(timeout)
        if line is None:
            return None, False
        # No line of digits contains that letter; a version may begin like a frame.
        if "n" in line.lower() and _CANABLE.search(line):
            self._take_canable()
            return None, False
        if line[0] not in _HEAD:
            self._take_answer(line)
            return None, False
        try:
            self.stamp_ms = _stamp_of(line)
            self._queue.put(line)
            received = super()._recv_internal(0)
        except (ValueError, IndexError):
            self.malformed += 1
            return None, False
        self.answers += 1
        return received

    def _take_canable(self) -> None:
        """Open the channel of a CANable: it accepted M1 silently and ignored L."""
        self.answers += 1
        if self._listen_only and self._is_refused is None:
            self._write("O")
        self._look_at_order()

    def _look_at_order(self) -> None:
        """Evaluate the answer before the answer to V: it belongs to the listen-only command."""
        self.refuses = self._listen_only and self._is_refused is True

    def _take_answer(self, line: str) -> None:
        if re.fullmatch(r"F[0-9A-Fa-f]{2}\r", line):
            self.flags = int(line[1:3], 16)
            self.overruns += bool(self.flags & (FLAG_RECEIVE_FULL | FLAG_DATA_OVERRUN))
            self.flags_answered += 1
            self.answered()
        elif not re.fullmatch(r"(z|Z|[VvN][0-9A-Za-z]*)?[\r\a]", line):
            self.malformed += 1
            return
        elif line[0] == "V":
            self._look_at_order()
        elif len(line) == 1:
            self._is_refused = line == _REFUSED
        self.answers += 1


def _stamp_of(line: str) -> int | None:
    """Stamp at the end of a frame's line, None without one; ValueError if the line is not a frame."""
    if not _DIGITS.fullmatch(line[1:-1]):
        raise ValueError(line)
    head = _HEAD[line[0]]
    is_fd = line[0] in _FD
    length = _FD_LENGTHS[int(line[head - 1], 16)] if is_fd else int(line[head - 1])
    end = head + (2 * length if line[0] in _WITH_DATA else 0)
    stamp = line[end:-1]
    if not is_fd and length > _MAX_CLASSIC_DATA or len(line) - 1 not in (end, end + _STAMP_DIGITS):
        raise ValueError(line)
    # Eight digits exceed the 29 bits of an identifier, three exceed 11.
    if int(line[1:head - 1], 16) >= 1 << (_STANDARD_BITS if head == _STANDARD_HEAD else _EXTENDED_BITS):
        raise ValueError(line)
    stamp_ms = int(stamp, 16) if stamp else None
    if stamp_ms is not None and stamp_ms >= _STAMP_LIMIT_MS:
        raise ValueError(line)
    return stamp_ms
