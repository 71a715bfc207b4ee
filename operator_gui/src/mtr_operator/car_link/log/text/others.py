"""Further textual logs: BUSMASTER, CRTD (OVMS), and lines of time, identifier and data."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Sequence

from .lines import Line, LineReader, Read, WrongShape, frame, hex_bytes, hex_id, seconds, some_bytes
from .tables import unit_s

_DAY_S = 86_400.0
_PER_S = 10_000.0
_MASTER = re.compile(r"(?:(\d+):(\d\d):(\d\d):(\d{1,4})|(\d+))\s+(Rx|Tx)\s+(\d+)\s+(0x[0-9A-Fa-f]+|\d+|\S+)\s+"
                     r"(s|x|sr|xr|s-fd|x-fd|sfd|xfd)\s+(\d{1,2})\s*(.*)", re.IGNORECASE)
_CRTD = re.compile(r"(\d+\.\d+)\s+(\d*)([RT](?:11|29)|C[A-Z]{2}|[A-Z]{3})\b\s*(\S*)\s*(.*)")
_COLON = re.compile(r"\(?(\d+(?:[.,]\d+)?)\)?\s+(?:0x)?([0-9A-Fa-f]{1,8}):\s*((?:[0-9A-Fa-f]{2}\b\s*)*)")
_STANDARD_DIGITS = 3


class Busmaster(LineReader):
    """Hours, minutes, seconds and tenths of a millisecond; channels count from 1."""

    name = "BUSMASTER"

    def __init__(self) -> None:
        self._base = 16
        self._are_steps = False
        self._time_s = self._added_s = 0.0

    def read(self, line: str) -> Read:
        """See LineReader."""
        if line.startswith("***"):
            self._header(line.strip("*").strip().upper())
            return Line.NOTHING
        match = _MASTER.fullmatch(line)
        if match is None:
            raise WrongShape
        hours, minutes, secs, parts, _, _, channel, id_text, kind, length, rest = match.groups()
        if parts is None:
            raise ValueError("has no time in hours, minutes and seconds")
        self._at(3600.0 * float(hours) + 60.0 * int(minutes) + int(secs) + int(parts) / _PER_S)
        if kind.lower().endswith("r"):
            return Line.NO_DATA
        try:
            can_id = int(id_text, 16 if id_text.lower().startswith("0x") else self._base)
        except ValueError:
            raise ValueError(f"has the name {id_text} in place of an identifier") from None
        return frame(self._time_s, can_id, kind.lower().startswith("x"),
                     some_bytes(rest.split(), int(length), self._base), is_fd="fd" in kind.lower(),
                     channel=max(int(channel) - 1, 0))

    def _header(self, words: str) -> None:
        self.is_recognized = True
        self._base = {"HEX": 16, "DEC": 10}.get(words, self._base)
        self._are_steps = self._are_steps or words == "RELATIVE MODE"

    def _at(self, time_s: float) -> None:
        if self._are_steps:
            self._time_s += time_s
            return
        # The time of day restarts at midnight.
        if time_s + self._added_s < self._time_s - _DAY_S / 2:
            self._added_s += _DAY_S
        self._time_s = time_s + self._added_s


class Crtd(LineReader):
    """Log of the Open Vehicle Monitoring System; buses count from 1."""

    name = "CRTD"

    def read(self, line: str) -> Read:
        """See LineReader."""
        match = _CRTD.fullmatch(line)
        if match is None:
            raise WrongShape
        time_text, bus, kind, id_text, rest = match.groups()
        if kind[1:] not in ("11", "29"):
            self.is_recognized = self.is_recognized or kind == "CXX"
            return Line.NOTHING
        return frame(seconds(time_text), hex_id(id_text), kind[1:] == "29", hex_bytes(rest),
                     channel=max(int(bus or 1) - 1, 0))


class TimeIdData(LineReader):
    """Such as: 820298   0x085: 7C 03."""

    name = "time, identifier, colon and data"

    def __init__(self) -> None:
        self._unit_s = 1.0

    def prepare(self, lines: Sequence[str]) -> None:
        """See LineReader."""
        times: dict[str, list[float]] = {}
        for match in filter(None, map(_COLON.fullmatch, lines)):
            if match[1].isdecimal():
                times.setdefault(match[2], []).append(float(match[1]))
        self._unit_s = unit_s(times) if times else 1.0

    def read(self, line: str) -> Read:
        """See LineReader."""
        match = _COLON.fullmatch(line)
        if match is None:
            raise WrongShape
        time_text, id_text, data = match.groups()
        return frame(seconds(time_text) * self._unit_s, hex_id(id_text), len(id_text) > _STANDARD_DIGITS,
                     hex_bytes(data))
