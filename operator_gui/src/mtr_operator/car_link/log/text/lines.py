"""Lines of a textual log as readers return them, and helpers that all readers share."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import re
from abc import ABC, abstractmethod
from enum import Enum
from typing import Mapping, NamedTuple, Sequence, Union

# Bytes of a CAN FD frame by its data length code, ISO 11898-1.
_FD_LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)
CLASSIC_BYTES = 8
MAX_STANDARD, _MAX_EXTENDED = 0x7FF, 0x1FFF_FFFF
# Vector's logs count buses in 16 bits, and no other kind has more.
_MAX_CHANNEL = 0xFFFF
# End of the year 9999 in UNIX time: no clock of a log shows more, whatever its origin.
_LATEST_S = 253_402_300_799.0
_DATE = re.compile(r"(\d{4}-\d\d-\d\d)[ T](\d\d:\d\d:\d\d)([.,]\d+)?(?: ?(Z|[+-]\d\d:?\d\d))?")
# Byte by the base of its digits. More digits than a byte needs are of another base: candump -i writes binary ones.
_BYTES = {base: re.compile(pattern) for base, pattern in (
    (2, "[01]{8}"), (10, r"\d{1,3}"), (16, "(?:0[xX])?[0-9A-Fa-f]{1,2}"))}

# Identifier and is_extended, by the name of a message.
Names = Mapping[str, "tuple[int, bool]"]


class LoggedFrame(NamedTuple):
    """Frame of a log. time_s: by the log's clock, whose kind and origin are unknown. channel: number of the bus, from
    0; 0 in a log without channels."""

    time_s: float
    can_id: int
    is_extended: bool
    data: bytes
    is_fd: bool
    channel: int = 0


class Line(Enum):
    """Lines without a data frame. NOTHING: a comment, a header or an event. NO_DATA: a remote frame or an error
    frame."""

    NOTHING = "nothing"
    NO_DATA = "no data"


class WrongShape(ValueError):
    """The line has a different format than the reader supports."""

    def __init__(self) -> None:
        super().__init__("is not understood")


class Damaged(Exception):
    """The log ends before a frame that is impossible on a bus, or before a corrupt part; the text is the reason."""

    def __init__(self, reason: str = "holds what no bus has carried"):
        super().__init__(reason)


class Ambiguous(Exception):
    """Names of buses that do not identify their numbers. Attributes: names: of these buses."""

    def __init__(self, names: Sequence[str]):
        self.names = " and ".join(names)
        super().__init__(f"names the buses {self.names}")


Read = Union[LoggedFrame, Line]


class LineReader(ABC):
    """Reader of one kind of log, line by line in its order.

    Attributes: name: of the kind, for sentences. is_recognized: its header was found.
    """

    name = ""
    is_recognized = False

    @abstractmethod
    def read(self, line: str) -> Read:
        """Read a line that is not empty; ValueError states why a line is skipped."""

    def prepare(self, lines: Sequence[str]) -> None:  # noqa: B027, most kinds say in their header what they mean
        """Inspect the first lines before they are read, for kinds that do not declare the unit or origin of their
        times."""


class Channels:
    """Numbers of buses by the names of their interfaces: can1, vcan1, CAN 1 and 1 are number 1."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._is_unnumbered = False

    def number(self, name: str) -> int:
        """Return the number of an interface; Ambiguous if it cannot be distinguished from another one."""
        known = self._numbers.get(name)
        if known is not None:
            return known
        match = re.fullmatch(r"[A-Za-z]*[-_. ]?(\d{1,3})", name)
        number = int(match[1]) if match else 0
        self._is_unnumbered = self._is_unnumbered or match is None
        self._numbers[name] = number
        if len(self._numbers) > 1 and (self._is_unnumbered or len(set(self._numbers.values())) < len(self._numbers)):
            raise Ambiguous(list(self._numbers))
        return number


def frame(time_s: float, can_id: int, is_extended: bool, data: bytes, *, is_fd: bool = False,
          channel: int = 0) -> LoggedFrame:
    """Return a frame; one with more than eight bytes is CAN FD. Damaged: see checked."""
    return checked(LoggedFrame(time_s, can_id, is_extended, data, is_fd or len(data) > CLASSIC_BYTES, channel))


def checked(read: LoggedFrame) -> LoggedFrame:
    """Return the frame; Damaged if it is impossible on a bus, because the readers accept any number."""
    if not abs(read.time_s) <= _LATEST_S:
        raise Damaged(f"has the time {read.time_s:.3g} s, which no clock shows")
    limit = _MAX_EXTENDED if read.is_extended else MAX_STANDARD
    if not (0 <= read.can_id <= limit and len(read.data) <= _FD_LENGTHS[-1] and read.channel <= _MAX_CHANNEL):
        raise Damaged
    return read


def seconds(text: str) -> float:
    """Return a time, with a decimal point or comma."""
    try:
        return float(text.replace(",", "."))
    except ValueError:
        raise WrongShape from None


def moment(text: str) -> float:
    """Return a time in seconds, or a date with a time of day (ISO 8601) in UNIX time; UTC without a zone."""
    match = _DATE.fullmatch(text.strip())
    if match is None:
        return seconds(text)
    date, clock, part, zone = match.groups()
    zone = "+00:00" if zone in (None, "Z") else zone if ":" in zone else f"{zone[:3]}:{zone[3:]}"
    try:
        whole_s = datetime.datetime.fromisoformat(f"{date}T{clock}{zone}").timestamp()
    except (ValueError, OverflowError):
        raise WrongShape from None
    return whole_s + seconds(part or "0")


def hex_id(text: str) -> int:
    """Return an identifier in hexadecimal, with or without 0x."""
    if not re.fullmatch(r"(?:0[xX])?[0-9A-Fa-f]+", text):
        raise WrongShape
    return int(text, 16)


def hex_bytes(text: str) -> bytes:
    """Return data in hexadecimal, with or without blanks between the bytes."""
    try:
        return bytes.fromhex(text)
    except ValueError:
        raise ValueError("has a byte that is no hexadecimal number") from None


def some_bytes(words: Sequence[str], count: int, base: int = 16) -> bytes:
    """Return the first words as data; the following words are another column."""
    if len(words) < count:
        raise ValueError(f"has {len(words)} bytes of data, and says {count}")
    if not all(map(_BYTES[base].fullmatch, words[:count])):
        raise ValueError("has a byte of data that is no number")
    try:
        return bytes(int(word, base) for word in words[:count])
    except ValueError:
        raise ValueError("has a byte of data that is no number") from None


def fd_length(code: int) -> int:
    """Return the number of bytes of a data length code."""
    if not 0 <= code < len(_FD_LENGTHS):
        raise ValueError(f"has the data length code {code}")
    return int(_FD_LENGTHS[code])
