"""Time of a frame on the robot's clock, with its uncertainty; restarts when a clock was set."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.robot_status import RobotStatus

from ..can_frame import CanFrame
from .adapter_clock import AdapterClockMap, StampUnwrapper
from .arrival_clock import ArrivalClockMap
from .clock_map import LEAST_WAY_S, ClockMap
from .delay_watch import DelayWatch
from .ordered_map import OrderedClockMap, minutes_between
from .robot_clock import RobotClock, sent_s
from .stamp_kind import StampKind

# Adapters deliver frames in batches: every 16 ms with common USB chips, 20 ms in simulation.
_ADAPTER_STEP_S = 0.022
# Longest robot time for which an event waits for the decision between a clock step and late messages.
_MAX_DOUBT_S = 0.3
_UNMAPPED = "The clock of the CAN frames is not mapped to the robot's yet; this takes about two seconds."
_ROBOT_CLOCK_SET = ("The robot's clock was set; the clock of the CAN frames is mapped to it anew, which takes about "
                    "two seconds.")
_ADAPTER_CLOCK_SET = ("The clock of the CAN adapter jumped; it is mapped to the robot's anew, which takes about two "
                      "seconds.")
_DOUBTFUL = ("Frames or messages of the robot are late, or a clock was set; the time at which the locks changed is not "
             "known yet.")


class FrameTime:
    """Time base of one bus, updated with each frame and Status in the order of arrival. Local times are of the clock
    that stamps the frames.

    Attributes:
        stamp_s: robot's time up to which Statuses have arrived.
        newest_s: local time of the newest frame, NaN before the first.
        stamps: clock that times the frames, None before the first.
    """

    def __init__(self) -> None:
        self._robot_clock = RobotClock()
        self.stamp_s = -math.inf
        self.restart()

    def restart(self) -> None:
        """Restart after the adapter was reopened or a long silence of the frames: the clock map is estimated again."""
        self._map: ClockMap | None = None
        self._unwrapper = StampUnwrapper()
        self._delays = DelayWatch(_ADAPTER_STEP_S)
        self._why_unmapped = ""
        self._in_doubt_since_s = math.inf
        self._is_stamped = self._is_another_clock = False
        self.stamps: StampKind | None = None
        self.newest_s = math.nan

    def goes_on_with(self, frame: CanFrame) -> bool:
        """False for the first frame, and if the adapter starts or stops to supply stamps."""
        return self._map is not None and frame.is_stamped == self._is_stamped

    def begin(self, frame: CanFrame) -> None:
        """Start with the first frame since a restart."""
        self._is_stamped = frame.is_stamped
        self._map = self._new_map()

    def frame(self, frame: CanFrame) -> tuple[float, bool]:
        """Return the frame's local time, and True if the adapter's clock was set before it."""
        local_s, was_set = self._local_s(frame), False
        self.stamps = frame.stamps
        if self._is_by_adapter and self._delays.add(local_s, frame.arrival_s):
            was_set = True
            self._unwrapper = StampUnwrapper()
            local_s = self._local_s(frame)
            self._delays = DelayWatch(_ADAPTER_STEP_S)
            self._begin_anew(_ADAPTER_CLOCK_SET)
            self.newest_s = math.nan
        # A late frame does not set the time back; NaN before the first frame.
        self.newest_s = max(local_s, self.newest_s)
        if self._map is not None:
            self._map.frame(local_s)
        return local_s, was_set

    def status(self, status: RobotStatus, arrival_s: float) -> bool:
        """Add a Status; return True if the robot's clock was set before it."""
        was_set = self._robot_clock.status(status, arrival_s)
        if was_set:
            self.stamp_s = -math.inf
            self._begin_anew(_ROBOT_CLOCK_SET)
        # A pose that is newer than its Status was measured before the clock was set back.
        stamp_s = min(status.stamp_s, sent_s(status))
        if stamp_s > self.stamp_s and self._map is not None:
            self._order(sent_s(status))
            self._map.status(sent_s(status), arrival_s)
        self.stamp_s = max(self.stamp_s, stamp_s)
        return was_set

    @property
    def is_ready(self) -> bool:
        """True if to_robot is valid."""
        return self._map is not None and self._map.is_ready

    def sigma_with(self, spread_s: float) -> float:
        """1 sigma of a mapped time with a uniform spread, NaN without a map."""
        if self._map is None or self.stamps is None:
            return math.nan
        way_s = LEAST_WAY_S if self._is_by_adapter else 0.0
        return math.hypot(self._map.sigma_s, way_s, self._map.rate * self.stamps.sigma_s, spread_s / math.sqrt(12.0))

    def to_robot(self, local_s: float) -> float:
        """Return the robot's time at a local time; valid only if is_ready."""
        return math.nan if self._map is None else self._map.to_robot(local_s)

    @property
    def gap_s(self) -> float:
        """Interval of the frames if both clocks are the same, else infinite."""
        return self._map.gap_s if isinstance(self._map, OrderedClockMap) else math.inf

    @property
    def newest_robot_s(self) -> float:
        """Robot's time of the newest frame; valid only if is_ready."""
        if isinstance(self._map, OrderedClockMap):
            return self.newest_s + self._map.whole_s
        return self.to_robot(self.newest_s)

    def is_certain(self, local_s: float, arrival_s: float) -> bool:
        """True after a frame and a Status prove that no clock was set back before this time."""
        time_s = self.to_robot(local_s)
        if not time_s <= self.stamp_s:
            return False
        is_certain = (time_s <= self._robot_clock.certain_s
                      and (not self._is_by_adapter or arrival_s <= self._delays.in_time_arrival_s))
        self._in_doubt_since_s = math.inf if is_certain else min(self._in_doubt_since_s, self.stamp_s)
        return is_certain

    @property
    def is_by_arrival(self) -> bool:
        """True if frames are stamped when they are read, so that a frame that waited is late."""
        return not self._is_stamped and self._robot_clock.is_real_time

    @property
    def problem(self) -> str:
        """One sentence, or empty."""
        if not self.is_ready:
            return self._why_unmapped or _UNMAPPED
        return _DOUBTFUL if self.stamp_s - self._in_doubt_since_s > _MAX_DOUBT_S else ""

    @property
    def _is_by_adapter(self) -> bool:
        return self._is_stamped and self._robot_clock.is_real_time

    def _order(self, stamp_s: float) -> None:
        """Select the map: by the order of the stamps if both clocks are the simulated one, else by the order of
        arrival."""
        if isinstance(self._map, OrderedClockMap):
            if not self._map.is_one_clock:
                self._map = self._map.by_arrival
                self._is_another_clock = True
        elif self._is_stamped and self._robot_clock.is_simulated and not self._is_another_clock:
            whole_s = minutes_between(self.newest_s, stamp_s)
            if whole_s is not None:
                self._map = OrderedClockMap(whole_s)

    def _new_map(self) -> ClockMap:
        return AdapterClockMap() if self._is_stamped else ArrivalClockMap()

    def _local_s(self, frame: CanFrame) -> float:
        if frame.stamp_s is not None:
            return frame.stamp_s
        return frame.arrival_s if frame.stamp_ms is None else self._unwrapper.unwrap(frame.stamp_ms)

    def _begin_anew(self, why: str) -> None:
        if self._map is not None:
            self._map = self._new_map()
        self._why_unmapped, self._in_doubt_since_s = why, math.inf
