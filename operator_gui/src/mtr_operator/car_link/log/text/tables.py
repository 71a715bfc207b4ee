"""Tables of frames with commas, semicolons or tabs: SavvyCAN (GVRET), python-can and similar ones."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import base64
import binascii
import re
import statistics
from typing import Mapping, Sequence

from .cells import cell_data, cell_id, cell_time, data_length, is_extended, is_set
from .lines import (
    Channels,
    Line,
    LineReader,
    Read,
    WrongShape,
    frame,
    some_bytes,
)

_TIME, _ID, _EXTENDED, _DIRECTION, _BUS, _LENGTH, _DATA = "time", "id", "extended", "dir", "bus", "length", "data"
_REMOTE, _ERROR, _UNKNOWN = "remote", "error", ""
# Names of columns in lower case, without characters other than letters and digits.
_COLUMNS = {
    _TIME: ("timestamp", "time", "timeus", "timems", "times", "timestampus", "timestampms", "timestamps", "timeoffset",
            "timeoffsetms", "timestampmicroseconds", "timestampmilliseconds", "timestampseconds", "abstime"),
    _ID: ("id", "arbitrationid", "canid", "identifier", "messageid", "idhex", "arbid", "msgid"),
    _EXTENDED: ("extended", "ext", "isextended", "isext", "ide", "extendedid", "isextendedid", "extid", "extendedframe",
                "idtype", "idformat"),
    _DIRECTION: ("dir", "direction", "rxtx"),
    _BUS: ("bus", "channel", "chn", "busnumber"), _LENGTH: ("len", "length", "dlc", "datalength"),
    _DATA: ("data", "databytes", "payload", "datahex"),
    _REMOTE: ("remote", "rtr", "isremote", "isrtr", "remoteframe", "isremoteframe"),
    _ERROR: ("error", "err", "iserror", "iserr", "errorframe", "iserrorframe")}
# Micro sign, Greek letter mu, and the remainder of either in a file of another encoding.
_MICRO = str.maketrans(dict.fromkeys("\N{MICRO SIGN}\N{GREEK SMALL LETTER MU}\N{REPLACEMENT CHARACTER}", "u"))
# Columns of one byte each.
_FIRST_BYTE, _BYTE = (re.compile(rf"(?:d|b|data|byte|databyte){number}") for number in ("0?[01]", r"\d\d?"))
_UNITS_S = {"us": 1e-6, "microseconds": 1e-6, "ms": 1e-3, "milliseconds": 1e-3, "s": 1.0, "seconds": 1.0}
# Tables without a header, by their number of columns before the data.
_WITHOUT_HEADER = ((_TIME, _ID, _EXTENDED, _DIRECTION, _BUS, _LENGTH), (_TIME, _ID, _EXTENDED, _BUS, _LENGTH))
_BASE64 = ["timestamp", "arbitration_id", "extended", "remote", "error", "dlc", "data"]
# No message of a car has a shorter cycle.
_SHORTEST_CYCLE_S = 0.0005


class Table(LineReader):
    """Table with a header, or with SavvyCAN's columns without one."""

    name = "table of SavvyCAN or python-can"

    def __init__(self) -> None:
        self._columns: Sequence[str] = ()
        self._delimiter = ","
        self._is_base64 = self._are_bytes = False
        self._unit_s: float | None = None
        self._channels = Channels()
        self._head = ""

    def prepare(self, lines: Sequence[str]) -> None:
        """See LineReader: integers are microseconds, unless the frames would exceed the capacity of a bus."""
        self._head = next((line for line in lines if self._header(line)), "")
        if not self._head:
            self._guess(lines)
        if not self._columns or self._unit_s is not None:
            return
        times: dict[str, list[float]] = {}
        for line in lines:
            values = self._values(line)
            if _TIME in values and re.fullmatch(r"-?\d+", values[_TIME]):
                times.setdefault(values.get(_ID, ""), []).append(float(values[_TIME]))
        self._unit_s = unit_s(times) if times else 1.0

    def _header(self, line: str) -> bool:
        delimiter = max(",;\t", key=line.count)
        words = [each.strip().strip('"').translate(_MICRO) for each in line.rstrip(delimiter).split(delimiter)]
        names = [re.sub(r"[^a-z0-9]", "", word.lower()) for word in words]
        columns = _columns(names)
        if not {_TIME, _ID, _DATA} <= set(columns):
            return False
        self.is_recognized = True
        self._columns, self._delimiter, self._is_base64 = columns, delimiter, words == _BASE64
        self._are_bytes = any(map(_FIRST_BYTE.fullmatch, names))
        unit = re.search(r"(us|ms|microseconds|milliseconds|seconds|(?<=[^a-z])s)$",
                         re.sub(r"[^a-z]+", " ", words[columns.index(_TIME)].lower()).strip())
        self._unit_s = _UNITS_S[unit[1]] if unit else None
        return True

    def _guess(self, lines: Sequence[str]) -> None:
        for columns in _WITHOUT_HEADER:
            for delimiter in ",;\t":
                rows = [line.split(delimiter) for line in lines[:10]]
                at = columns.index(_EXTENDED)
                if rows and all(len(row) > len(columns) and row[at].strip().lower() in ("true", "false")
                                and row[len(columns) - 1].strip().isdecimal() for row in rows):
                    self._columns, self._delimiter = (*columns, _DATA), delimiter
                    return

    def _values(self, line: str) -> Mapping[str, str]:
        words = line.split(self._delimiter, len(self._columns) - 1)
        values: dict[str, str] = {}
        for column, word in zip(self._columns, words):
            before = f"{values[_DATA]}{self._delimiter}" if column == _DATA and column in values else ""
            values[column] = before + word.strip().strip('"')
        return values

    def read(self, line: str) -> Read:
        """See LineReader."""
        if not self._columns:
            raise WrongShape
        if line == self._head or _is_header_again(line):
            return Line.NOTHING
        values = self._values(line)
        if len(values) < len({*self._columns}) - 1 or _TIME not in values or _ID not in values:
            raise ValueError(f"has {line.count(self._delimiter) + 1} columns, and {len(self._columns)} are wanted")
        time_s = cell_time(values[_TIME], self._unit_s or 1.0)
        if any([is_set(values.get(column, ""), column) for column in (_REMOTE, _ERROR)]):
            return Line.NO_DATA
        can_id = cell_id(values[_ID])
        bus = values.get(_BUS, "")
        return frame(time_s, can_id, is_extended(values.get(_EXTENDED, ""), can_id), self._data(values),
                     channel=self._channels.number(bus) if bus else 0)

    def _data(self, values: Mapping[str, str]) -> bytes:
        text, length = values.get(_DATA, ""), values.get(_LENGTH, "")
        if length and not re.fullmatch(r"\d{1,2}", length):
            raise ValueError(f"has the length {length}")
        if self._is_base64:
            return _base64(text, length)
        if not self._are_bytes:
            return cell_data(text.replace(self._delimiter, " ").split(), length)
        cells = [cell.strip().strip('"') for cell in text.rstrip(f"{self._delimiter} ").split(self._delimiter)]
        words = cells if any(cells) else []
        return some_bytes(words, data_length(length, len(words)) if length else len(words))


