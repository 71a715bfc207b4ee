"""Logs of candump (can-utils): its files, and its console output."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import re
from typing import Sequence

from .lines import (
    Channels,
    Line,
    LineReader,
    Read,
    WrongShape,
    frame,
    hex_bytes,
    hex_id,
    moment,
    seconds,
    some_bytes,
)

_ERROR_FLAG, _ID_MASK = 0x2000_0000, 0x1FFF_FFFF
_STANDARD_DIGITS = 3
_LOG = re.compile(r"\(([^()]*)\)\s+(\S+)\s+([0-9A-Fa-f]{1,8})#(\S*)(?:\s+[RT])?")
_CONSOLE = re.compile(r"(?:\(([^()]*)\)\s+)?([A-Za-z][\w.-]*)\s+(?:[RT]X\s+[B-]\s+[E-]\s+)?([0-9A-Fa-f]{3,8})\s+"
                      r"[\[{](\d{1,2})[\]}]\s*(.*)")
# Bytes of candump -i.
_BINARY = re.compile(r"[01]{8}")
# Intervals between frames and times since the first frame both begin with 0. Times of an interface do not decrease, and
# the times of the second half are later than the times of the first.
_MIN_FRAMES, _FALLING_SHARE, _GROWING_SHARE = 4, 0.2, 0.75


class CandumpLog(LineReader):
    """Reader of the output of candump -l and -L."""

    name = "candump"

    def __init__(self) -> None:
        self._channels = Channels()

    def read(self, line: str) -> Read:
        """See LineReader."""
        match = _LOG.fullmatch(line)
        if match is None:
            raise WrongShape
        time_text, name, id_text, rest = match.groups()
        can_id = hex_id(id_text)
        is_extended = len(id_text) > _STANDARD_DIGITS
        if is_extended and can_id & _ERROR_FLAG:
            return Line.NO_DATA
        is_fd = rest.startswith("#")
        if rest[:1] in ("R", "r"):
            return Line.NO_DATA
        # CAN FD has a digit of flags before the data; classic CAN may have a data length code above 8 after the data.
        data = hex_bytes((rest[2:] if is_fd else rest).split("_")[0].replace(".", ""))
        return frame(seconds(time_text), can_id & _ID_MASK, is_extended, data, is_fd=is_fd,
                     channel=self._channels.number(name))


class CandumpConsole(LineReader):
    """Reader of candump's console output with times (-t a, A, d or z) in a file."""

    name = "candump on a console"

    def __init__(self) -> None:
        self._channels = Channels()
        self._are_steps = False
        self._sum_s = 0.0

    def prepare(self, lines: Sequence[str]) -> None:
        """See LineReader: -t d and -t z are distinguished by several lines."""
        matches = [match for match in map(_CONSOLE.fullmatch, lines) if match and match[1]]
        stamps = [(match[2], _time_or_nan(match[1])) for match in matches]
        self._are_steps = _are_steps([(name, time_s) for name, time_s in stamps if math.isfinite(time_s)])

    def read(self, line: str) -> Read:
        """See LineReader."""
        match = _CONSOLE.fullmatch(line)
        if match is None:
            raise WrongShape
        time_text, name, id_text, length, rest = match.groups()
        if time_text is None:
            raise ValueError("has no time; record the bus with candump -l, or with -t a")
        time_s = moment(time_text)
        if self._are_steps:
            self._sum_s += time_s
            time_s = self._sum_s
        can_id, is_extended = hex_id(id_text), len(id_text) > _STANDARD_DIGITS
        if rest.startswith("remote request") or (is_extended and can_id & _ERROR_FLAG):
            return Line.NO_DATA
        words = rest.split()[:int(length)]
        base = 2 if words and all(map(_BINARY.fullmatch, words)) else 16
        # CAN FD has two digits.
        return frame(time_s, can_id & _ID_MASK, is_extended, some_bytes(words, int(length), base),
                     is_fd=len(length) > 1, channel=self._channels.number(name))


def _are_steps(stamps: Sequence[tuple[str, float]]) -> bool:
    """Return True if the times are intervals since the previous frame. stamps: interface and time."""
    times_s = [time_s for _, time_s in stamps]
    if len(times_s) < _MIN_FRAMES or times_s[0] != 0.0:
        return False
    falling = 0
    last_s: dict[str, float] = {}
    for name, time_s in stamps:
        falling += time_s < last_s.get(name, time_s)
        last_s[name] = time_s
    half = len(times_s) // 2
    growing = sum(after > before for before, after in zip(times_s, times_s[half:]))
    return falling > _FALLING_SHARE * len(times_s) or growing < _GROWING_SHARE * (len(times_s) - half)


def _time_or_nan(text: str) -> float:
    try:
        return moment(text)
    except ValueError:
        return math.nan
