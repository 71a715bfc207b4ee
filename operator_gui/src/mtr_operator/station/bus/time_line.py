"""The Car's locks over time with the key's distance; of bounded size."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import bisect
import collections
import math
import threading
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.actions.distance import gap_to_outline
from mtr_operator.domain.ports import CarEvent, LockState
from mtr_operator.domain.robot_status import RobotStatus

# Stored robot time: a slow approach, its event and the retreat.
SPAN_S = 60.0
# Ten Statuses a second, with a reserve for a robot with a higher rate.
_MAX_MOMENTS = 1200
_MAX_EVENTS = 64


@dataclass(frozen=True)
class Moment:
    """One Status: robot time, lock state, and the key's distance from the Car's outline, None while unknown."""

    stamp_s: float
    lock_state: LockState
    gap_m: float | None


@dataclass(frozen=True)
class LockEvent:
    """Lock change at a robot time, with 1 sigma. gap_m: the key's distance from the Car's outline at that time, None if
    unknown. source: cause of the change, see CarEvent."""

    time_s: float
    time_sigma_s: float
    lock_state: LockState
    gap_m: float | None
    source: str = ""


class TimeLine:
    """Time line, thread-safe. It restarts with the robot, and when the robot's clock was set back."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._robot_session_id = 0
        self._moments: collections.deque[Moment] = collections.deque(maxlen=_MAX_MOMENTS)
        self._events: collections.deque[LockEvent] = collections.deque(maxlen=_MAX_EVENTS)

    def learn(self, status: RobotStatus, events: Sequence[CarEvent], lock_state: LockState) -> None:
        """Add a Status, its events, and the lock state at its time."""
        with self._lock:
            if status.robot_session_id != self._robot_session_id or \
                    (self._moments and status.stamp_s < self._moments[-1].stamp_s):
                self._robot_session_id = status.robot_session_id
                self._moments.clear()
                self._events.clear()
            self._moments.append(Moment(status.stamp_s, lock_state, _gap(status)))
            self._events.extend(LockEvent(event.time_s, event.time_sigma_s, event.lock_state,
                                          self._gap_at(event.time_s, event.time_sigma_s), event.source)
                                for event in events)
            self._forget(status.stamp_s - SPAN_S)

    def recent(self) -> tuple[tuple[Moment, ...], tuple[LockEvent, ...]]:
        """Return the last minute in the order of time."""
        with self._lock:
            return tuple(self._moments), tuple(self._events)

    def _forget(self, before_s: float) -> None:
        while self._moments and self._moments[0].stamp_s < before_s:
            self._moments.popleft()
        while self._events and self._events[0].time_s < before_s:
            self._events.popleft()

    def _gap_at(self, time_s: float, sigma_s: float) -> float | None:
        """Return the gap between the two Statuses around a time; None if the key's position or the time is unknown."""
        moments = list(self._moments)
        after = bisect.bisect_left([moment.stamp_s for moment in moments], time_s)
        if not math.isfinite(sigma_s) or after == len(moments):
            return None
        late, early = moments[after], moments[max(after - 1, 0)]
        if late.stamp_s == time_s:
            return late.gap_m
        if after == 0 or early.gap_m is None or late.gap_m is None:
            return None
        part = (time_s - early.stamp_s) / (late.stamp_s - early.stamp_s)
        return early.gap_m + part * (late.gap_m - early.gap_m)


def _gap(status: RobotStatus) -> float | None:
    if not status.pose_valid or status.car is None:
        return None
    return gap_to_outline(status.key_place, status.car)
