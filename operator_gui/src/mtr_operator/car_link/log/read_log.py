"""Reads logs of a CAN bus, of any kind that python-can reads, frame by frame."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
from typing import Iterator, NamedTuple

import can
from can.io.blf import FILE_HEADER_SIZE, BLFParseError, BLFReader

from mtr_operator.domain.errors import ConnectionFailed

BLF_SUFFIX = ".blf"
SUFFIXES = (BLF_SUFFIX, ".asc", ".trc", ".mf4", ".log", ".csv", ".db")
# A live bus that is silent for half of it is a trouble; frames of several channels may be a little out of their order.
_GAP_S, _DISORDER_S = 1.0, 0.1
# Of a log with many gaps the first ones suffice.
_MAX_NOTES = 3
# Each object of a BLF begins with this word, its header's length and version, and its own length; before it may be so
# many bytes of padding.
_OBJECT, _LENGTH_AT, _HEADER, _PADDED = b"LOBJ", 8, 16, 8
# Of a CAN FD frame, ISO 11898-1.
_MAX_DATA_BYTES = 64


class LoggedFrame(NamedTuple):
    """time_s: by the log's clock, from any origin; a log says nothing of which clock that is. channel: of the log, 0
    where it has none."""

    time_s: float
    can_id: int
    is_extended: bool
    data: bytes
    is_fd: bool
    channel: int = 0


class _Blf(BLFReader):
    """The library's reader never comes to the end of an object that says that it is as long as nothing."""

    def _parse_container(self, data: bytes) -> Iterator[can.Message]:
        whole, place = self._tail + data, 0
        while place + _HEADER <= len(whole):
            place = whole.find(_OBJECT, place, place + _PADDED)
            if not 0 <= place <= len(whole) - _HEADER:
                break
            length = int.from_bytes(whole[place + _LENGTH_AT:place + _LENGTH_AT + 4], "little")
            if length < _HEADER:
                raise BLFParseError
            place += length
        yield from super()._parse_container(data)


def _check(message: can.Message) -> None:
    """ValueError or TypeError for what no bus has carried; the library's readers of texts believe any text."""
    limit = 1 << (29 if message.is_extended_id else 11)
    if not (math.isfinite(message.timestamp) and 0 <= message.arbitration_id < limit
            and len(message.data) <= _MAX_DATA_BYTES):
        raise ValueError(f"{message.arbitration_id:x}")


class ReadLog:
    """Iterator over the data frames of a log, in its order. ConnectionFailed when it is none.

    Attributes:
        count: frames so far.
        notice: sentences when the log is not whole, in its order; empty when it is.
        newest: the newest of them, also beyond those that notice has. ending: why it ended too early; empty when it
            did not, or has not ended yet.
    """

    def __init__(self, path: pathlib.Path):
        self.count = 0
        self.notice = self.newest = self.ending = ""
        self._notes = 0
        self._path = path
        if path.suffix.lower() not in SUFFIXES:
            raise ConnectionFailed(f"{path} is no CAN log; known are files that end in {', '.join(SUFFIXES)}.")
        try:
            self._size = path.stat().st_size
            self._reader = _Blf(str(path)) if path.suffix.lower() == BLF_SUFFIX else can.LogReader(str(path))
        except OSError as error:
            raise ConnectionFailed(f"The CAN log {path} cannot be read: {error.strerror or error}.") from None
        except NotImplementedError:
            raise ConnectionFailed(f"The CAN log {path} needs the Python package asammdf, which is not installed.") \
                from None
        # The library's readers raise whatever a damaged file leads them to.
        except Exception:
            raise ConnectionFailed(f"The CAN log {path} cannot be read: it is damaged or of another format.") from None

    def __iter__(self) -> Iterator[LoggedFrame]:
        last_s: float | None = None
        try:
            for message in self._reader:
                if message.is_error_frame or message.is_remote_frame:
                    continue
                _check(message)
                self.count += 1
                self._look_at_time(message.timestamp, last_s)
                last_s = message.timestamp
                channel = message.channel if isinstance(message.channel, int) else 0
                yield LoggedFrame(message.timestamp, message.arbitration_id, message.is_extended_id,
                                  bytes(message.data), message.is_fd, channel)
        except GeneratorExit:
            raise
        except Exception:
            self._end("is damaged")
        if not self.count:
            raise ConnectionFailed(f"The CAN log {self._path} holds no frame.")
        if not self.ending and self._is_cut_off():
            self._end("is cut off")

    def _look_at_time(self, time_s: float, before_s: float | None) -> None:
        step_s = 0.0 if before_s is None else time_s - before_s
        if step_s > _GAP_S:
            self._note(f"The CAN log {self._path} has a gap of {step_s:.1f} s after {self.count - 1} frames; a change "
                       "within it is as uncertain as the gap is long.")
        elif step_s < -_DISORDER_S:
            self._note(f"The time of the CAN log {self._path} jumps back by {-step_s:.1f} s after "
                       f"{self.count - 1} frames; what lies about it is not to be believed.")

    def _note(self, sentence: str) -> None:
        self._notes += 1
        self.newest = sentence
        if self._notes <= _MAX_NOTES:
            self.notice = f"{self.notice} {sentence}".strip()

    def _is_cut_off(self) -> bool:
        # A BLF says at its beginning how long it is; one whose program was killed says nothing.
        reader = self._reader
        return isinstance(reader, BLFReader) and (self._size < reader.file_size
                                                  or reader.file_size == FILE_HEADER_SIZE < self._size)

    def _end(self, what: str) -> None:
        self.ending = f"The CAN log {self._path} {what} after {self.count} frames; those are used."
        self._note(self.ending)
