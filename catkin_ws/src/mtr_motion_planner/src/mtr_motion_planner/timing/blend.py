"""Overlap of the turns on the spot at a drive's ends with the drive, to save time.

The robot starts to drive before it faces its path, and turns away from it before it has stopped. Speeds and yaw rates
of the motions are added, and the resulting path is integrated, including sideways slip.
"""
# SPDX-License-Identifier: Apache-2.0
import itertools
from dataclasses import dataclass
from typing import Iterator, List, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray, IntArray
from mtr_core.se2 import Pose2

from ..limits import MotionLimits
from ..parameters import Slip
from .motion import CurveMotion, PlannedMotion
from .speeds import SAMPLE_S
from .trajectory import Trajectory

# Maximum overlap of the turns before and after the drive. In an overlap of 1.8 s the robot slides 2 cm farther sideways
# than calculated. The drive compensates this at its start, but at its end a correction of 4.5 s would be necessary.
FIRST_S, LAST_S = 2.2, 1.6
STEP_S = 0.2
# Number of overlap times per turn that are combined.
CHOICES = 4
# Sampled rates may exceed the limits by this factor; drive control's limits are above the planner's.
SAMPLING_SHARE = 1.03
FIRST, DRIVE, LAST = range(3)


@dataclass(frozen=True)
class Turns:
    """A turn on the spot, a drive and another turn on the spot; None for a turn that is not needed."""

    first: Optional[Trajectory]
    drive: Trajectory
    last: Optional[Trajectory]

    @property
    def duration_s(self) -> float:
        """Time without overlap."""
        return sum(part.duration_s for part in (self.first, self.drive, self.last) if part)


@dataclass(frozen=True)
class Blend(PlannedMotion):
    """Overlapping motions of some turns. It cannot be retimed in the middle."""

    drive: CurveMotion
    trajectory: Trajectory

    @property
    def length_m(self) -> float:
        """Path length of the turn centre."""
        return self.drive.length_m

    def timed(self, limits: MotionLimits, max_speed: float, start_speed: float = 0.0) -> Trajectory:
        """Return the trajectory from rest, as constructed."""
        return self.trajectory

    def lag(self, error: Pose2) -> float:
        """Return the distance in m by which the robot is behind."""
        return self.drive.lag(error)

    def from_way(self, way: float) -> None:
        """Return None, because the rest needs another plan."""


def overlaps_of(turns: Turns, limits: MotionLimits, slip: Slip) -> Iterator[Tuple[float, float]]:
    """Yield pairs of overlap times of both turns within the limits, the longest first."""
    def keep(pair: Tuple[float, float]) -> bool:
        return keeps(overlapped(turns, pair, slip)[0], limits)

    firsts = [time for time in _times(turns.first, FIRST_S) if keep((time, 0.0))][:CHOICES]
    lasts = [time for time in _times(turns.last, LAST_S) if keep((0.0, time))][:CHOICES]
    pairs = itertools.product([*firsts, 0.0], [*lasts, 0.0])
    return (pair for pair in sorted(pairs, key=sum, reverse=True)[:-1] if keep(pair))


def _times(turn: Optional[Trajectory], max_s: float) -> List[float]:
    return np.arange(min(turn.duration_s, max_s), 0.0, -STEP_S).tolist() if turn else []


def overlapped(turns: Turns, overlap_s: Tuple[float, float], slip: Slip, begin: complex = 0j
               ) -> Tuple[Trajectory, complex]:
    """Return the overlapping motions from x + iy, and the lateral offset that the first turn adds to the drive."""
    drive, timeline = turns.drive, _timeline_of(turns, overlap_s)
    heading = timeline.spread(drive.poses[:, 2], DRIVE)
    linear, angular, ways = (timeline.spread(row, DRIVE) for row in (drive.linear, drive.angular, drive.ways))
    for which, turn in ((FIRST, turns.first), (LAST, turns.last)):
        if turn:
            turned = timeline.spread(turn.poses[:, 2], which)
            heading = heading + turned - (turned[-1] if which == FIRST else turned[0])
            angular = angular + timeline.spread(turn.angular, which)
    aside = angular * (slip.acceleration_slip_s2 * np.gradient(linear, SAMPLE_S)
                       - slip.curve_slip_s2 * linear * np.abs(angular))
    steps = np.sign(linear.sum()) * np.diff(ways) + 0.5j * SAMPLE_S * (aside[1:] + aside[:-1])
    places = np.concatenate(([0.0], np.cumsum(steps * np.exp(0.5j * (heading[1:] + heading[:-1])))))
    poses = np.column_stack((begin.real + places.real, begin.imag + places.imag, heading))
    done = timeline.starts[FIRST] + timeline.lengths[FIRST] - 1 if turns.first else timeline.starts[DRIVE]
    alone = drive.poses[np.clip(done - timeline.starts[DRIVE], 0, len(drive.ways) - 1), :2] - drive.poses[0, :2]
    return Trajectory(ways, poses, linear, angular, drive.length_m), places[done] - complex(*alone)


@dataclass(frozen=True)
class _Timeline:
    """First sample and number of samples of the first turn, the drive and the last turn on one axis of time."""

    starts: IntArray
    lengths: List[int]

    def spread(self, values: FloatArray, which: int) -> FloatArray:
        """Return samples of one motion over the whole time; outside the motion its end values apply."""
        count = int(max(start + length for start, length in zip(self.starts, self.lengths)))
        before, after = self.starts[which], count - self.starts[which] - len(values)
        return np.concatenate((np.full(before, values[0]), values, np.full(after, values[-1])))


def _timeline_of(turns: Turns, overlap_s: Tuple[float, float]) -> _Timeline:
    before_s, after_s = (max(0.0, turn.duration_s - overlap) if turn else 0.0
                         for turn, overlap in zip((turns.first, turns.last), overlap_s))
    starts = np.round(np.array([0.0, before_s, before_s + turns.drive.duration_s + after_s]) / SAMPLE_S).astype(int)
    lengths = [len(part.ways) if part else 1 for part in (turns.first, turns.drive, turns.last)]
    starts[LAST] -= lengths[LAST] - 1
    # The turn at the end may be longer than everything before it.
    starts -= min(0, starts[LAST])
    return _Timeline(starts, lengths)


def keeps(trajectory: Trajectory, limits: MotionLimits) -> bool:
    """Return True if yaw rate, angular and lateral acceleration are within the limits."""
    return bool((np.abs(trajectory.angular) <= SAMPLING_SHARE * limits.max_angular_radps).all()
                and (np.abs(np.diff(trajectory.angular)) <=
                     SAMPLING_SHARE * SAMPLE_S * limits.angular_acceleration_radps2).all()
                and (np.abs(trajectory.linear * trajectory.angular) <=
                     SAMPLING_SHARE * limits.lateral_acceleration_mps2).all())
