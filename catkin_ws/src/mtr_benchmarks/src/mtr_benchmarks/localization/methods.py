"""What one method makes of one drive, and the two that this system is compared with."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Any, Dict, NamedTuple

import numpy as np

from .dead_reckoning import dead_reckoned
from .drive_truth import DriveTruth
from .errors import CarPose, Errors, errors_of
from .mrpt import run_mrpt
from .recording import BAG
from .sensor_log import read_sensors
from .trajectory import Trajectory, aligned, at

THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP = "this_system", "odometry_gyro", "mrpt_icp"
METHODS = (THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP)


class Outcome(NamedTuple):
    """What one method made of one drive.

    Attributes:
        errors: of the key after the loop.
        cpu_ms_per_scan: CPU time.
        car: how the Car was found: errors of its pose, length and width; empty from a method that finds none.
    """

    errors: Errors
    cpu_ms_per_scan: float
    car: Dict[str, Any]


def compare(folder: pathlib.Path, truth: DriveTruth, mrpt_program: pathlib.Path) -> Dict[str, Outcome]:
    """Odometry with gyro, and MRPT on top of it, both told by the truth of the loop where the Car is."""
    log = read_sensors(folder / BAG)
    odometry = dead_reckoned(log)
    slam = run_mrpt(mrpt_program, log, odometry, folder)
    return {ODOMETRY_GYRO: Outcome(errors_of(odometry, told_car(odometry, truth), truth), 0.0, {}),
            MRPT_ICP: Outcome(errors_of(slam.track, told_car(slam.track, truth), truth), slam.cpu_ms_per_scan, {})}


def told_car(track: Trajectory, truth: DriveTruth) -> CarPose:
    """The Car where it fits the method's own way round it best: as if its locator made no error."""
    loop = truth.in_loop(track.stamps_s)
    car_from_map = aligned(track.poses[loop], at(truth.track, track.stamps_s[loop]))
    return CarPose(car_from_map.inverse(), np.zeros((3, 3)))
