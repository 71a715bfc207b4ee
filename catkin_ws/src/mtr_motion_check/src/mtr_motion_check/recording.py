"""Sensor data of a driven robot as plain types; times in s of the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import List, NamedTuple, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

Vector = Tuple[float, ...]
# Below these speeds a wheel counts as stopped.
STANDING_MPS, STANDING_RADPS = 0.02, 0.04


class ScanSample(NamedTuple):
    """One sweep: time of its middle, and its hits, (n, 2) in m in the LiDAR's own frame."""

    time_s: float
    points_m: FloatArray


class WheelSample(NamedTuple):
    """Velocity of base_link by the wheels."""

    time_s: float
    linear_mps: float
    angular_radps: float

    def moves(self) -> bool:
        """True if the wheels turn."""
        return abs(self.linear_mps) > STANDING_MPS or abs(self.angular_radps) > STANDING_RADPS


class SentSample(NamedTuple):
    """Forward velocity that drive control sent to the wheels."""

    time_s: float
    linear_mps: float


class ImuSample(NamedTuple):
    """Rotation rates about the IMU's axes, and specific force along them; every node assumes z is up."""

    time_s: float
    rate_radps: Vector
    force_mps2: Vector


@dataclass
class Recording:
    """All samples in the order of arrival; a robot without a rear LiDAR has no rear scans."""

    front: List[ScanSample] = field(default_factory=list)
    rear: List[ScanSample] = field(default_factory=list)
    wheels: List[WheelSample] = field(default_factory=list)
    imu: List[ImuSample] = field(default_factory=list)
    sent: List[SentSample] = field(default_factory=list)

    def copy(self) -> "Recording":
        """Return a snapshot, which further samples do not change."""
        return Recording(list(self.front), list(self.rear), list(self.wheels), list(self.imu), list(self.sent))

    def until(self, time_s: float) -> "Recording":
        """Return the samples up to this time."""
        return Recording([sample for sample in self.front if sample.time_s <= time_s],
                         [sample for sample in self.rear if sample.time_s <= time_s],
                         [sample for sample in self.wheels if sample.time_s <= time_s],
                         [sample for sample in self.imu if sample.time_s <= time_s],
                         [sample for sample in self.sent if sample.time_s <= time_s])

    def motion_s(self) -> float:
        """Return the duration of the wheels' motion."""
        return sum(after.time_s - before.time_s for before, after in zip(self.wheels, self.wheels[1:]) if after.moves())

    def motion_start_s(self) -> Optional[float]:
        """Return the time of the wheels' first motion; None before it."""
        return next((sample.time_s for sample in self.wheels if sample.moves()), None)


class Sweep(NamedTuple):
    """Sweep of a message or a simulated scan: time of the first beam in s, angles in rad, ranges in m."""

    stamp_s: float
    angle_min_rad: float
    angle_increment_rad: float
    time_increment_s: float
    range_min_m: float
    range_max_m: float
    ranges_m: FloatArray


def scan_sample(sweep: Sweep) -> ScanSample:
    """Return the sweep's hits; beams without one are omitted."""
    ranges = np.asarray(sweep.ranges_m, dtype=np.float64)
    angles = sweep.angle_min_rad + sweep.angle_increment_rad * np.arange(len(ranges))
    with np.errstate(invalid="ignore"):
        hits = np.isfinite(ranges) & (ranges >= sweep.range_min_m) & (ranges <= sweep.range_max_m)
    middle_s = sweep.stamp_s + 0.5 * sweep.time_increment_s * len(ranges)
    directions = np.stack([np.cos(angles[hits]), np.sin(angles[hits])], axis=1)
    return ScanSample(middle_s, ranges[hits, np.newaxis] * directions)
