"""Effects of faults on messages of a sensor or of the board. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import collections
import copy
import math
import random
from typing import Any, Deque, List, Optional, Tuple

from .parts import Kind
from .schedule import Fault
from .tilting import Tilting

HEADER = "header"
_BITS = {"uint8": 8, "uint16": 16, "uint32": 32, "uint64": 64}
_FLOATS = ("float32", "float64")
# Values that a broken device or a wrong cast gives, in addition to numbers of ordinary size.
_NONSENSE = (math.nan, math.inf, -math.inf, 1e30, -1e30)
_USUAL = 1000.0
_SHARE_OF_NONSENSE = 0.5


# Range of each beam of a covered or dazzled LiDAR, m.
_SAID = {Kind.EMPTY: math.inf, Kind.SECTOR: math.inf, Kind.DARK: 0.0, Kind.NEAR: 0.05}


class Spoiler:
    """Applies faults to the messages of one topic."""

    def __init__(self, seed: int):
        self._random = random.Random(seed)
        self._last: Optional[Any] = None
        self._late: Deque[Tuple[float, Any]] = collections.deque()
        self._tilting: Optional[Tilting] = None

    def passed(self, message: Any, fault: Optional[Fault], now_s: float) -> List[Any]:
        """Return the messages that arrive instead of a sent one. fault: None: no fault. now_s: time of any steady
        clock."""
        kind = fault.kind if fault else None
        if fault and kind is Kind.TILT:
            self._tilting = self._tilting or Tilting()
        if self._tilting:
            wanted_deg = fault.amount if fault and kind is Kind.TILT else 0.0
            message = self._tilting.passed(message, math.radians(wanted_deg), now_s)
        if kind is not Kind.STUCK:
            self._last = message
        if kind is Kind.OFF:
            return []
        if kind is Kind.STUCK:
            return [self._stuck(message)]
        if kind is Kind.GARBAGE:
            return [garbled(message, self._random)]
        if fault and kind in _SAID:
            return [_without_echoes(message, fault)]
        self._late.append((now_s, message))
        delay_s = fault.amount if fault and kind is Kind.SLOW else 0.0
        arrived = []
        while self._late and now_s - self._late[0][0] >= delay_s:
            arrived.append(self._late.popleft()[1])
        return arrived

    def _stuck(self, message: Any) -> Any:
        """Return the last content with the new header."""
        if self._last is None:
            self._last = message
        again = copy.copy(self._last)
        if hasattr(message, HEADER):
            again.header = message.header
        return again


def _without_echoes(message: Any, fault: Fault) -> Any:
    """Return a scan whose beams, or those in the fault's sector, have no echo, or an echo from the LiDAR's cap."""
    half_rad = math.radians(fault.amount) if fault.kind is Kind.SECTOR else math.inf
    covered = copy.copy(message)
    covered.ranges = [
        _SAID[fault.kind] if abs(message.angle_min + beam * message.angle_increment) <= half_rad else range_m
        for beam, range_m in enumerate(message.ranges)]
    return covered


def garbled(message: Any, source: random.Random) -> Any:
    """Return a message of the same type and sizes with meaningless numbers; the header stays, so that the message is
    fresh."""
    spoilt = copy.copy(message)
    for name, kind in zip(message.__slots__, message._slot_types):
        if name != HEADER:
            setattr(spoilt, name, _garbled_value(getattr(message, name), kind, source))
    return spoilt


def _garbled_value(value: Any, kind: str, source: random.Random) -> Any:
    single, is_array, _ = kind.partition("[")
    if is_array:
        return value if isinstance(value, bytes) else [_garbled_value(each, single, source) for each in value]
    if single in _FLOATS:
        return source.choice(_NONSENSE) if source.random() < _SHARE_OF_NONSENSE else source.uniform(-_USUAL, _USUAL)
    if single in _BITS:
        return source.getrandbits(_BITS[single])
    return garbled(value, source) if hasattr(value, "_slot_types") else value
