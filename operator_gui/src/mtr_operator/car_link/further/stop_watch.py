"""Follows the signals that stop the robot: stop_signals and doors of a profile."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
from dataclasses import dataclass
from typing import Callable

from mtr_operator.domain.supervision.car_signals import DOOR, CarSignal, SignalState

from ..database.codec import SignalReader
from .declared import Further
from .places import MessageKey, Place

# After a silence of this long or three of its own cycles, a clear signal becomes unknown.
SILENCE_LIMIT_S = 2.0
_CYCLE_LIMIT = 3.0
_MS_PER_S = 1000.0


@dataclass
class _Followed:
    """State of one signal. limit_s: silence after which a clear state is unknown."""

    kind: str
    name: str
    place: Place
    judge: Callable[[float], SignalState]
    limit_s: float
    state: SignalState = SignalState.UNKNOWN
    seen_s: float = -math.inf

    def now(self, local_s: float) -> CarSignal:
        """Return the current state; an active state persists over silence until the signal clears it."""
        is_old = self.state is SignalState.CLEAR and not local_s - self.seen_s <= self.limit_s
        source = f"{self.place.signal} of {self.place.message.name}"
        return CarSignal(self.kind, source, SignalState.UNKNOWN if is_old else self.state, self.name)


class StopWatch:
    """States of all signals, updated with every frame in the order of arrival. Local times are of the clock that times
    the first bus."""

    def __init__(self, further: Further):
        stops = [_Followed(each.kind, "", each.place, _judge(each.parked, each.unknown), _limit_s(each.place))
                 for each in further.stops]
        doors = [_Followed(DOOR, each.name, each.place, _door_judge(each.open), _limit_s(each.place))
                 for each in further.doors]
        self._all = (*stops, *doors)
        self._readers: dict[MessageKey, list[tuple[SignalReader, _Followed]]] = collections.defaultdict(list)
        for each in self._all:
            self._readers[each.place.key].append((SignalReader(each.place.message, (each.place.signal,)), each))

    def restart(self) -> None:
        """Restart after the adapter was reopened: all states are unknown until the next frames."""
        for each in self._all:
            each.state, each.seen_s = SignalState.UNKNOWN, -math.inf

    def frame(self, key: MessageKey, data: bytes, local_s: float) -> None:
        """Add a frame."""
        for reader, followed in self._readers.get(key, ()):
            value = reader.values(data).get(followed.place.signal)
            if value is not None:
                followed.state, followed.seen_s = followed.judge(value), local_s

    def signals(self, local_s: float) -> tuple[CarSignal, ...]:
        """Return all signals at a local time; NaN for a bus without frames so far."""
        return tuple(each.now(local_s) for each in self._all)


def _judge(parked: frozenset[int], unknown: frozenset[int]) -> Callable[[float], SignalState]:
    def judge(value: float) -> SignalState:
        if value in unknown or math.isnan(value):
            return SignalState.UNKNOWN
        return SignalState.CLEAR if value in parked else SignalState.ACTIVE
    return judge


def _door_judge(values: frozenset[int]) -> Callable[[float], SignalState]:
    return lambda value: SignalState.ACTIVE if value in values else SignalState.CLEAR


def _limit_s(place: Place) -> float:
    return max(SILENCE_LIMIT_S, _CYCLE_LIMIT * (place.message.cycle_time or 0) / _MS_PER_S)
