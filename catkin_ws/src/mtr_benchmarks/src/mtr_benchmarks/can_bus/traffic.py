"""Background traffic of a full bus, in which a lock signal is hidden: made by chance, or recorded from a car."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import random
from abc import ABC, abstractmethod
from typing import Callable, Dict, Iterator, List, Optional, Tuple

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.log.read_log import ReadLog

_CYCLES_S = (0.01, 0.02, 0.02, 0.05, 0.1, 0.1, 0.2, 0.5, 1.0)
_BYTES = 8
# Of the bytes that are made: still, counters, noise of a sensor's low bits, drift, a state that toggles now and then.
_KINDS = ("still", "still", "counter", "noise", "drift", "toggle")
_TOGGLE_PER_S = 0.05
_IDS = range(0x80, 0x700)
# Identifier and extent of a recorded message; time from the log's begin and data of each of its frames.
_Key = Tuple[int, bool]
_Frames = List[Tuple[float, bytes]]


class TrafficMessage(ABC):
    """One message of the bus.

    Attributes:
        can_id, is_extended: its identifier. cycle_s: between two of its frames, in the mean. length: in bytes.
        due_s: when its next frame comes.
    """

    def __init__(self, can_id: int, is_extended: bool, cycle_s: float, length: int, due_s: float):
        self.can_id, self.is_extended = can_id, is_extended
        self.cycle_s, self.length, self.due_s = cycle_s, length, due_s
        self._hidden: Optional[Tuple[int, int, Callable[[], bool]]] = None

    def hide(self, place: int, bit: int, is_set: Callable[[], bool]) -> None:
        """Have a bit of a byte tell something else than before."""
        self._hidden = place, bit, is_set

    def frame(self, now_s: float) -> CanFrame:
        """The frame that is due; then the next one is."""
        data = bytearray(self._next(now_s))
        if self._hidden is not None:
            place, bit, is_set = self._hidden
            data[place] = data[place] & ~(1 << bit) | is_set() << bit
        return CanFrame(self.can_id, self.is_extended, bytes(data), now_s)

    @abstractmethod
    def _next(self, now_s: float) -> bytes:
        """Data of the frame that is due; moves due_s on."""


class _Made(TrafficMessage):
    """bytes_of: each byte at a time, by the count of frames."""

    def __init__(self, can_id: int, cycle_s: float, bytes_of: List[Callable[[float, int], int]], due_s: float):
        super().__init__(can_id, False, cycle_s, len(bytes_of), due_s)
        self._bytes_of, self._count = bytes_of, 0

    def _next(self, now_s: float) -> bytes:
        self._count += 1
        self.due_s += self.cycle_s
        return bytes(each(now_s, self._count) for each in self._bytes_of)


class _Recorded(TrafficMessage):
    """The frames of a log over and over again. phase_s: how long after the log's begin this one begins."""

    def __init__(self, key: _Key, frames: _Frames, length_s: float, phase_s: float):
        super().__init__(*key, length_s / len(frames), min(len(data) for _, data in frames), 0.0)
        self._frames, self._length_s, self._phase_s = frames, length_s, phase_s
        self._number = 0
        self._plan()

    def _plan(self) -> None:
        lap, place = divmod(self._number, len(self._frames))
        self.due_s = self._phase_s + lap * self._length_s + self._frames[place][0]

    def _next(self, now_s: float) -> bytes:
        data = self._frames[self._number % len(self._frames)][1]
        self._number += 1
        self._plan()
        return data


def made_traffic(chance: random.Random, frames_per_s: float) -> Iterator[TrafficMessage]:
    """As many messages as fill the bus."""
    sent_per_s = 0.0
    for can_id in chance.sample(_IDS, 500):
        cycle_s = chance.choice(_CYCLES_S)
        sent_per_s += 1.0 / cycle_s
        if sent_per_s > frames_per_s:
            return
        yield _Made(can_id, cycle_s, [_byte(chance) for _ in range(_BYTES)], chance.uniform(0.0, cycle_s))


def recorded_traffic(log: pathlib.Path, chance: random.Random, frames_per_s: float) -> Iterator[TrafficMessage]:
    """The messages of a log, and again by other identifiers and at another time of the log until the bus is full."""
    frames, length_s = _read(log)
    free = chance.sample([each for each in _IDS if (each, False) not in frames], 500)
    sent_per_s, phase_s = 0.0, 0.0
    while True:
        for key, each in frames.items():
            sent_per_s += len(each) / length_s
            if sent_per_s > frames_per_s:
                return
            yield _Recorded((free.pop(), False) if phase_s else key, each, length_s, phase_s)
        # A message that begins later is still before that; it begins before the first prompt.
        phase_s = chance.uniform(0.1, 1.0) * length_s


def _read(log: pathlib.Path) -> Tuple[Dict[_Key, _Frames], float]:
    found: Dict[_Key, _Frames] = {}
    begin_s = end_s = 0.0
    for frame in ReadLog(log):
        begin_s = begin_s or frame.time_s
        end_s = frame.time_s
        found.setdefault((frame.can_id, frame.is_extended), []).append((frame.time_s - begin_s, frame.data))
    return found, end_s - begin_s


def _byte(chance: random.Random) -> Callable[[float, int], int]:
    kind, base = chance.choice(_KINDS), chance.randrange(256)
    own = random.Random(base + chance.randrange(1 << 30))
    if kind == "counter":
        return lambda _, count: count % 256
    if kind == "noise":
        return lambda *_: base & 0xFC | own.randrange(4)
    if kind == "drift":
        return lambda now_s, _: (base + int(now_s / 3.0)) % 256
    if kind == "toggle":
        phase_s, period_s = own.uniform(0.0, 20.0), own.uniform(0.5, 2.0) / _TOGGLE_PER_S
        return lambda now_s, _: base ^ int((now_s + phase_s) / period_s) % 2
    return lambda *_: base