def _columns(names: Sequence[str]) -> list[str]:
    """Return the contents of the columns with these names; each column of one byte holds data."""
    columns = [next((key for key, known in _COLUMNS.items() if name in known), _UNKNOWN) for name in names]
    first = next((at for at, name in enumerate(names) if _FIRST_BYTE.fullmatch(name)), None)
    if first is None:
        return columns
    behind = next((at for at in range(first, len(names)) if not _BYTE.fullmatch(names[at])), len(names))
    # Rows may have more bytes than the header, unless another column follows them.
    count = behind - first if behind < len(names) else 1
    others = [_UNKNOWN if column == _DATA else column for column in columns]
    return [*others[:first], *[_DATA] * count, *others[behind:]]


def _base64(text: str, length: str) -> bytes:
    """Return the data of python-can, whose length must match: most hexadecimal texts are also base64."""
    try:
        data = base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise ValueError("has data that is not base64, which python-can's header announces") from None
    if length and len(data) != int(length):
        raise ValueError(f"has {len(data)} bytes of data as base64, and says {length}")
    return data


def _is_header_again(line: str) -> bool:
    return bool(re.match(r"\"?time", line, re.IGNORECASE))


def unit_s(times: Mapping[str, Sequence[float]]) -> float:
    """Return the unit in s of integer times without a unit: microseconds, or milliseconds if a message would be more
    frequent than any real one. times: of each message."""
    steps = [statistics.median(abs(after - before) for before, after in zip(each, each[1:]))
             for each in times.values() if len(each) > 1]
    cycle = statistics.median(steps) if steps else 0.0
    return 1e-3 if 0.0 < cycle * 1e-6 < _SHORTEST_CYCLE_S else 1e-6
