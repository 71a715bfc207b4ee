"""Logs of Vector's tools and of others that write the same lines (ASC)."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Sequence

from .lines import Line, LineReader, Names, Read, WrongShape, fd_length, frame, some_bytes

_HEADER = re.compile(r"(date\s|base\s+(hex|dec)|(no\s+)?internal\s+events|//|(begin|end)\s+triggerblock|measurement|"
                     r"previous\s+log|\#)", re.IGNORECASE)
_BASE = re.compile(r"base\s+(hex|dec)(?:\s+timestamps\s+(absolute|relative))?", re.IGNORECASE)
_EVENT = re.compile(r"(start of measurement|log trigger event|statistic:|.*chip status|.*triggerblock|.*errorframe|"
                    r"txerr|overload|sv:|.*\bstatus:)", re.IGNORECASE)
_TIMED = re.compile(r"(\d+[.,]\d+)\s+(.*)")
_CLASSIC = re.compile(r"(\d+)\s+(\S+)\s+(Rx|Tx|TxRq)\s+([dr])\b\s*(.*)", re.IGNORECASE)
_FD = re.compile(r"CANFD\s+(\d+)\s+(Rx|Tx|TxRq)\s+(\S+)\s+(.*)", re.IGNORECASE)
# Bits BRS and ESI, data length code and length, after an optional name: no name begins with a digit.
_FD_VALUES = re.compile(r"(?:[^\s\d]\S*\s+)?([01])\s+([01])\s+([0-9a-fA-F])\s+(\d{1,2})\b\s*(.*)")
# Identifier or name, by its position.
_PLACE = re.compile(r"\d+[.,]\d+\s+(?:CANFD\s+\d+\s+(?:Rx|Tx|TxRq)|\d+)\s+(\S+)", re.IGNORECASE)
_NUMBER = re.compile(r"([0-9A-Fa-f]+)([xX]?)")
# Identifier after the data, such as: Length = 244000 BitCount = 125 ID = 801
_WRITTEN_ID = re.compile(r"\bID = (\d+)(x?)")
_DATA_END = re.compile(r"\s(Length|BitCount|ID)\s*=")
_HEX, _DEC = 16, 10
_MAX = {False: 0x7FF, True: 0x1FFF_FFFF}


class Asc(LineReader):
    """Reader of ASC lines. names: of messages, for a log with names instead of identifiers."""

    name = "ASC"

    def __init__(self, names: Names):
        self._names = names
        self._has_names = False
        self._base = _HEX
        self._are_steps = False
        self._time_s = 0.0

    def prepare(self, lines: Sequence[str]) -> None:
        """See LineReader: BC is an identifier, or the message BC in a log with names instead of identifiers."""
        texts = (match[1] for match in map(_PLACE.match, lines) if match is not None)
        self._has_names = any(text in self._names and not _NUMBER.fullmatch(text) for text in texts)

    def read(self, line: str) -> Read:
        """See LineReader."""
        if _HEADER.match(line):
            self._header(line)
            return Line.NOTHING
        timed = _TIMED.fullmatch(line)
        if timed is None:
            raise WrongShape
        time_s, rest = float(timed[1].replace(",", ".")), timed[2]
        self._time_s = self._time_s + time_s if self._are_steps else time_s
        classic, fd = _CLASSIC.fullmatch(rest), _FD.fullmatch(rest)
        if classic is not None:
            return self._classic(*classic.groups())
        if _EVENT.match(rest):
            return Line.NO_DATA if "errorframe" in rest.lower() else Line.NOTHING
        if fd is None:
            raise WrongShape
        return self._fd(fd[1], fd[3], fd[4])

    def _header(self, line: str) -> None:
        base = _BASE.match(line)
        if base is not None:
            self.is_recognized = True
            self._base = _HEX if base[1].lower() == "hex" else _DEC
            self._are_steps = (base[2] or "").lower() == "relative"

    def _classic(self, channel: str, identifier: str, _: str, kind: str, rest: str) -> Read:
        can_id, is_extended = self._identifier(identifier, rest)
        if kind in "rR":
            return Line.NO_DATA
        code, *words = _DATA_END.split(rest)[0].split()[:9] or [""]
        if not re.fullmatch(r"[0-9A-Fa-f]{1,2}", code):
            raise ValueError("has no length of its data")
        length = min(int(code, self._base), 8)
        return frame(self._time_s, can_id, is_extended, some_bytes(words, length, self._base),
                     channel=_channel(channel))

    def _fd(self, channel: str, identifier: str, rest: str) -> Read:
        values = _FD_VALUES.match(rest)
        if values is None:
            raise ValueError("is no complete CAN FD frame")
        can_id, is_extended = self._identifier(identifier, rest)
        code, length = int(values[3], _HEX), int(values[4])
        if not length and code:
            return Line.NO_DATA
        if length > fd_length(code):
            raise ValueError(f"says {length} bytes of data with the data length code {code}")
        return frame(self._time_s, can_id, is_extended, some_bytes(values[5].split(), length, self._base), is_fd=True,
                     channel=_channel(channel))

    def _identifier(self, text: str, rest: str) -> tuple[int, bool]:
        number, named, written = self._number(text), self._names.get(text), _WRITTEN_ID.search(rest)
        if named is not None and (number is None or (self._has_names and written is None)):
            return named
        if written is not None and not text[:1].isdecimal():
            return int(written[1]), bool(written[2])
        if number is None:
            raise ValueError(f"has the name {text} in place of an identifier, and the CAN database of the car profile "
                             "has no such message")
        if number[0] > _MAX[number[1]]:
            raise ValueError(f"has the identifier {text}, which is too large")
        return number

    def _number(self, text: str) -> tuple[int, bool] | None:
        """Return the text as a number; None for a name, which includes numbers that are too large."""
        match = _NUMBER.fullmatch(text)
        if match is None:
            return None
        is_extended = bool(match[2])
        try:
            can_id = int(match[1], self._base)
        except ValueError:
            return None
        return (can_id, is_extended) if can_id <= _MAX[is_extended] or text not in self._names else None


def _channel(text: str) -> int:
    return max(int(text) - 1, 0)
