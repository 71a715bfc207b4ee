"""Turns CAN frames and Statuses into lock events on the robot's clock; no threads, sockets or adapters."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
from dataclasses import dataclass

from mtr_operator.domain.ports import CarEvent, LockState
from mtr_operator.domain.robot_status import RobotStatus

from .adapter_clock import AdapterClockMap, StampUnwrapper
from .arrival_clock import ArrivalClockMap
from .clock_map import ClockMap
from .liveness import Liveness
from .profile import CarProfile, LockReading

# Kept small against the cycle, so that "caught up" means the same frame whatever the small error of the map.
_CATCH_UP_MARGIN_S = 0.003
# More missing cycles than this between two frames: frames were lost, and a change may be as old as the gap.
_LOST_CYCLES = 2.5
# Stamps that start again each minute cannot be followed over a longer silence.
_MAX_FOLLOWED_SILENCE_S = 50.0


@dataclass(frozen=True)
class CanFrame:
    """A received frame. arrival_s: laptop's monotonic clock; stamp_ms: adapter's clock, None when it gives none."""

    can_id: int
    is_extended: bool
    data: bytes
    arrival_s: float
    stamp_ms: int | None = None


@dataclass(frozen=True)
class _Change:
    local_s: float
    previous_local_s: float
    reading: LockReading


class LockWatch:
    """Follows the lock state.

    Attributes:
        lock_state: at the stamp of the last released Status; UNKNOWN while the bus is silent.
    """

    def __init__(self, profile: CarProfile):
        self._profile = profile
        self._liveness = Liveness(profile)
        self._robot_session_id = 0
        self._stamp_s = -math.inf
        self._restart()

    def _restart(self) -> None:
        self.lock_state = LockState.UNKNOWN
        self._map: ClockMap | None = None
        self._unwrapper = StampUnwrapper()
        self._is_stamped = False
        self._newest_s = math.nan
        self._state: LockState | None = None
        self._state_s = math.nan
        self._changes: collections.deque[_Change] = collections.deque()
        self._released_state = LockState.UNKNOWN

    def restart(self) -> None:
        """The adapter was opened anew: its clock and the present lock state are learnt again."""
        self._restart()

    def frame(self, frame: CanFrame) -> None:
        """Take a frame, in the order of arrival."""
        is_stamped = frame.stamp_ms is not None
        if self._map is None or is_stamped != self._is_stamped:
            self._restart()
            self._is_stamped = is_stamped
            self._map = AdapterClockMap() if is_stamped else ArrivalClockMap()
        local_s = frame.arrival_s if frame.stamp_ms is None else self._unwrapper.unwrap(frame.stamp_ms)
        # A late frame does not set the time back; NaN before the first frame.
        self._newest_s = max(local_s, self._newest_s)
        self._map.frame(local_s)
        reading = self._profile.decode(frame.can_id, frame.is_extended, frame.data)
        self._liveness.frame(is_lock_message=reading is not None)
        if reading is not None:
            self._follow(local_s, reading)

    def status(self, status: RobotStatus, arrival_s: float) -> None:
        """Take a Status, before waiting for the frames that precede it."""
        if status.robot_session_id != self._robot_session_id:
            self._robot_session_id = status.robot_session_id
            self._stamp_s = -math.inf
            self._liveness = Liveness(self._profile)
            self._restart()
        if status.stamp_s > self._stamp_s and self._map is not None:
            self._map.status(status.stamp_s, arrival_s)
        self._stamp_s = max(self._stamp_s, status.stamp_s)

    def has_caught_up(self) -> bool:
        """True when the frames up to the stamp of the Status are here, or are not to be expected."""
        if self._liveness.is_silent or self._map is None or not self._map.is_ready:
            return True
        reached_s = self._map.to_robot(self._newest_s)
        return reached_s >= self._stamp_s - self._profile.cycle_time_s - _CATCH_UP_MARGIN_S

    def release(self, now_s: float) -> list[CarEvent]:
        """Events not later than the stamp of the Status that were not released before; now_s: laptop's clock."""
        self._liveness.observe(self._stamp_s, now_s)
        if self._liveness.silence_s > _MAX_FOLLOWED_SILENCE_S:
            self._restart()
        clock_map, events = self._map, []
        while self._changes and clock_map is not None and clock_map.is_ready \
                and clock_map.to_robot(self._changes[0].local_s) <= self._stamp_s:
            change = self._changes.popleft()
            self._released_state = change.reading.state
            events.append(self._event(change, clock_map))
        self.lock_state = LockState.UNKNOWN if self._liveness.problem else self._released_state
        return events

    @property
    def problem(self) -> str:
        """One sentence, or empty."""
        if self._liveness.problem:
            return self._liveness.problem
        if self._map is None or not self._map.is_ready:
            return "The clock of the CAN frames is not mapped to the robot's yet; this takes about two seconds."
        return ""

    def _follow(self, local_s: float, reading: LockReading) -> None:
        if self._state is None:
            self._released_state = reading.state
        elif reading.state is not self._state:
            self._changes.append(_Change(local_s, self._state_s, reading))
        self._state, self._state_s = reading.state, local_s

    def _event(self, change: _Change, clock_map: ClockMap) -> CarEvent:
        # A cyclic message shows a change that happened at any time since the message before.
        time_s = clock_map.to_robot(change.local_s)
        gap_s = time_s - clock_map.to_robot(change.previous_local_s)
        vague = not self._profile.sent_on_change or gap_s > _LOST_CYCLES * self._profile.cycle_time_s
        spread_s = gap_s if vague else 0.0
        sigma_s = math.hypot(clock_map.sigma_s, spread_s / math.sqrt(12.0))
        return CarEvent(time_s - spread_s / 2, sigma_s, change.reading.state, change.reading.source)
