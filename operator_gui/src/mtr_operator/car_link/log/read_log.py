"""Reads logs of a CAN bus, of any kind that python-can reads, frame by frame."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Iterator, NamedTuple

import can
from can.io.blf import FILE_HEADER_SIZE, BLFReader

from mtr_operator.domain.errors import ConnectionFailed

SUFFIXES = (".blf", ".asc", ".trc", ".mf4", ".log", ".csv", ".db")


class LoggedFrame(NamedTuple):
    """time_s: by the log's clock, from any origin; a log says nothing of which clock that is."""

    time_s: float
    can_id: int
    is_extended: bool
    data: bytes
    is_fd: bool


class ReadLog:
    """Iterator over the data frames of a log, in its order. ConnectionFailed when it is none.

    Attributes:
        count: frames so far.
        notice: a sentence when the log is not whole, from its end on; empty when it is.
    """

    def __init__(self, path: pathlib.Path):
        self.count = 0
        self.notice = ""
        self._path = path
        if path.suffix.lower() not in SUFFIXES:
            raise ConnectionFailed(f"{path} is no CAN log; known are files that end in {', '.join(SUFFIXES)}.")
        try:
            self._size = path.stat().st_size
            self._reader = can.LogReader(str(path))
        except OSError as error:
            raise ConnectionFailed(f"The CAN log {path} cannot be read: {error.strerror or error}.") from None
        except NotImplementedError:
            raise ConnectionFailed(f"The CAN log {path} needs the Python package asammdf, which is not installed.") \
                from None
        # The library's readers raise whatever a damaged file leads them to.
        except Exception:
            raise ConnectionFailed(f"The CAN log {path} cannot be read: it is damaged or of another format.") from None

    def __iter__(self) -> Iterator[LoggedFrame]:
        last_s = 0.0
        try:
            for message in self._reader:
                if message.is_error_frame or message.is_remote_frame:
                    continue
                self.count += 1
                last_s = message.timestamp
                yield LoggedFrame(last_s, message.arbitration_id, message.is_extended_id, bytes(message.data),
                                  message.is_fd)
        except GeneratorExit:
            raise
        except Exception:
            self.notice = self._ended("is damaged")
        if not self.count:
            raise ConnectionFailed(f"The CAN log {self._path} holds no frame.")
        if not self.notice and self._is_cut_off():
            self.notice = self._ended("is cut off")

    def _is_cut_off(self) -> bool:
        # A BLF says at its beginning how long it is; one whose program was killed says nothing.
        reader = self._reader
        return isinstance(reader, BLFReader) and (self._size < reader.file_size
                                                  or reader.file_size == FILE_HEADER_SIZE < self._size)

    def _ended(self, what: str) -> str:
        return f"The CAN log {self._path} {what} after {self.count} frames; those are used."
