"""Poses over time from any method, and the alignment of two sets of poses."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
import pathlib
from typing import Dict, NamedTuple, Optional

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray
from mtr_core.se2 import Pose2


class PoseTrack(NamedTuple):
    """Poses of base_link in map: stamps (n) in s, poses (n, 3) in m and rad with unwrapped headings.

    covariances (n, 3, 3) and valid (n) are None if the method does not provide them.
    """

    stamps_s: FloatArray
    poses: FloatArray
    covariances: Optional[FloatArray] = None
    valid: Optional[BoolArray] = None


def pose_track(stamps_s: FloatArray, poses: FloatArray, covariances: Optional[FloatArray] = None,
               valid: Optional[BoolArray] = None) -> PoseTrack:
    """Return a track with unwrapped headings."""
    unwrapped = np.array(poses, dtype=float)
    unwrapped[:, 2] = np.unwrap(unwrapped[:, 2])
    return PoseTrack(np.asarray(stamps_s, dtype=float), unwrapped, covariances, valid)


def read_columns(path: pathlib.Path) -> Dict[str, FloatArray]:
    """Return the columns of a CSV file of numbers by name."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        header = next(rows)
        values = np.array([[float(value) for value in row] for row in rows])
    return dict(zip(header, values.reshape(-1, len(header)).T))


def at(track: PoseTrack, stamps_s: FloatArray) -> FloatArray:
    """Return the poses (n, 3) at the stamps, by linear interpolation."""
    return np.stack([np.interp(stamps_s, track.stamps_s, track.poses[:, column]) for column in range(3)], axis=1)


def compose(first: Pose2, poses: FloatArray) -> FloatArray:
    """Return first @ pose for each pose."""
    cos, sin = math.cos(first.heading), math.sin(first.heading)
    x, y, heading = poses.T
    return np.stack([first.x + cos * x - sin * y, first.y + sin * x + cos * y, heading + first.heading], axis=1)


def aligned(measured: FloatArray, true: FloatArray) -> Pose2:
    """Return the transform true_from_measured that minimizes the squared distances between the positions."""
    middle, target = measured[:, :2].mean(axis=0), true[:, :2].mean(axis=0)
    a, b = measured[:, :2] - middle, true[:, :2] - target
    turn = math.atan2(float(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])), float(np.sum(a * b)))
    cos, sin = math.cos(turn), math.sin(turn)
    return Pose2(target[0] - cos * middle[0] + sin * middle[1], target[1] - sin * middle[0] - cos * middle[1], turn)


def wrapped(angles_rad: FloatArray) -> FloatArray:
    """Return angles wrapped to half a turn on either side."""
    return np.remainder(angles_rad + math.pi, 2.0 * math.pi) - math.pi
