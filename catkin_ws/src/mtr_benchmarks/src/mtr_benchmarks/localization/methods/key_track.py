"""Errors of the key at each estimate of this system against the truth, without the Car locator.

Frame map is aligned with the truth by the adjusted key frames of the loop, as if the Car had been located without
error.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import NamedTuple

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray

from ..drives.pose_track import PoseTrack, aligned, at, compose, read_columns
from ..drives.recording import BAG
from ..drives.truth import DriveTruth
from .errors import ROBOT, keys
from .this_system import key_frames, mapped, read_replayed

REPLAY, TRAJECTORY = "replay", "trajectory.csv"


class KeyTrack(NamedTuple):
    """Errors with one row for each estimate.

    Attributes:
        error_m: position error of the key.
        sigma_m: sigma of the key's position in the direction of that error, from the estimate's covariance.
        valid: the estimate may be used.
        mode: mode of LocalizedPose.
    """

    stamps_s: FloatArray
    error_m: FloatArray
    sigma_m: FloatArray
    valid: BoolArray
    mode: FloatArray


def run_key_track(folder: pathlib.Path, truth: DriveTruth) -> KeyTrack:
    """Run localization on the drive in a folder.

    Raises:
        NoMap: the drive gave no map.
        SystemFailure: localization gave no result.
    """
    out = folder / REPLAY
    mapped(folder / BAG, out)
    mode = read_columns(out / TRAJECTORY)["mode"]
    return key_track(read_replayed(out / TRAJECTORY), key_frames(out), truth.track, mode)


def key_track(track: PoseTrack, frames: PoseTrack, true: PoseTrack, mode: FloatArray) -> KeyTrack:
    """Return the errors of a track with covariances.

    The truth is interpolated at the estimates' stamps, and not vice versa, because an estimate jumps when the robot is
    found.
    """
    assert track.covariances is not None and track.valid is not None
    map_from_car = aligned(frames.poses, at(true, frames.stamps_s)).inverse()
    away = keys(track.poses) - keys(compose(map_from_car, at(true, track.stamps_s)))
    error_m = np.hypot(away[:, 0], away[:, 1])
    return KeyTrack(track.stamps_s, error_m, _sigma(track.covariances, track.poses[:, 2], away, error_m), track.valid,
                    mode)


def _sigma(covariances: FloatArray, headings: FloatArray, away: FloatArray, error_m: FloatArray) -> FloatArray:
    lever = np.tile(np.eye(2, 3), (len(headings), 1, 1))
    lever[:, 0, 2], lever[:, 1, 2] = -ROBOT.key.x_m * np.sin(headings), ROBOT.key.x_m * np.cos(headings)
    direction = away / np.maximum(error_m, 1e-9)[:, np.newaxis]
    variance = np.einsum("ni,nij,njk,nlk,nl->n", direction, lever, covariances, lever, direction)
    return np.sqrt(np.maximum(variance, 0.0))
