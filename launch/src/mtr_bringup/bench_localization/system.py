"""This system on one drive: localization's replay of the bag, then the Car locator on the surfaces that it leaves."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import pathlib
import subprocess
from typing import Any, Dict

import numpy as np
from roslib.packages import find_node

from mtr_car_locator.car_fit import CarFit
from mtr_car_locator.offline import fit_files
from mtr_car_locator.parameters import CarProfile, LocatorParameters
from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2
from mtr_simulation.car_shape import CAR_SHAPES

from .drive_truth import DriveTruth
from .errors import CarPose, errors_of
from .methods import Outcome
from .recording import BAG
from .trajectory import Trajectory, aligned, at, compose, read_columns, trajectory

REPLAY_LIMIT_S = 1800.0


class SystemFailure(Exception):
    """The system gave nothing to judge; the text is what it said."""


def run_this_system(folder: pathlib.Path, truth: DriveTruth) -> Outcome:
    """Errors of the whole chain in one drive."""
    out = folder / "replay"
    replay(folder / BAG, out)
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    if not summary["map_valid"]:
        raise SystemFailure(f"There is no map of this way round. {summary['map_message']}")
    track = read_replayed(out / "trajectory.csv")
    found = locate(out, truth.meta)
    return Outcome(errors_of(track, car_pose(found), truth), float(summary["cpu_ms_per_scan"]),
                   car_figures(found, key_frames(out), truth))


def replay(bag: pathlib.Path, out: pathlib.Path) -> None:
    """Run localization over the bag."""
    programs = find_node("mtr_localization", "replay_bag")
    if not programs:
        raise SystemFailure("The program replay_bag of mtr_localization is not built.")
    command = [programs[0], str(bag), "--out", str(out)]
    done = subprocess.run(command, text=True, capture_output=True, timeout=REPLAY_LIMIT_S, check=False)
    if done.returncode:
        raise SystemFailure(f"replay_bag ended with {done.returncode}: {done.stderr.strip()[-500:]}")


def read_replayed(path: pathlib.Path) -> Trajectory:
    """The trajectory that replay wrote."""
    columns = read_columns(path)
    poses = np.stack([columns["x_m"], columns["y_m"], columns["heading_rad"]], axis=1)
    covariances = np.stack([columns[f"c{row}{column}"] for row in "xyh" for column in "xyh"], axis=1)
    return trajectory(columns["stamp_s"], poses, covariances.reshape(-1, 3, 3), columns["valid"] > 0.5)


def locate(out: pathlib.Path, meta: Dict[str, Any]) -> CarFit:
    """The Car among the surfaces; the Operator said where the robot was put, and the data sheet of a Car that shows
    only its wheels."""
    prior = Pose2(*meta["prior_car_from_start"].values()).inverse()
    profile = CarProfile()
    if meta["at_lidar"]["only_wheels"]:
        profile = CarProfile(known_length_m=meta["length_m"], known_width_m=meta["width_m"],
                             front_overhang_m=meta["front_overhang_m"],
                             wheelbase_m=CAR_SHAPES[meta["options"]["car"]].wheelbase_m)
    try:
        return fit_files(out, prior, LocatorParameters(profile=profile))
    except RobotError as error:
        raise SystemFailure(f"The Car was not located: {error}") from None


def car_pose(found: CarFit) -> CarPose:
    """The Car in map with its covariance; its sigmas are along and across the Car."""
    pose = found.rectangle.pose
    along, across, turn = found.sigmas
    cos, sin = math.cos(pose.heading), math.sin(pose.heading)
    rotation = np.array(((cos, -sin, 0.0), (sin, cos, 0.0), (0.0, 0.0, 1.0)))
    return CarPose(pose, rotation @ np.diag((along**2, across**2, turn**2)) @ rotation.T)


def key_frames(out: pathlib.Path) -> Trajectory:
    """The adjusted key-frames."""
    columns = read_columns(out / "key_frames.csv")
    return trajectory(columns["stamp_s"], np.stack([columns["x_m"], columns["y_m"], columns["heading_rad"]], axis=1))


def car_figures(found: CarFit, frames: Trajectory, truth: DriveTruth) -> Dict[str, Any]:
    """Errors of the Car's pose in the adjusted map, laid on the truth by its key-frames, and of its size.

    What the key-frames are off among themselves is localization's error, the rest is the Car locator's.
    """
    car, meta = found.rectangle, truth.meta
    true = at(truth.track, frames.stamps_s)
    true_from_found = aligned(frames.poses, true) @ car.pose
    away = (compose(aligned(frames.poses, true), frames.poses) - true)[:, :2]
    at_lidar = meta["at_lidar"]
    return {"position_error_m": math.hypot(true_from_found.x, true_from_found.y),
            "along_error_m": true_from_found.x, "across_error_m": true_from_found.y,
            "yaw_error_deg": abs(math.degrees(true_from_found.heading)),
            "length_error_m": car.length - at_lidar["length_m"], "width_error_m": car.width - at_lidar["width_m"],
            "length_error_body_m": car.length - meta["length_m"], "width_error_body_m": car.width - meta["width_m"],
            "length_sigma_m": found.length_sigma, "width_sigma_m": found.width_sigma, "sigmas": list(found.sigmas),
            "only_wheels": bool(at_lidar["only_wheels"]),
            "key_frame_rmse_m": math.sqrt(float(np.mean(np.sum(away**2, axis=1))))}
