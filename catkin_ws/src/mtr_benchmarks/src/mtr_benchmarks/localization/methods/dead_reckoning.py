"""Odometry of wheels and gyro without LiDAR; the gyro's bias is measured at each standstill."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np

from mtr_core.arrays import FloatArray

from ..drives.pose_track import PoseTrack, pose_track
from ..drives.sensor_log import SensorLog

# The robot counts as stopped after the wheels have been at rest for this time.
STILL_S = 0.5
# Time constant with which the bias follows the rates at standstill.
BIAS_MEMORY_S = 2.0


def dead_reckoned(log: SensorLog) -> PoseTrack:
    """Return the poses from the start, at each message of the wheels."""
    stamps, speeds = log.wheels.T
    rates = np.interp(stamps, *log.gyro.T)
    periods = np.diff(stamps, prepend=stamps[0])
    turns = (rates - _bias(stamps, speeds, rates)) * periods
    headings = np.cumsum(turns)
    middles = headings - 0.5 * turns
    steps = speeds * periods
    x, y = np.cumsum(steps * np.cos(middles)), np.cumsum(steps * np.sin(middles))
    return pose_track(stamps, np.stack([x, y, headings], axis=1))


def _bias(stamps: FloatArray, speeds: FloatArray, rates: FloatArray) -> FloatArray:
    """Return the gyro's bias at each stamp, from the standstills before it."""
    bias, count, still_since = 0.0, 0.0, stamps[0]
    known = np.zeros(len(stamps))
    longest = BIAS_MEMORY_S / float(np.median(np.diff(stamps)))
    for index, (stamp, speed, rate) in enumerate(zip(stamps, speeds, rates)):
        if speed or abs(rate - bias) > math.radians(2.0):
            still_since = stamp
        elif stamp - still_since > STILL_S:
            count = min(count + 1.0, longest)
            bias += (rate - bias) / count
        known[index] = bias
    return known
