"""Reads the truth of one drive from its files."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
from typing import Any, Dict, NamedTuple

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray
from mtr_core.se2 import Pose2

from .pattern import AXIS, AXIS_SPEED_MPS
from .pose_track import PoseTrack, pose_track, read_columns
from .recording import META, TRUTH

# The new map takes effect some seconds after the end of the loop; the robot is stopped until then.
EFFECT_S = 3.5
MOVING_SHARE = 0.9


class DriveTruth(NamedTuple):
    """True poses of base_link in the true frame car, and the robot's state at each.

    Attributes:
        track: poses.
        standing: (n) bool, the robot is stopped.
        on_axis: (n) bool, driving along an axis at nearly full speed.
        beyond_m: (n) distance of base_link from the Car's rectangle.
        judged: (n) bool, after the loop.
        meta: the drive's meta.json.
    """

    track: PoseTrack
    standing: BoolArray
    on_axis: BoolArray
    beyond_m: FloatArray
    judged: BoolArray
    meta: Dict[str, Any]

    @property
    def map_from_car(self) -> Pose2:
        """Pose of the Car in the frame of the robot's start."""
        return Pose2(*self.meta["map_from_car"].values())

    def in_loop(self, stamps_s: FloatArray) -> BoolArray:
        """Return True for stamps while the robot drives around the Car."""
        loop = [each for each in self.meta["segments"] if each["kind"] == "loop"]
        return (stamps_s > loop[0]["begin_s"]) & (stamps_s <= loop[-1]["end_s"])


def read_truth(folder: pathlib.Path) -> DriveTruth:
    """Read the truth in a drive's folder."""
    meta = json.loads((folder / META).read_text(encoding="utf-8"))
    columns = read_columns(folder / TRUTH)
    poses = np.stack([columns["car_x_m"], columns["car_y_m"], columns["car_heading_rad"]], axis=1)
    kinds = np.array([each["kind"] for each in meta["segments"]])[columns["segment"].astype(int)]
    fast = np.abs(columns["linear_mps"]) > MOVING_SHARE * AXIS_SPEED_MPS
    beyond = np.hypot(np.maximum(np.abs(poses[:, 0]) - 0.5 * meta["length_m"], 0.0),
                      np.maximum(np.abs(poses[:, 1]) - 0.5 * meta["width_m"], 0.0))
    return DriveTruth(pose_track(columns["stamp_s"], poses), columns["standing"] > 0.5, fast & (kinds == AXIS), beyond,
                      columns["stamp_s"] > meta["loop_end_s"] + EFFECT_S, meta)
