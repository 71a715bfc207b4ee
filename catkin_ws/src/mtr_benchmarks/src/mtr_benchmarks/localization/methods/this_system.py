"""Runs this system on one drive: localization's replay of the bag, then the Car locator on the resulting surfaces."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import pathlib
import subprocess
from dataclasses import replace
from typing import Any, Dict, Iterable, NamedTuple, Optional

import numpy as np
from roslib.packages import find_node

from mtr_car_locator.conversions import scans_in
from mtr_car_locator.measure.car_fit import CarFit
from mtr_car_locator.offline import fit_files
from mtr_car_locator.parameters import DataSheet, LocatorParameters
from mtr_car_locator.scan import Scan
from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2
from mtr_description.shipped import shipped_geometry

from ..drives.pose_track import PoseTrack, aligned, at, compose, pose_track, read_columns
from ..drives.recording import BAG
from ..drives.truth import DriveTruth
from .errors import MeasuredCar, errors_of
from .outcome import CarErrors, MethodOutcome

REPLAY_LIMIT_S = 1800.0
PARAMETERS = LocatorParameters()
MIN_INSET_M = 0.001


class SystemFailure(Exception):
    """The system gave no result to evaluate; the text is its message."""


class NotLocated(SystemFailure):
    """The Car locator did not locate the Car; the text has its question or reason."""


class NoMap(SystemFailure):
    """The path around the Car gave no map."""


def run_this_system(folder: pathlib.Path, truth: DriveTruth) -> MethodOutcome:
    """Return the errors of the whole chain in one drive."""
    out = folder / "replay"
    summary = mapped(folder / BAG, out)
    track = read_replayed(out / "trajectory.csv")
    found = locate(out, truth.meta, scans_in(folder / BAG, shipped_geometry().lidars()), usual_sheet(truth.meta))
    return MethodOutcome(errors_of(track, car_pose(found), truth), float(summary["cpu_ms_per_scan"]),
                   car_errors(found, key_frames(out), truth))


def mapped(bag: pathlib.Path, out: pathlib.Path) -> Dict[str, Any]:
    """Run localization over the bag; return its summary.

    Raises:
        NoMap: the drive gave no map.
    """
    replay(bag, out)
    summary: Dict[str, Any] = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    if not summary["map_valid"]:
        raise NoMap(f"There is no map of this way round. {summary['map_message']}")
    return summary


def replay(bag: pathlib.Path, out: pathlib.Path) -> None:
    """Run localization over the bag."""
    programs = find_node("mtr_localization", "replay_bag")
    if not programs:
        raise SystemFailure("The program replay_bag of mtr_localization is not built.")
    command = [programs[0], str(bag), "--out", str(out)]
    done = subprocess.run(command, text=True, capture_output=True, timeout=REPLAY_LIMIT_S, check=False)
    if done.returncode:
        raise SystemFailure(f"replay_bag ended with {done.returncode}: {done.stderr.strip()[-500:]}")


def read_replayed(path: pathlib.Path) -> PoseTrack:
    """Read the trajectory of the replay."""
    columns = read_columns(path)
    poses = np.stack([columns["x_m"], columns["y_m"], columns["heading_rad"]], axis=1)
    covariances = np.stack([columns[f"c{row}{column}"] for row in "xyh" for column in "xyh"], axis=1)
    return pose_track(columns["stamp_s"], poses, covariances.reshape(-1, 3, 3), columns["valid"] > 0.5)


def usual_sheet(meta: Dict[str, Any]) -> Optional[DataSheet]:
    """Return the data sheet that a laboratory enters if the LiDAR plane is below the Car's widest line; else None."""
    return data_sheet(meta) if is_below_widest_line(meta) else None


