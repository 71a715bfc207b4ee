"""Wheels and gyro alone: what a robot knows without looking, with the gyro's bias measured whenever it stands."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np

from mtr_core.arrays import FloatArray

from ..drives.pose_track import PoseTrack, pose_track
from ..drives.sensor_log import SensorLog

# Standing: the wheels say nothing for this long.
STILL_S = 0.5
# The bias follows the mean of the last standstill's rates over about this time.
BIAS_MEMORY_S = 2.0


def dead_reckoned(log: SensorLog) -> PoseTrack:
    """Poses from the start, at each message of the wheels."""
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
    """The gyro's bias as known at each stamp from the standstills before it."""
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
