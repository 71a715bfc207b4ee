"""Traces of PCAN-View and of CanHacker (TRC)."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Sequence

from .lines import (
    Line,
    LineReader,
    Read,
    WrongShape,
    fd_length,
    frame,
    hex_bytes,
    hex_id,
    seconds,
    some_bytes,
)

_MS_PER_S = 1000.0
_STANDARD_DIGITS = 4
_NUMBERED, _BRACKETED = re.compile(r"\d+\)?\s"), re.compile(r"\d+\)\s")
_DIRECTIONS = ("Rx", "Tx")
# Columns of the versions that do not name them; files of 2.x do.
_COLUMNS = {"1.0": "N O I L D", "1.1": "N O d I L D", "1.2": "N O B d I L D", "1.3": "N O B d I R L D"}
_DATA_TYPES, _FD_TYPES = {"DT", "FD", "FB", "FE", "BI"}, {"FD", "FB", "FE", "BI"}
_HACKER = re.compile(r"(\d+[.,]\d+)\s+([0-9A-Fa-f]{1,8})\s+([0-8])\b((?:\s+[0-9A-Fa-f]{2})*)\s*(.*)")


class PcanTrace(LineReader):
    """Reader of versions 1.0 to 2.1; buses count from 1."""

    name = "PCAN trace"

    def __init__(self) -> None:
        self._columns: Sequence[str] = _COLUMNS["1.0"].split()
        self._are_named = False

    def read(self, line: str) -> Read:
        """See LineReader."""
        if line.startswith(";"):
            self._header(line)
            return Line.NOTHING
        # CanHacker's times resemble frame numbers, which have a bracket in versions that name no columns.
        if not (_NUMBERED if self._are_named else _BRACKETED).match(line):
            raise WrongShape
        values = dict(zip(self._columns, line.split(maxsplit=len(self._columns) - 1)))
        if not {"O", "I"} <= set(values):
            raise WrongShape
        if values.get("T", "DT") not in _DATA_TYPES or values.get("d", "Rx") not in _DIRECTIONS:
            return Line.NO_DATA
        return self._frame(values)

    def _header(self, line: str) -> None:
        key, _, value = line[1:].strip().partition("=")
        if key == "$FILEVERSION":
            self.is_recognized = True
            self._columns = _COLUMNS.get(value.strip(), _COLUMNS["1.0"]).split()
        elif key == "$COLUMNS":
            self._columns = [each.strip() for each in value.split(",")]
            self._are_named = True

    def _frame(self, values: dict[str, str]) -> Read:
        id_text, rest = values["I"], values.get("D", "")
        if id_text.upper() == "FFFFFFFF" or rest.startswith("RTR"):
            return Line.NO_DATA
        is_fd = values.get("T") in _FD_TYPES
        length = _number(values["l"]) if "l" in values else fd_length(_number(values.get("L", "")))
        time_s = seconds(values["O"]) / _MS_PER_S
        words = rest.split()
        data = hex_bytes(rest) if len(words) == 1 and length > 1 else some_bytes(words, length)
        if len(data) != length:
            raise ValueError(f"has {len(data)} bytes of data, and says {length}")
        channel = max(int(values["B"]) - 1, 0) if values.get("B", "").isdecimal() else 0
        return frame(time_s, hex_id(id_text), len(id_text) > _STANDARD_DIGITS, data, is_fd=is_fd, channel=channel)


class CanHackerTrace(LineReader):
    """Reader of time in s, identifier, length and data; the decimal sign depends on the computer's locale."""

    name = "CanHacker trace"

    def read(self, line: str) -> Read:
        """See LineReader."""
        if line.split()[:3] == ["Time", "ID", "DLC"]:
            self.is_recognized = True
            return Line.NOTHING
        match = _HACKER.fullmatch(line)
        if match is None:
            raise WrongShape
        time_text, id_text, length, data, rest = match.groups()
        if rest.upper().startswith("RTR"):
            return Line.NO_DATA
        return frame(seconds(time_text), hex_id(id_text), len(id_text) > _STANDARD_DIGITS,
                     some_bytes(data.split(), int(length)))


def _number(text: str) -> int:
    if not re.fullmatch(r"\d{1,2}", text):
        raise ValueError("has no length of its data")
    return int(text)