def locate(out: pathlib.Path, meta: Dict[str, Any], scans: Iterable[Scan] = (),
           sheet: Optional[DataSheet] = None) -> CarFit:
    """Locate the Car from the surfaces, the Operator's starting place, and optionally the data sheet.

    Raises:
        NotLocated: the Car was not located.
    """
    prior = Pose2(*meta["prior_car_from_start"].values()).inverse()
    try:
        return fit_files(out, prior, replace(PARAMETERS, sheet=sheet or DataSheet()), scans)
    except RobotError as error:
        raise NotLocated(f"The Car was not located: {error}") from None


def is_below_widest_line(meta: Dict[str, Any]) -> bool:
    """Return True if the plane does not meet the Car at its largest length and width."""
    at_lidar = meta["at_lidar"]
    return at_lidar["only_wheels"] or min(meta["length_m"] - at_lidar["length_m"],
                                          meta["width_m"] - at_lidar["width_m"]) > MIN_INSET_M


def data_sheet(meta: Dict[str, Any]) -> DataSheet:
    """Return the complete data sheet of the Car."""
    return DataSheet(known_length_m=meta["length_m"], known_width_m=meta["width_m"],
                      front_overhang_m=meta["front_overhang_m"],
                      wheelbase_m=meta["wheelbase_m"])


def car_pose(found: CarFit) -> MeasuredCar:
    """Return the Car in map with its covariance; its sigmas are along and across the Car."""
    pose = found.rectangle.pose
    along, across, turn = found.sigmas
    cos, sin = math.cos(pose.heading), math.sin(pose.heading)
    rotation = np.array(((cos, -sin, 0.0), (sin, cos, 0.0), (0.0, 0.0, 1.0)))
    return MeasuredCar(pose, rotation @ np.diag((along**2, across**2, turn**2)) @ rotation.T)


def key_frames(out: pathlib.Path) -> PoseTrack:
    """Read the adjusted key frames."""
    columns = read_columns(out / "key_frames.csv")
    return pose_track(columns["stamp_s"], np.stack([columns["x_m"], columns["y_m"], columns["heading_rad"]], axis=1))


def car_errors(found: CarFit, frames: PoseTrack, truth: DriveTruth) -> CarErrors:
    """Return the errors of the Car's size, and of its pose in the adjusted map, aligned with the truth by the key
    frames.

    Localization causes the errors of the key frames relative to each other; the remaining error is the Car locator's.
    """
    car, meta = found.rectangle, truth.meta
    true = at(truth.track, frames.stamps_s)
    true_from_found = aligned(frames.poses, true) @ car.pose
    away = (compose(aligned(frames.poses, true), frames.poses) - true)[:, :2]
    in_plane = plane_errors(found, meta["at_lidar"])
    return CarErrors(
        position_error_m=math.hypot(true_from_found.x, true_from_found.y),
        along_error_m=true_from_found.x, across_error_m=true_from_found.y,
        yaw_error_deg=abs(math.degrees(true_from_found.heading)),
        length_error_m=in_plane.length_m, width_error_m=in_plane.width_m,
        length_plane_sigma_m=in_plane.length_sigma_m, width_plane_sigma_m=in_plane.width_sigma_m,
        length_error_body_m=car.length - meta["length_m"], width_error_body_m=car.width - meta["width_m"],
        length_sigma_m=found.length_sigma, width_sigma_m=found.width_sigma, sigmas=list(found.sigmas),
        only_wheels=bool(meta["at_lidar"]["only_wheels"]), warning=found.warning,
        key_frame_rmse_m=math.sqrt(float(np.mean(np.sum(away**2, axis=1)))))


class PlaneErrors(NamedTuple):
    """Errors and sigmas of length and width in the LiDAR plane."""

    length_m: float
    width_m: float
    length_sigma_m: float
    width_sigma_m: float


def plane_errors(found: CarFit, at_lidar: Dict[str, Any]) -> PlaneErrors:
    """Return the errors of the size in the LiDAR plane; a size that was not measured is the published one."""
    size, car = found.in_plane, found.rectangle
    return PlaneErrors((size.length or car.length) - at_lidar["length_m"],
                       (size.width or car.width) - at_lidar["width_m"], size.length_sigma, size.width_sigma)
