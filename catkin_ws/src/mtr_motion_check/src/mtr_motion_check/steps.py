"""Divides a recorded drive into steps of half a second, with each sensor's motion."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import List, Optional, Sequence

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2
from mtr_description.mounts import LidarMounts

from .matching import match
from .recording import ImuSample, Recording, ScanSample, WheelSample

STEP_S = 0.5
# Scans of the two LiDARs belong to a step if their times differ by at most this; a turn at 25 Hz lasts 0.04 s.
MAX_APART_S = 0.06
# Delay of a step after its end, for the slowest sensor.
LATE_S = 0.2


@dataclass(frozen=True)
class Step:
    """base_from_base of half a second by each sensor; None if a sensor does not determine it.

    Attributes:
        duration_s: between the scans.
        wheels: by the wheels' odometry.
        front, rear: by scan matching, with the mounts of the robot's description.
        gyro_rad: rotation by the gyro, its bias included.
    """

    duration_s: float
    wheels: Pose2
    front: Optional[Pose2]
    rear: Optional[Pose2]
    gyro_rad: Optional[float]


@dataclass
class Steps:
    """Steps of a growing recording; earlier matches are reused.

    Attributes:
        mounts: of the LiDARs by the robot's description.
        made: the steps so far, including steps at standstill.
    """

    mounts: LidarMounts
    made: List[Step] = field(default_factory=list)
    _from: Optional[ScanSample] = None
    _rear_from: Optional[ScanSample] = None

    def extend(self, recording: Recording) -> None:
        """Add the steps of the recording's new samples."""
        for scan in recording.front:
            if self._from is None:
                self._take(scan, recording)
            elif scan.time_s >= self._from.time_s + STEP_S - 1e-6:
                if not covers(recording.wheels, scan.time_s + LATE_S):
                    return
                self._add(scan, recording)
                self._take(scan, recording)

    def _take(self, scan: ScanSample, recording: Recording) -> None:
        self._from, self._rear_from = scan, nearest(recording.rear, scan.time_s)

    def _add(self, scan: ScanSample, recording: Recording) -> None:
        start, rear = self._from, nearest(recording.rear, scan.time_s)
        if start is None:
            return
        duration_s = scan.time_s - start.time_s
        self.made.append(Step(
            duration_s, wheels_between(recording.wheels, start.time_s, scan.time_s),
            base_motion(self.mounts.front, start, scan, duration_s),
            base_motion(self.mounts.rear, self._rear_from, rear, duration_s),
            gyro_between(recording.imu, start.time_s, scan.time_s)))


def base_motion(mount: Optional[Pose2], first: Optional[ScanSample], second: Optional[ScanSample],
                duration_s: float) -> Optional[Pose2]:
    """Return first_from_second of base_link by a LiDAR, scaled to the duration.

    The two LiDARs are not synchronous, and one may lose a scan: the observed motion is scaled to the time of the step.
    """
    if mount is None or first is None or second is None or second.time_s <= first.time_s:
        return None
    lidar = match(first.points_m, second.points_m)
    if lidar is None:
        return None
    base, stretch = mount @ lidar @ mount.inverse(), duration_s / (second.time_s - first.time_s)
    return Pose2(stretch * base.x, stretch * base.y, stretch * base.heading)


def nearest(scans: Sequence[ScanSample], time_s: float) -> Optional[ScanSample]:
    """Return the scan that belongs to this time."""
    best = min(scans, key=lambda scan: abs(scan.time_s - time_s), default=None)
    return best if best and abs(best.time_s - time_s) <= MAX_APART_S else None


def covers(wheels: Sequence[WheelSample], time_s: float) -> bool:
    """Return True if the continuous wheel data extends to this time."""
    return bool(wheels) and wheels[-1].time_s >= time_s


def wheels_between(wheels: Sequence[WheelSample], start_s: float, end_s: float) -> Pose2:
    """Return start_from_end by the wheels' velocities, each of which applies to the time before its stamp."""
    pose, before_s = Pose2(0.0, 0.0, 0.0), start_s
    for sample in wheels:
        if sample.time_s > start_s:
            until_s = min(sample.time_s, end_s)
            turn = sample.angular_radps * (until_s - before_s)
            distance = sample.linear_mps * (until_s - before_s)
            pose = pose @ Pose2(0.0, 0.0, 0.5 * turn) @ Pose2(distance, 0.0, 0.5 * turn)
            before_s = until_s
            if sample.time_s >= end_s:
                break
    return pose


def gyro_between(imu: Sequence[ImuSample], start_s: float, end_s: float) -> Optional[float]:
    """Return the rotation by the gyro; None without samples before and after."""
    times: FloatArray = np.array([sample.time_s for sample in imu])
    if not len(times) or times[0] > start_s or times[-1] < end_s:
        return None
    rates = np.array([sample.rate_radps[2] for sample in imu])
    turned = np.concatenate([[0.0], np.cumsum(rates[1:] * np.diff(times))])
    first, last = np.interp([start_s, end_s], times, turned)
    return float(last - first)
