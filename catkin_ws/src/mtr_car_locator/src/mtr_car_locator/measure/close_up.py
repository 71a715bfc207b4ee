"""All returns of the drive round the Car, transformed by the adjustment of the localization map."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2

from ..scan import RangeBias, Returns
from ..surfels import rotated_back

# Largest distance of a corner of the Car from its guess: half its diagonal and the Operator's error.
HALF_SIDE_M = 4.5
# Lowest motion between sweeps, because a stationary robot sees the same; a drive has about 2500 sweeps of two LiDARs.
MIN_MOTION_M, MIN_TURN_RAD, MAX_SWEEPS = 0.005, 0.005, 10_000
# Columns of the rows of Sweeps.
_TIME, _ROBOT, _VIEWER, _IS_REAR, _COUNT, _COLUMNS = 0, slice(1, 4), slice(4, 6), 6, 7, 8


@dataclass(frozen=True)
class CloseUp:
    """Points (n, 2) in map and the unit vectors of their beams, away from the LiDAR."""

    points: FloatArray
    beams: FloatArray

    def in_frame(self, pose: Pose2) -> "CloseUp":
        """Return the returns relative to a pose in map."""
        return CloseUp(rotated_back(self.points - (pose.x, pose.y), pose.heading),
                       rotated_back(self.beams, pose.heading))


class WayRound:
    """Collects returns near a place in map, with poses before the adjustment of the map."""

    def __init__(self, x: float, y: float):
        self._centre = np.array([x, y])
        self._sweeps: List[Returns] = []
        self._last: Dict[Pose2, Pose2] = {}

    def add(self, seen: Returns, lidar: Pose2) -> None:
        """Add a sweep of the LiDAR with that mount, if the robot has moved since its last one."""
        last = self._last.get(lidar)
        if len(self._sweeps) >= MAX_SWEEPS or (last is not None and not _has_moved(last, seen.robot)):
            return
        self._last[lidar] = seen.robot
        near = np.all(np.abs(seen.points - self._centre) < HALF_SIDE_M, axis=1)
        self._sweeps.append(Returns(seen.points[near].astype(np.float32), seen.viewer, seen.time_s, seen.robot,
                                    seen.is_rear))

    def sweeps(self) -> "Sweeps":
        """Return everything collected so far."""
        if not self._sweeps:
            return Sweeps(np.empty((0, 2), np.float32), np.empty((0, _COLUMNS)))
        rows = [(sweep.time_s, sweep.robot.x, sweep.robot.y, sweep.robot.heading, *sweep.viewer, sweep.is_rear,
                 len(sweep.points)) for sweep in self._sweeps]
        return Sweeps(np.concatenate([sweep.points for sweep in self._sweeps]), np.array(rows, dtype=float))


@dataclass(frozen=True)
class Sweeps:
    """Returns of many sweeps as two arrays: thousands of objects would be slow to transfer to another process.

    Attributes:
        points: of all sweeps in sequence, (n, 2) in map, by the poses before the adjustment.
        rows: of each sweep: time in s, the robot's x, y and heading, the LiDAR's x and y, 1 for the rear LiDAR, number
            of its points.
    """

    points: FloatArray
    rows: FloatArray

    def close_up(self, key_frames: FloatArray, range_bias: RangeBias) -> Optional[CloseUp]:
        """Return the data collected between the first and the last key-frame; None without data.

        key_frames: rows (time in s, x, y, heading) after adjustment. Each sweep is transformed like the adjacent
        key-frames.
        """
        if len(self.rows) < 2 or len(key_frames) < 2:
            return None
        times = self.rows[:, _TIME]
        order = np.argsort(times, kind="stable")
        frames = key_frames[(key_frames[:, 0] >= times.min()) & (key_frames[:, 0] <= times.max())]
        if len(frames) < 2:
            return None
        changes = _changes(frames, times[order], self.rows[order, _ROBOT])
        counts = self.rows[:, _COUNT].astype(int)
        ends = np.cumsum(counts)
        moved = [_moved(self.points[ends[index] - counts[index]:ends[index]], self.rows[index], change, range_bias)
                 for index, change in zip(order, _interpolated(times[order], frames[:, 0], changes))
                 if frames[0, 0] <= times[index] <= frames[-1, 0]]
        return CloseUp(*(np.concatenate(columns) for columns in zip(*moved))) if moved else None


def _has_moved(last: Pose2, now: Pose2) -> bool:
    turn = abs((last.inverse() @ now).heading)
    return last.distance_to(now) >= MIN_MOTION_M or turn >= MIN_TURN_RAD


def _changes(frames: FloatArray, times_s: FloatArray, raw: FloatArray) -> FloatArray:
    """Return the correction (x, y, heading) of each key-frame relative to the robot's pose before the adjustment."""
    unwrapped = np.column_stack((raw[:, :2], np.unwrap(raw[:, 2])))
    before = _interpolated(frames[:, 0], times_s, unwrapped)
    changes = [Pose2(*frame[1:]) @ Pose2(*robot).inverse() for frame, robot in zip(frames, before)]
    rows = np.array([(change.x, change.y, change.heading) for change in changes])
    return np.column_stack((rows[:, :2], np.unwrap(rows[:, 2])))


def _interpolated(wanted_s: FloatArray, known_s: FloatArray, rows: FloatArray) -> FloatArray:
    return np.column_stack([np.interp(wanted_s, known_s, rows[:, column]) for column in range(3)])


def _moved(points: FloatArray, row: FloatArray, change: FloatArray,
           range_bias: RangeBias) -> Tuple[FloatArray, FloatArray]:
    bias_m = range_bias.of(bool(row[_IS_REAR]))
    away = points - row[_VIEWER]
    beams = rotated_back(away / np.maximum(np.linalg.norm(away, axis=1), 1e-6)[:, np.newaxis], -change[2])
    return rotated_back(points, -change[2]) + change[:2] - bias_m * beams, beams
