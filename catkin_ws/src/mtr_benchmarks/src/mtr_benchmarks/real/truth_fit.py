"""Alignment of a trajectory with an independent truth that was measured at another point of the robot, on another
clock.

If the truth's frame, its point on the robot and its clock are unknown, they are fitted on one part of a recording. The
errors are evaluated on another part. All methods use the same fit, so that none is favoured.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from mtr_core.arrays import BoolArray, FloatArray
from mtr_core.se2 import Pose2

from ..localization.drives.pose_track import PoseTrack, aligned, at, compose

# Deviations above this limit have less weight, because the truth's sensor has outliers.
OUTLIER_M = 0.05
MAX_DELAY_S = 0.5
# Least number of points for six unknowns.
MIN_POINTS = 20


class TruthFit(NamedTuple):
    """truth_from_map, the truth's point on the robot in m, and the delay of the truth's stamps in s."""

    frame: Pose2
    lever_x_m: float
    lever_y_m: float
    delay_s: float

    def positions(self, track: PoseTrack, stamps_s: FloatArray) -> FloatArray:
        """Return the positions (n, 2) of the truth's sensor according to the track, at the truth's stamps."""
        poses = compose(self.frame, at(track, stamps_s - self.delay_s))
        cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        moved: FloatArray = poses[:, :2] + np.stack([cos * self.lever_x_m - sin * self.lever_y_m,
                                                     sin * self.lever_x_m + cos * self.lever_y_m], axis=1)
        return moved


def fit(track: PoseTrack, stamps_s: FloatArray, positions: FloatArray) -> TruthFit:
    """Return the robust least-squares fit.

    Args:
        stamps_s, positions: (n) in s and (n, 2) in m, of the truth.

    Raises:
        ValueError: there are too few points.
    """
    inside = within(track, stamps_s)
    if inside.sum() < MIN_POINTS:
        raise ValueError(f"Only {inside.sum()} positions of the truth lie within the drive; {MIN_POINTS} are needed.")
    stamps_s, positions = stamps_s[inside], positions[inside]
    first = aligned(at(track, stamps_s), positions)
    solved = least_squares(lambda values: (_fit_of(values).positions(track, stamps_s) - positions).ravel(),
                           [first.x, first.y, first.heading, 0.0, 0.0, 0.0], loss="soft_l1", f_scale=OUTLIER_M,
                           x_scale=[1.0, 1.0, 0.1, 0.1, 0.1, 0.05])
    return _fit_of(solved.x)


def errors_m(found: TruthFit, track: PoseTrack, stamps_s: FloatArray, positions: FloatArray) -> FloatArray:
    """Return the distances (n) between track and truth at the truth's stamps within the drive."""
    inside = within(track, stamps_s)
    off: FloatArray = np.linalg.norm(found.positions(track, stamps_s[inside]) - positions[inside], axis=1)
    return off


def within(track: PoseTrack, stamps_s: FloatArray) -> BoolArray:
    """Return True for stamps at which the track has poses, whatever the delay is."""
    first_s, last_s = track.stamps_s[0] + MAX_DELAY_S, track.stamps_s[-1] - MAX_DELAY_S
    inside: BoolArray = (stamps_s >= first_s) & (stamps_s <= last_s)
    return inside


def _fit_of(values: FloatArray) -> TruthFit:
    return TruthFit(Pose2(*values[:3]), values[3], values[4], values[5])
