"""Reads logs of a CAN bus frame by frame; the kind of the log is detected by its content."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
from typing import Any, Iterable, Iterator

import can

from mtr_operator.domain.errors import ConnectionFailed

from .blf_log import BlfLog
from .database_log import DatabaseLog
from .mf4_log import Mf4Log
from .text.lines import Damaged, LoggedFrame, Names, checked
from .text.opened import packed_kind
from .text.text_log import TextLog

# Binary kinds, by the first bytes of their files.
_MAGIC = {".blf": b"LOGG", ".mf4": b"MDF ", ".db": b"SQLite format 3\0"}
BLF_SUFFIX = ".blf"
SUFFIXES = (*_MAGIC, ".asc", ".trc", ".log", ".csv", ".crtd", ".txt", ".gz")
# Half of this silence is a fault of a live bus; frames of several channels may be slightly out of order.
_GAP_S, _DISORDER_S = 1.0, 0.1
# Number of frames that may be out of order without a notice, as in logs of several channels.
_FEW = 2
# Maximum number of reported gaps of a log.
_MAX_NOTES = 3
_CANNOT = "The CAN log {} cannot be read: {}."
_DAMAGED = "it is damaged or of another format"
_NO_FRAME = {"is cut off": "it is cut off before its first frame"}
# Maximum number of different messages of a log, which bounds the memory.
_MAX_MESSAGES = 4096


class ReadLog:
    """Iterator over the data frames of a log, in its order. ConnectionFailed if it is not a log.

    names: identifier and is_extended by the name of a message, for logs with names.

    Attributes:
        count: frames so far.
        newest: newest gap or jump of the time, or the reason of an early end. ending: reason of an early end; empty
            without one, or before the end.
    """

    def __init__(self, path: pathlib.Path, names: Names | None = None):
        self.count = 0
        self.newest = self.ending = ""
        self._notes: list[str] = []
        self._times = _Times()
        self._path = path
        try:
            self._reader = _reader(path, names or {})
        except OSError as error:
            raise ConnectionFailed(f"The CAN log {path} cannot be read: {error.strerror or error}.") from None
        except NotImplementedError:
            raise ConnectionFailed(f"The CAN log {path} needs the Python package asammdf, which is not installed.") \
                from None
        except ConnectionFailed:
            raise
        except Damaged as error:
            raise ConnectionFailed(_CANNOT.format(path, error)) from None
        # The library's readers raise various exceptions for a damaged file.
        except Exception:
            raise ConnectionFailed(_CANNOT.format(path, _DAMAGED)) from None

    @property
    def notice(self) -> str:
        """Return sentences if the log is incomplete, in its order; empty if it is complete."""
        told = [f"The CAN log {self._path} {each}." for each in (self._left_out(), *self._times.told) if each]
        return " ".join([*self._notes[:_MAX_NOTES], *told])

    def _left_out(self) -> str:
        log = self._reader
        if not isinstance(log, TextLog) or not log.left_out:
            return ""
        lines = "1 line that is" if log.left_out == 1 else f"{log.left_out} lines that are"
        return f"has {lines} not understood and left out; {log.first}"

    def __iter__(self) -> Iterator[LoggedFrame]:
        last_s: float | None = None
        try:
            for frame in _frames(self._reader):
                self.count += 1
                self._look_at_time(frame.time_s, last_s)
                self._times.frame(frame)
                last_s = frame.time_s
                yield frame
        except GeneratorExit:
            raise
        except Damaged as error:
            self._end("is damaged", str(error))
        except Exception:
            self._end("is damaged")
        if not self.ending and self._is_cut_off():
            self._end("is cut off")
        if not self.count:
            raise ConnectionFailed(f"The CAN log {self._path} holds no frame.")

    def _look_at_time(self, time_s: float, before_s: float | None) -> None:
        step_s = 0.0 if before_s is None else time_s - before_s
        if step_s > _GAP_S:
            self._note(f"The CAN log {self._path} has a gap of {step_s:.1f} s after {self.count - 1} frames; a change "
                       "within it is as uncertain as the gap is long.")
        elif step_s < -_DISORDER_S:
            self._note(f"The time of the CAN log {self._path} jumps back by {-step_s:.1f} s after "
                       f"{self.count - 1} frames; what lies about it is not to be believed.")

    def _note(self, sentence: str) -> None:
        self.newest = sentence
        self._notes.append(sentence)

    def _is_cut_off(self) -> bool:
        return isinstance(self._reader, BlfLog) and self._reader.is_cut_off

    def _end(self, what: str, why: str = "") -> None:
        if not self.count:
            raise ConnectionFailed(_CANNOT.format(self._path, why or _NO_FRAME.get(what, _DAMAGED))) from None
        reason = f" ({why})" if why else ""
        self.ending = f"The CAN log {self._path} {what} after {self.count} frames{reason}; those are used."
        self._note(self.ending)


class _Times:
    """Counter of frames with impossible times: earlier than the previous frame, or equal to the previous time of the
    same message."""

    def __init__(self) -> None:
        self._backward = self._same = 0
        self._worst_s = 0.0
        self._last_s = -math.inf
        self._of_message: dict[tuple[int, bool, int], float] = {}

    def frame(self, frame: LoggedFrame) -> None:
        """Check the next frame."""
        key = (frame.can_id, frame.is_extended, frame.channel)
        if frame.time_s < self._last_s:
            self._backward += 1
            self._worst_s = max(self._worst_s, self._last_s - frame.time_s)
        # Frames of further buses get the time of the newest frame of the first, see LockWatch.
        self._same += not frame.channel and frame.time_s == self._of_message.get(key)
        self._last_s = frame.time_s
        if len(self._of_message) < _MAX_MESSAGES or key in self._of_message:
            self._of_message[key] = frame.time_s

    @property
    def told(self) -> Iterator[str]:
        """Yield the notices on the log."""
        if self._backward > _FEW:
            yield (f"has {self._backward} frames with an earlier time than the frame before, by up to "
                   f"{self._worst_s:.3f} s")
        if self._same:
            yield f"has {self._same} frames with the same identifier and time as a frame before"


def _reader(path: pathlib.Path, names: Names) -> Any:
    with path.open("rb") as file:
        begin = file.read(max(map(len, _MAGIC.values())))
    suffix = path.suffix.lower()
    kind = next((kind for kind, magic in _MAGIC.items() if begin.startswith(magic)), "")
    if kind == BLF_SUFFIX:
        return BlfLog(path)
    if kind == ".db":
        return DatabaseLog(path)
    if kind == ".mf4":
        return Mf4Log(path)
    if suffix in _MAGIC:
        raise ValueError(suffix)
    packed = packed_kind(path, _MAGIC)
    if packed:
        raise Damaged(f"it is a log of the kind {packed[1:]} that was packed with gzip; unpack it first")
    try:
        return TextLog(path, names)
    except ConnectionFailed as error:
        if suffix in SUFFIXES and begin:
            raise
        raise ConnectionFailed(f"{path} is no CAN log: {error}") from None


def _frames(reader: Iterable[Any]) -> Iterator[LoggedFrame]:
    """Yield the data frames; the library's frames count buses from 0."""
    for each in reader:
        if isinstance(each, LoggedFrame):
            yield each
        elif not (each.is_error_frame or each.is_remote_frame):
            yield _checked(each)


def _checked(message: can.Message) -> LoggedFrame:
    channel = message.channel if isinstance(message.channel, int) else 0
    try:
        return checked(LoggedFrame(message.timestamp, message.arbitration_id, message.is_extended_id,
                                   bytes(message.data), message.is_fd, channel))
    except Damaged as error:
        raise Damaged(f"the next frame {error}") from None
