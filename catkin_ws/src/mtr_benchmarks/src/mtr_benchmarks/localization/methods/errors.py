"""Errors of one method in one drive: position of the key in the Car's frame against the truth."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Optional

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray
from mtr_core.se2 import Pose2
from mtr_simulation.physics.robot import shipped_robot

from ..drives.pose_track import PoseTrack, at, compose, wrapped
from ..drives.truth import DriveTruth

ROBOT = shipped_robot()
# An instant without an estimate within this time has no pose.
SILENT_S = 0.1
NAN = math.nan


class PoseErrors(NamedTuple):
    """Errors with one row for each 20 ms after the loop; angles in degrees.

    Attributes:
        key_m: position error of the key; NaN if the pose is invalid or missing for longer than SILENT_S.
        yaw_deg: error of the heading, signed.
        whitened: (n, 3), error of the pose in frame car, whitened by its covariance; NaN without a valid pose or
            covariance.
        standing, on_axis, beyond_m: see DriveTruth.
    """

    stamps_s: FloatArray
    key_m: FloatArray
    yaw_deg: FloatArray
    whitened: FloatArray
    standing: BoolArray
    on_axis: BoolArray
    beyond_m: FloatArray

    @property
    def nees(self) -> FloatArray:
        """Normalised squared error of each pose; with consistent covariances its mean over many drives is 3."""
        return np.sum(self.whitened ** 2, axis=1)


class MeasuredCar(NamedTuple):
    """Car in a method's map: pose, and covariance of x, y and heading in map."""

    pose: Pose2
    covariance: FloatArray


def errors_of(track: PoseTrack, car: MeasuredCar, truth: DriveTruth) -> PoseErrors:
    """Return the errors at each evaluated instant of the truth; a method without validity is evaluated within its own
    time span."""
    judged = truth.judged
    if track.valid is None:
        judged = judged & (truth.track.stamps_s >= track.stamps_s[0]) & (truth.track.stamps_s <= track.stamps_s[-1])
    stamps = truth.track.stamps_s[judged]
    measured = compose(car.pose.inverse(), at(track, stamps))
    true = truth.track.poses[judged]
    away = keys(measured) - keys(true)
    key_m = np.hypot(away[:, 0], away[:, 1])
    whitened = np.full((len(stamps), 3), NAN)
    nearest = np.clip(np.searchsorted(track.stamps_s, stamps), 0, len(track.stamps_s) - 1)
    if track.covariances is not None:
        whitened = whitened_errors(measured, true, joined(track.covariances[nearest], car, measured))
    if track.valid is not None:
        # An invalid or missing pose has no error.
        known = track.valid[nearest] & (silence_s(track.stamps_s, stamps) <= SILENT_S)
        key_m = np.where(known, key_m, NAN)
        whitened = np.where(known[:, np.newaxis], whitened, NAN)
    yaw = np.degrees(wrapped(measured[:, 2] - true[:, 2]))
    return PoseErrors(stamps, key_m, yaw, whitened, truth.standing[judged], truth.on_axis[judged],
                      truth.beyond_m[judged])


def silence_s(said_s: FloatArray, stamps_s: FloatArray) -> FloatArray:
    """Return the time from each stamp to the nearest estimate."""
    after = np.searchsorted(said_s, stamps_s)
    return np.minimum(np.abs(said_s[np.minimum(after, len(said_s) - 1)] - stamps_s),
                      np.abs(said_s[np.maximum(after - 1, 0)] - stamps_s))


def keys(poses: FloatArray) -> FloatArray:
    """Return the positions (n, 2) of the key for poses of base_link."""
    return poses[:, :2] + ROBOT.key.x_m * np.stack([np.cos(poses[:, 2]), np.sin(poses[:, 2])], axis=1)


def joined(covariances: FloatArray, car: MeasuredCar, poses_in_car: FloatArray) -> FloatArray:
    """Return covariances (n, 3, 3) of base_link in frame car from the covariances of base_link and the Car in map."""
    cos, sin = math.cos(car.pose.heading), math.sin(car.pose.heading)
    turn = np.array(((cos, sin, 0.0), (-sin, cos, 0.0), (0.0, 0.0, 1.0)))
    own = turn @ covariances @ turn.T
    # The Car's heading error acts with the robot's distance as lever arm.
    lever = np.tile(-turn, (len(poses_in_car), 1, 1))
    lever[:, 0, 2], lever[:, 1, 2] = poses_in_car[:, 1], -poses_in_car[:, 0]
    return own + lever @ car.covariance @ lever.transpose(0, 2, 1)


def whitened_errors(measured: FloatArray, true: FloatArray, covariances: FloatArray) -> FloatArray:
    """Return L^-1 e (n, 3) of poses (n, 3) with P = L L^T."""
    difference = measured - true
    difference[:, 2] = wrapped(difference[:, 2])
    return np.linalg.solve(np.linalg.cholesky(covariances), difference[:, :, np.newaxis])[:, :, 0]


def percentile(values: FloatArray, share: float = 95.0) -> Optional[float]:
    """Return the percentile of the known values; None if there are none."""
    known = values[np.isfinite(values)]
    return float(np.percentile(known, share)) if len(known) else None
