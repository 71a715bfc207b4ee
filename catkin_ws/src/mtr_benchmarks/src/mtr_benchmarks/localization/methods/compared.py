"""Runs the two methods with which this system is compared."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Dict

import numpy as np

from ..drives.pose_track import PoseTrack, aligned, at
from ..drives.recording import BAG
from ..drives.sensor_log import read_sensors
from ..drives.truth import DriveTruth
from .dead_reckoning import dead_reckoned
from .errors import MeasuredCar, errors_of
from .mrpt import run_mrpt
from .outcome import MRPT_ICP, ODOMETRY_GYRO, MethodOutcome


def compare(folder: pathlib.Path, truth: DriveTruth, mrpt_program: pathlib.Path) -> Dict[str, MethodOutcome]:
    """Run odometry with gyro, and MRPT on top of it; both receive the Car's pose from the truth of the loop."""
    log = read_sensors(folder / BAG)
    odometry = dead_reckoned(log)
    slam = run_mrpt(mrpt_program, log, odometry, folder)
    return {ODOMETRY_GYRO: MethodOutcome(errors_of(odometry, fitted_car(odometry, truth), truth), 0.0),
            MRPT_ICP: MethodOutcome(errors_of(slam.track, fitted_car(slam.track, truth), truth), slam.cpu_ms_per_scan)}


def fitted_car(track: PoseTrack, truth: DriveTruth) -> MeasuredCar:
    """Return the Car's pose that fits the method's own loop best, as if its locator made no error."""
    loop = truth.in_loop(track.stamps_s)
    car_from_map = aligned(track.poses[loop], at(truth.track, track.stamps_s[loop]))
    return MeasuredCar(car_from_map.inverse(), np.zeros((3, 3)))
