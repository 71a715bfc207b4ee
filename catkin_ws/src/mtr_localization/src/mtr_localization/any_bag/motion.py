"""Conversion of any odometry to wheel samples, and a gyro replacement for robots without one."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Dict, List, NamedTuple, Sequence, Tuple

from mtr_core.se2 import Pose2

from .errors import BagUnusable

# Noise of the wheel turn as a replacement of the gyro; an estimate. Calibrated tracks and skid-steered wheels deviate
# by some percent from their odometry, and randomly by a degree in a turn of 1 s.
WHEELS_TURN = {"gyro_scale_sigma": 0.05, "gyro_noise_radps_per_sqrt_hz": 0.017}
# A jump of the stamps by this much, forward or back, means that a clock was set.
JUMP_S = 5.0
MOVED_M, TURNED_RAD = 0.3, 0.3


class Sample(NamedTuple):
    """Pose in the frame of the odometry at a time in s; forward speed in m/s and turn rate in rad/s."""

    time_s: float
    pose: Pose2
    linear_mps: float
    angular_radps: float


class Sweep(NamedTuple):
    """Ranges of one scan in m, with its stamp in s, the angle between beams in rad and the range limits in m."""

    stamp_s: float
    angle_increment_rad: float
    range_min_m: float
    range_max_m: float
    ranges: Sequence[float]


def samples_of(poses: Sequence[Tuple[float, Pose2]]) -> List[Sample]:
    """Return samples with the speeds since the previous pose; repeated poses are dropped.

    Raises BagUnusable for a clock that was set, and for a robot that never moves, which does not reveal its motion.
    """
    samples: List[Sample] = []
    for time_s, pose in poses:
        if not samples:
            samples.append(Sample(time_s, pose, 0.0, 0.0))
            continue
        before = samples[-1]
        passed_s = time_s - before.time_s
        if not -JUMP_S < passed_s < JUMP_S:
            raise BagUnusable(f"The odometry's time jumps by {passed_s:.1f} s at {before.time_s:.1f} s; give a part of "
                              "the bag without the jump (rosbag filter).")
        if passed_s > 0.0:
            moved = before.pose.inverse() @ pose
            samples.append(Sample(time_s, pose, moved.x / passed_s, moved.heading / passed_s))
    return samples


def check_moves(samples: Sequence[Sample]) -> None:
    """Raise BagUnusable for a stationary robot, because a map requires several places."""
    first = samples[0].pose if samples else Pose2(0.0, 0.0, 0.0)
    moved = (first.inverse() @ sample.pose for sample in samples)
    if not any(math.hypot(each.x, each.y) > MOVED_M or abs(each.heading) > TURNED_RAD for each in moved):
        raise BagUnusable("The robot does not move in this bag, so it makes no map; give one of a drive, or --map.")


def check_same_time(stamps_s: Dict[str, float]) -> None:
    """Raise BagUnusable if topics start at very different times, because their clocks differ."""
    if stamps_s:
        (early, early_s), (late, late_s) = (pick(stamps_s.items(), key=lambda item: item[1]) for pick in (min, max))
        if late_s - early_s > JUMP_S:
            raise BagUnusable(f"The first stamps of {early} and {late} are {late_s - early_s:.1f} s apart; their "
                              "clocks differ, or one of them began later: give a part of the bag with both.")
