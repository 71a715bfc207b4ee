"""Calibrates LiDARs from a recorded drive: bag in, sentences and checks for the record out."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import tempfile
from typing import Dict, List, Sequence, Tuple

import numpy as np

from mtr_core.se2 import Pose2
from mtr_core.sensor_figures import ASSUMED_GYRO_SCALE
from mtr_localization.any_bag.conversions import Found, convert
from mtr_localization.any_bag.frames import yaw_of
from mtr_localization.any_bag.sources import Asked
from mtr_motion_check.bag import motion_in, sweeps_in
from mtr_motion_check.recording import Recording, ScanSample

from .hand_eye import Calibration, Odometry, Pairs, Unknown, calibrated, pairs_of, still
from .readings import Estimate
from .record import LIDAR_YAW, Check

# Output of each unknown: unit, factor from SI, and meaning.
SAID = {"x_m": ("mm", 1e3, "ahead of where it should be"), "y_m": ("mm", 1e3, "left of it"),
        "yaw_rad": ("degrees", math.degrees(1.0), "turned from it"), "delay_s": ("ms", 1e3, "late in its stamps"),
        "wheel_scale": ("%", 1e2, "more way than the wheels say"), "gyro_scale": ("%", 1e2, "more turn than it says"),
        "gyro_bias_radps": ("mrad/s", 1e3, "of the turn's rate at rest"),
        "turns_about_x_m": ("mm", 1e3, "ahead of the robot's frame is the point about which it turns"),
        "turns_about_y_m": ("mm", 1e3, "left of the robot's frame is the point about which it turns")}
# A larger deviation than the description's tolerance must be fixed in the description, not recorded.
FAR_SIGMAS = 3.0


def measured(bag: pathlib.Path) -> Tuple[List[str], List[Check]]:
    """Return sentences, and the checks for the record; RobotError with a sentence if the bag is unusable."""
    with tempfile.TemporaryDirectory() as folder:
        converted = pathlib.Path(folder) / "inputs.bag"
        found = convert(bag, converted, Asked(), True, lambda _: None)
        places = [place for _, place in found.mounts.values()]
        mounts = [Pose2(float(place[0, 3]), float(place[1, 3]), yaw_of(place)) for place in places]
        odometry = odometry_of(motion_in(converted, []))
        scans: List[List[ScanSample]] = [[] for _ in mounts]
        for lidar, sweep in sweeps_in(converted, [math.copysign(1.0, place[2, 2]) for place in places]):
            scans[lidar].append(still(sweep, mounts[lidar], odometry))
    lidars = [pairs_of(seen, mount, odometry) for mount, seen in zip(mounts, scans)]
    result = calibrated(lidars, odometry, found.parameters.get("gyro_scale_sigma", ASSUMED_GYRO_SCALE.value))
    return sentences(found, lidars, result), checks(bag, result)


def odometry_of(recording: Recording) -> Odometry:
    """Return distance and rotation integrated at the wheels' stamps; a speed applies to the time before its stamp."""
    times = np.array([sample.time_s for sample in recording.wheels])
    ways = np.array([sample.linear_mps for sample in recording.wheels[1:]]) * np.diff(times)
    gyro_s = np.array([sample.time_s for sample in recording.imu])
    turns = np.array([sample.rate_radps[2] for sample in recording.imu[1:]]) * np.diff(gyro_s)
    turned = np.concatenate([[0.0], np.cumsum(turns)])
    return Odometry(times, np.concatenate([[0.0], np.cumsum(ways)]), np.interp(times, gyro_s, turned))


def sentences(found: Found, lidars: Sequence[Pairs], result: Calibration) -> List[str]:
    """Return a line for each unknown: its value if the drive determines it, else a note that it does not."""
    said = [f"{found.base}: {result.steps} steps of half a second.", *_lines("The robot", result.base)]
    for frame, pairs, unknowns in zip((frame for frame, _ in found.mounts.values()), lidars, result.lidars):
        said += _lines(f"{frame} at {pairs.mount.x:.3f}, {pairs.mount.y:.3f} m", unknowns)
    return said


def _lines(subject: str, unknowns: Dict[str, Unknown]) -> List[str]:
    said = []
    for name, each in unknowns.items():
        unit, factor, what = SAID[name]
        if not each.is_told:
            said.append(f"{subject}, {name}: not told by this drive, 1 sigma stays {factor * each.prior_sigma:.3g} "
                        f"{unit}.")
            continue
        far = " Correct it in the description." if abs(each.value) > FAR_SIGMAS * each.prior_sigma else ""
        said.append(f"{subject}, {name}: {factor * each.value:+.3g} {unit}, 1 sigma {factor * each.sigma:.2g}, "
                    f"{what}.{far}")
    return said


def checks(bag: pathlib.Path, result: Calibration) -> List[Check]:
    """Return the determined unknowns in the record's units: the front LiDAR's yaw is a term of the budget."""
    how = f"hand-eye calibration by {result.steps} steps of {bag.name}"
    front, base = result.lidars[0], result.base
    wanted = [(LIDAR_YAW, front["yaw_rad"], math.degrees(1.0), 0.0), ("wheel_scale", base["wheel_scale"], 1.0, 1.0),
              ("gyro_scale", base["gyro_scale"], 1.0, 1.0)]
    return [Check(name, Estimate(factor * each.value + offset, factor * each.sigma, float(result.steps)), how)
            for name, each, factor, offset in wanted if each.is_told]
