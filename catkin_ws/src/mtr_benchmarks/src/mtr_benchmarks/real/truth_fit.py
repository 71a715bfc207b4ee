"""How a trajectory lies to an independent truth that was measured at another point of the robot, on another clock.

Where the truth's frame, its point on the robot and its clock are not known, they are fitted on one part of a recording
and scored on another: each method under the same fit, so that none is favoured by it.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from mtr_core.arrays import BoolArray, FloatArray
from mtr_core.se2 import Pose2

from ..localization.drives.pose_track import PoseTrack, aligned, at, compose

# Truth that is off by more than this counts less: its sensor has outliers.
OUTLIER_M = 0.05
MAX_DELAY_S = 0.5
# Fewer cannot carry six unknowns.
MIN_POINTS = 20


class TruthFit(NamedTuple):
    """truth_from_map, the truth's point on the robot in m, and by how many s the truth's stamps are late."""

    frame: Pose2
    lever_x_m: float
    lever_y_m: float
    delay_s: float

    def positions(self, track: PoseTrack, stamps_s: FloatArray) -> FloatArray:
        """Where the truth's sensor (n, 2) is by the track at the truth's stamps."""
        poses = compose(self.frame, at(track, stamps_s - self.delay_s))
        cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        moved: FloatArray = poses[:, :2] + np.stack([cos * self.lever_x_m - sin * self.lever_y_m,
                                                     sin * self.lever_x_m + cos * self.lever_y_m], axis=1)
        return moved


def fit(track: PoseTrack, stamps_s: FloatArray, positions: FloatArray) -> TruthFit:
    """The fit in the sense of least squares with outliers. ValueError when there are too few points.

    Args:
        stamps_s, positions: (n) in s and (n, 2) in m, of the truth.
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
    """Distances (n) between track and truth at the truth's stamps within the drive."""
    inside = within(track, stamps_s)
    off: FloatArray = np.linalg.norm(found.positions(track, stamps_s[inside]) - positions[inside], axis=1)
    return off


def within(track: PoseTrack, stamps_s: FloatArray) -> BoolArray:
    """True where the track has poses, whatever the delay is."""
    first_s, last_s = track.stamps_s[0] + MAX_DELAY_S, track.stamps_s[-1] - MAX_DELAY_S
    inside: BoolArray = (stamps_s >= first_s) & (stamps_s <= last_s)
    return inside


def _fit_of(values: FloatArray) -> TruthFit:
    return TruthFit(Pose2(*values[:3]), values[3], values[4], values[5])
