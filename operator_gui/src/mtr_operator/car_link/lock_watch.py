"""Turns CAN frames and Statuses into lock events on the robot's clock; no threads, sockets or adapters."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
from dataclasses import dataclass, replace

from mtr_operator.domain.ports import CarEvent, LockState
from mtr_operator.domain.robot_status import RobotStatus

from .adapter_clock import AdapterClockMap, StampUnwrapper
from .arrival_clock import ArrivalClockMap
from .clock_map import LEAST_WAY_S, ClockMap
from .delay_watch import DelayWatch
from .frame_judge import FrameJudge
from .liveness import Liveness
from .profile import CarProfile, LockReading
from .robot_clock import RobotClock, sent_s

# Kept small against the cycle, so that "caught up" means the same frame whatever the small error of the map.
_CATCH_UP_MARGIN_S = 0.003
# More missing cycles than this between two frames: frames were lost, and a change may be as old as the gap.
_LOST_CYCLES = 2.5
# Frames that follow one another faster or slower than this had waited, in the adapter or the laptop.
_EVEN_CYCLES = (0.5, 1.5)
# Stamps that start again each minute cannot be followed over a longer silence.
_MAX_FOLLOWED_SILENCE_S = 50.0
# Adapters hand frames on in batches, each 16 ms with common USB chips, 20 ms in simulation.
_ADAPTER_STEP_S = 0.022
# Frames of the lock message kept as evidence, and so many cycles of them to both sides of a change.
_KEPT_FRAMES = 64
_EVIDENCE_CYCLES = 10.0
# Without Statuses nothing is released, and a link that is silent for so long makes each line invalid anyway.
_KEPT_CHANGES = 1000
# Robot time for which an event may wait until it is clear whether a clock was set or its messages are late.
_MAX_DOUBT_S = 0.3
_UNMAPPED = "The clock of the CAN frames is not mapped to the robot's yet; this takes about two seconds."
_ROBOT_CLOCK_SET = ("The robot's clock was set; the clock of the CAN frames is mapped to it anew, which takes about "
                    "two seconds.")
_ADAPTER_CLOCK_SET = ("The clock of the CAN adapter jumped; it is mapped to the robot's anew, which takes about two "
                      "seconds.")
_DOUBTFUL = ("Frames or messages of the robot are late, or a clock was set; the time at which the locks changed is not "
             "known yet.")


@dataclass(frozen=True)
class CanFrame:
    """A received frame.

    arrival_s: laptop's monotonic clock. stamp_ms: adapter's clock, starting again each minute; stamp_s: adapter's clock
    that does not; None when it gives none.
    """

    can_id: int
    is_extended: bool
    data: bytes
    arrival_s: float
    stamp_ms: int | None = None
    stamp_s: float | None = None

    @property
    def is_stamped(self) -> bool:
        """The adapter gave it a stamp."""
        return self.stamp_ms is not None or self.stamp_s is not None


@dataclass(frozen=True)
class _Change:
    """A change of the locks, a doubtful frame, or both.

    is_timed: its time can be told; a clock was not set meanwhile. is_event: false for a return from an unknown state.
    """

    local_s: float
    previous_local_s: float
    arrival_s: float
    reading: LockReading
    is_timed: bool = True
    doubt: str = ""
    is_event: bool = True


class LockWatch:
    """Follows the lock state.

    Attributes:
        lock_state: at the stamp of the last released Status; UNKNOWN while the bus is silent.
    """

    def __init__(self, profile: CarProfile):
        self._profile = profile
        self._liveness = Liveness(profile)
        self._robot_session_id = 0
        self._robot_clock = RobotClock()
        self._stamp_s = -math.inf
        self._restart()

    def _restart(self) -> None:
        self.lock_state = LockState.UNKNOWN
        self._map: ClockMap | None = None
        self._unwrapper = StampUnwrapper()
        self._delays = DelayWatch(_ADAPTER_STEP_S)
        self._why_unmapped = ""
        self._in_doubt_since_s = math.inf
        self._is_stamped = False
        self._newest_s = math.nan
        self._judge = FrameJudge(self._profile)
        self._frames: collections.deque[tuple[float, bytes]] = collections.deque(maxlen=_KEPT_FRAMES)
        self._state: LockState | None = None
        self._known: LockState | None = None
        self._state_s = self._before_s = math.nan
        self._changes: collections.deque[_Change] = collections.deque(maxlen=_KEPT_CHANGES)
        self._released_state = LockState.UNKNOWN

    def restart(self) -> None:
        """The adapter was opened anew: its clock and the present lock state are learnt again."""
        self._restart()

    def frame(self, frame: CanFrame) -> None:
        """Take a frame, in the order of arrival."""
        if self._map is None or frame.is_stamped != self._is_stamped:
            self._restart()
            self._is_stamped = frame.is_stamped
            self._map = self._new_map()
        local_s = self._local_s(frame)
        if self._is_stamped and self._robot_clock.is_real_time and self._delays.add(local_s, frame.arrival_s):
            self._unwrapper = StampUnwrapper()
            local_s = self._local_s(frame)
            self._delays = DelayWatch(_ADAPTER_STEP_S)
            self._begin_new_time(_ADAPTER_CLOCK_SET)
            self._newest_s = self._state_s = math.nan
            self._judge = FrameJudge(self._profile)
        # A late frame does not set the time back; NaN before the first frame.
        self._newest_s = max(local_s, self._newest_s)
        self._map.frame(local_s)
        reading = self._profile.decode(frame.can_id, frame.is_extended, frame.data)
        if reading is not None:
            self._frames.append((local_s, frame.data))
            self._follow(local_s, frame.arrival_s, reading)
        # A gateway that goes on with the last frame is as good as silent.
        self._liveness.frame(is_lock_message=reading is not None and not self._judge.is_repeated)

    def status(self, status: RobotStatus, arrival_s: float) -> None:
        """Take a Status, before waiting for the frames that precede it."""
        if status.robot_session_id != self._robot_session_id:
            self._robot_session_id = status.robot_session_id
            self._robot_clock = RobotClock()
            self._stamp_s = -math.inf
            self._liveness = Liveness(self._profile)
            self._restart()
        if self._robot_clock.status(status, arrival_s):
            self._stamp_s = -math.inf
            self._liveness = Liveness(self._profile)
            self._begin_new_time(_ROBOT_CLOCK_SET)
        # A pose that is newer than its Status is one of before the clock was set back.
        stamp_s = min(status.stamp_s, sent_s(status))
        if stamp_s > self._stamp_s and self._map is not None:
            self._map.status(sent_s(status), arrival_s)
        self._stamp_s = max(self._stamp_s, stamp_s)

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
                and self._is_due(self._changes[0], clock_map):
            change = self._changes.popleft()
            self._released_state = change.reading.state
            if change.is_event:
                events.append(self._event(change, clock_map))
        self.lock_state = LockState.UNKNOWN if self._liveness.problem else self._released_state
        return events

    def _is_due(self, change: _Change, clock_map: ClockMap) -> bool:
        """Not before a frame and a Status from after the change tell that no clock was set back before it."""
        if not change.is_timed:
            return True
        time_s = clock_map.to_robot(change.local_s)
        if time_s > self._stamp_s:
            return False
        by_adapter = self._is_stamped and self._robot_clock.is_real_time
        is_certain = (time_s <= self._robot_clock.certain_s
                      and (not by_adapter or change.arrival_s <= self._delays.in_time_arrival_s))
        self._in_doubt_since_s = math.inf if is_certain else min(self._in_doubt_since_s, self._stamp_s)
        return is_certain

    @property
    def problem(self) -> str:
        """One sentence, or empty."""
        if self._liveness.problem:
            return self._liveness.problem
        if self._map is None or not self._map.is_ready:
            return self._why_unmapped or _UNMAPPED
        return _DOUBTFUL if self._stamp_s - self._in_doubt_since_s > _MAX_DOUBT_S else ""

    def _new_map(self) -> ClockMap:
        return AdapterClockMap() if self._is_stamped else ArrivalClockMap()

    def _local_s(self, frame: CanFrame) -> float:
        if frame.stamp_s is not None:
            return frame.stamp_s
        return frame.arrival_s if frame.stamp_ms is None else self._unwrapper.unwrap(frame.stamp_ms)

    def _begin_new_time(self, why: str) -> None:
        """A clock was set: what was not told yet has no time any more, what follows needs a new map."""
        if self._map is not None:
            self._map = self._new_map()
        self._why_unmapped, self._in_doubt_since_s = why, math.inf
        self._changes = collections.deque((replace(change, is_timed=False) for change in self._changes),
                                          maxlen=_KEPT_CHANGES)

    def _follow(self, local_s: float, arrival_s: float, reading: LockReading) -> None:
        doubt, is_changed = self._judge.judge(reading, local_s), reading.state is not self._state
        if self._state is None:
            self._released_state = reading.state
            self._state_s = local_s
        elif is_changed or (doubt and not (self._changes and self._changes[-1].doubt)):
            self._changes.append(_Change(local_s, self._state_s, arrival_s, reading, not math.isnan(self._state_s),
                                         doubt, bool(doubt) or reading.state is not self._known))
        if self._is_even(local_s - self._before_s):
            self._state_s = local_s
        self._state, self._before_s = reading.state, local_s
        if reading.state is not LockState.UNKNOWN:
            self._known = reading.state

    def _is_even(self, gap_s: float) -> bool:
        """False for a frame that had waited: its state may be as old as the last one that had not."""
        least, most = _EVEN_CYCLES
        return (self._is_stamped or not self._robot_clock.is_real_time
                or least <= gap_s / self._profile.cycle_time_s <= most)

    def _event(self, change: _Change, clock_map: ClockMap) -> CarEvent:
        if not change.is_timed:
            return CarEvent(self._stamp_s, math.inf, change.reading.state, change.reading.source, change.doubt)
        time_s = clock_map.to_robot(change.local_s)
        # A cyclic message shows a change that happened at any time since the message before.
        gap_s = time_s - clock_map.to_robot(change.previous_local_s)
        vague = not self._profile.sent_on_change or gap_s > _LOST_CYCLES * self._profile.cycle_time_s
        spread_s = gap_s if vague else 0.0
        way_s = LEAST_WAY_S if self._is_stamped and self._robot_clock.is_real_time else 0.0
        sigma_s = math.hypot(clock_map.sigma_s, way_s, spread_s / math.sqrt(12.0))
        return CarEvent(time_s - spread_s / 2, sigma_s, change.reading.state, change.reading.source, change.doubt,
                        self._evidence(change, clock_map))

    def _evidence(self, change: _Change, clock_map: ClockMap) -> tuple[str, ...]:
        """Frames around a change, with robot time, as candump writes them."""
        around_s = _EVIDENCE_CYCLES * self._profile.cycle_time_s
        return tuple(f"({clock_map.to_robot(local_s):.4f}) {self._profile.message.frame_id:03X}#{data.hex().upper()}"
                     for local_s, data in self._frames if abs(local_s - change.local_s) <= around_s)
