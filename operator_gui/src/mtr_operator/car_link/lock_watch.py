"""Converts CAN frames and Statuses to lock events on the robot's clock; no threads, sockets or adapters."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math

from mtr_operator.domain.ports import CarEvent, LockState
from mtr_operator.domain.results.refused import Refused
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.supervision.car_signals import CarSignal

from .can_frame import CanFrame
from .clocks.frame_time import FrameTime
from .clocks.stamp_kind import StampKind
from .further.companions import Companions
from .further.state_buses import StateBuses
from .further.stop_watch import StopWatch
from .liveness import Liveness
from .lock_changes import Change, LockChanges
from .profile import CarProfile, LockReading

# Small against the cycle, so that "caught up" selects the same frame despite the small error of the map.
_CATCH_UP_MARGIN_S = 0.003
# More missing cycles than this between two frames mean lost frames, so a change may be as old as the gap.
_LOST_CYCLES = 2.5
# Stamps that restart each minute cannot be followed over a longer silence.
_MAX_FOLLOWED_SILENCE_S = 50.0
# Stored frames of the lock message, and the cycles before and after a change that are evidence.
_KEPT_FRAMES = 64
_EVIDENCE_CYCLES = 10.0


class LockWatch:
    """Follower of the lock state.

    Attributes:
        lock_state: at the stamp of the last released Status; UNKNOWN while the bus is silent.
        is_lock_message: the newest frame was a lock message. local_s: its time by the clock that times the frames.
        is_alive_message: the newest frame was of the message whose silence is reported.
    """

    def __init__(self, profile: CarProfile):
        self._profile = profile
        self._liveness = Liveness(profile)
        self._robot_session_id = 0
        self.is_lock_message, self.local_s = False, math.nan
        self.is_alive_message = False
        self._buses = StateBuses(profile)
        self._time = FrameTime()
        self._changes = LockChanges(profile, Refused())
        self._companions = Companions(profile.further)
        self._stops = StopWatch(profile.further)
        self._restart()

    def _restart(self) -> None:
        self.lock_state = LockState.UNKNOWN
        self._time.restart()
        self._decode = self._profile.decoder()
        self._companions.restart()
        self._stops.restart()
        self._frames: collections.deque[tuple[float, bytes]] = collections.deque(maxlen=_KEPT_FRAMES)
        self._changes = LockChanges(self._profile, self.refused)
        self._released: LockState | None = None

    @property
    def is_only_on_change(self) -> bool:
        """True if the state is sent only on change: a lost frame makes it unknown."""
        return self._profile.is_only_on_change

    @property
    def has_time(self) -> bool:
        """True if a frame has arrived since the start or since the adapter was reopened."""
        return not math.isnan(self._time.newest_s)

    @property
    def refused(self) -> Refused:
        """Rejected frames since the start."""
        return self._changes.refused

    def restart(self) -> None:
        """Restart after the adapter was reopened: its clock and the lock state are determined again."""
        self._restart()

    def forget_state(self) -> None:
        """Discard the state: a change may have been missed, and a state that is sent only on change is not repeated."""
        self._changes = LockChanges(self._profile, self.refused)
        self._released = None

    def frame(self, frame: CanFrame) -> None:
        """Add a frame, in the order of arrival."""
        self._buses.frame(frame)
        if frame.bus:
            self._beside(frame)
            return
        if not self._time.goes_on_with(frame):
            self._restart()
            self._time.begin(frame)
        local_s, was_set = self._time.frame(frame)
        if was_set:
            self._changes.begin_new_frames()
        reading = self._decode(frame.can_id, frame.is_extended, frame.data)
        self.is_lock_message, self.local_s = reading is not None, local_s
        if reading is not None:
            self._frames.append((local_s, frame.data))
            self._changes.follow(local_s, frame.arrival_s, reading, self._time.is_by_arrival)
        is_message = self._profile.is_message(frame.can_id, frame.is_extended)
        is_without_state = reading is None and self._profile.poll is None and is_message
        self.is_alive_message = self._profile.is_alive(frame.can_id, frame.is_extended)
        is_state = reading is not None and not self._changes.is_repeated
        self._liveness.frame(self.is_alive_message if self._profile.is_only_on_change else is_state, is_without_state)
        self._companion(frame, local_s)

    def _beside(self, frame: CanFrame) -> None:
        """Add a frame of a further bus. Its adapter has its own clock, so the frame gets the time of the first bus."""
        self.is_lock_message = self.is_alive_message = False
        if self.has_time:
            self.local_s = self._time.newest_s
            self._companion(frame, self.local_s)

    def _companion(self, frame: CanFrame, local_s: float) -> None:
        key = (frame.bus, frame.can_id, frame.is_extended)
        self._stops.frame(key, frame.data, local_s)
        for doubt in self._companions.frame(key, frame.data, local_s):
            self._changes.doubt(local_s, frame.arrival_s, doubt)

    def status(self, status: RobotStatus, arrival_s: float) -> None:
        """Add a Status, before waiting for the frames that precede it."""
        if status.robot_session_id != self._robot_session_id:
            self._robot_session_id = status.robot_session_id
            self._time = FrameTime()
            self._liveness = Liveness(self._profile)
            self._restart()
        if self._time.status(status, arrival_s):
            self._liveness = Liveness(self._profile)
            self._changes.begin_new_time()

    def has_caught_up(self) -> bool:
        """True if the frames up to the stamp of the Status have arrived, or cannot be expected."""
        time = self._time
        if self._liveness.is_silent or not time.is_ready:
            return True
        # If both clocks are the simulated one, the next frame is known to be later than the Status: all have arrived.
        cycle_s = min(time.gap_s, self._profile.cycle_time_s)
        return time.newest_robot_s >= time.stamp_s - cycle_s - _CATCH_UP_MARGIN_S

    def release(self, now_s: float) -> list[CarEvent]:
        """Return the unreleased events up to the stamp of the Status. now_s: laptop's clock."""
        self._liveness.observe(self._time.stamp_s, now_s)
        if self._liveness.silence_s > _MAX_FOLLOWED_SILENCE_S:
            self._restart()
        if self._profile.is_only_on_change and self._liveness.problem and not self._changes.waiting:
            self.forget_state()
        waiting, events = self._changes.waiting, []
        while waiting and self._time.is_ready and self._is_due(waiting[0]):
            change = waiting.popleft()
            self._released = change.reading.state
            if change.is_event:
                events.append(self._event(change))
        state = self._changes.first if self._released is None else self._released
        self.lock_state = LockState.UNKNOWN if self._liveness.problem else state
        return events

    def _is_due(self, change: Change) -> bool:
        if not change.is_timed:
            return True
        is_known = self._time.newest_s >= change.local_s + self._profile.further.settles_s
        return is_known and self._time.is_certain(change.local_s, change.arrival_s)

    @property
    def problem(self) -> str:
        """Current fault as one sentence, or empty."""
        silence = self._liveness.problem
        return (self._buses.elsewhere(is_silent=bool(silence)) or silence or self._time.problem
                or self._buses.several_channels)

    @property
    def signals(self) -> tuple[CarSignal, ...]:
        """Signals that stop the robot, as of the newest frame."""
        return self._stops.signals(self._time.newest_s)

    @property
    def notices(self) -> tuple[str, ...]:
        """Sentence for each further bus with the message of the state."""
        return self._buses.notices

    @property
    def clock_problem(self) -> str:
        """Reason why frames cannot be placed on the robot's clock; empty if they can."""
        return self._time.problem

    @property
    def stamps(self) -> StampKind | None:
        """Clock that times the frames, None before the first."""
        return self._time.stamps

    def _event(self, change: Change) -> CarEvent:
        reading = change.reading
        if not change.is_timed:
            return CarEvent(self._time.stamp_s, math.inf, reading.state, reading.source, change.doubt)
        time_s, told = self._time.to_robot(change.local_s), self._companions.told(change.local_s)
        # A cyclic message shows a change that happened at any time since the previous message.
        gap_s = time_s - self._time.to_robot(change.previous_local_s)
        vague = not self._profile.sent_on_change or gap_s > _LOST_CYCLES * self._profile.cycle_time_s
        spread_s = gap_s if vague and not self._profile.is_only_on_change else 0.0
        return CarEvent(time_s - spread_s / 2, self._time.sigma_with(spread_s), reading.state,
                        reading.source or told.source, change.doubt or told.doubt, self._evidence(change),
                        told.raw or self._raw(reading), told.key, reading.doors)

    def _raw(self, reading: LockReading) -> str:
        """Return the raw source of the lock message if the profile does not list it."""
        is_listed = reading.source or reading.source_raw is None
        return "" if is_listed else f"{self._profile.source_signal} = {reading.source_raw}"

    def _evidence(self, change: Change) -> tuple[str, ...]:
        """Return the frames around a change, with robot time, in candump's format."""
        around_s, frame_id = _EVIDENCE_CYCLES * self._profile.cycle_time_s, self._profile.message.frame_id
        return tuple(f"({self._time.to_robot(local_s):.4f}) {frame_id:03X}#{data.hex().upper()}"
                     for local_s, data in self._frames if abs(local_s - change.local_s) <= around_s)
