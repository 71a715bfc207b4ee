"""Runs MRPT's ICP SLAM on the same data: scans corrected for the robot's motion, and odometry of wheels and gyro."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import subprocess
from typing import Iterator, List, NamedTuple, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from ..drives.pose_track import PoseTrack, at, pose_track, read_columns
from ..drives.sensor_log import SensorLog, Sweep

# Beams over the full circle, as dense as the LiDARs' own.
BEAMS = 960
# Every second sweep is used (12.5 Hz): the accuracy is the same as with all of them, in half of the time.
EVERY = 2


class MrptError(Exception):
    """The program failed; the text has its error output."""


class MrptRun(NamedTuple):
    """Poses at the stamps of the scans, and the CPU time per scan."""

    track: PoseTrack
    cpu_ms_per_scan: float


def run_mrpt(program: pathlib.Path, log: SensorLog, odometry: PoseTrack, folder: pathlib.Path) -> MrptRun:
    """Run the program on the drive."""
    source, result = folder / "mrpt_input.bin", folder / "mrpt.csv"
    _write(source, log, odometry)
    done = subprocess.run([str(program), str(source), str(result)], text=True, capture_output=True, check=False)
    source.unlink()
    if done.returncode:
        raise MrptError(f"{program.name} ended with {done.returncode}: {done.stderr.strip()}")
    columns = read_columns(result)
    poses = np.stack([columns["x_m"], columns["y_m"], columns["heading_rad"]], axis=1)
    return MrptRun(pose_track(columns["stamp_s"], poses), float(done.stdout))


def _write(path: pathlib.Path, log: SensorLog, odometry: PoseTrack) -> None:
    """Write the program's input; its source describes the format."""
    turns = list(_turns(log.sweeps))[::EVERY]
    with path.open("wb") as file:
        file.write(np.array([len(turns), BEAMS], dtype="<i8").tobytes())
        for sweeps in turns:
            stamp = max(float(sweep.stamps_s[-1]) for sweep in sweeps)
            pose = at(odometry, np.array([stamp]))[0]
            file.write(np.array([stamp, *pose], dtype="<f8").tobytes())
            file.write(rebinned([points(sweep, odometry, pose) for sweep in sweeps]).astype("<f4").tobytes())


def _turns(sweeps: List[Sweep]) -> Iterator[List[Sweep]]:
    """Yield the sweeps of all LiDARs that begin at the same time."""
    together: List[Sweep] = []
    for sweep in sweeps:
        if together and sweep.stamps_s[0] > together[0].stamps_s[0] + 1e-6:
            yield together
            together = []
        together.append(sweep)
    if together:
        yield together


def points(sweep: Sweep, odometry: PoseTrack, pose: FloatArray) -> FloatArray:
    """Return points (n, 2) in base_link at a pose, each corrected for the robot's pose at its beam's time."""
    seen = sweep.ranges_m > 0.0
    x, y, heading = at(odometry, sweep.stamps_s[seen]).T
    local_x = sweep.x_m + sweep.ranges_m[seen] * np.cos(sweep.angles_rad[seen])
    local_y = sweep.ranges_m[seen] * np.sin(sweep.angles_rad[seen])
    cos, sin = np.cos(heading), np.sin(heading)
    away_x, away_y = x + cos * local_x - sin * local_y - pose[0], y + sin * local_x + cos * local_y - pose[1]
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    return np.stack([cos * away_x + sin * away_y, cos * away_y - sin * away_x], axis=1)


def rebinned(clouds: List[FloatArray]) -> FloatArray:
    """Return the range of the nearest return in each of BEAMS directions from -pi on; 0 without a return."""
    cloud: Tuple[FloatArray, ...] = tuple(np.concatenate(clouds).T)
    distances = np.hypot(*cloud)
    step = 2.0 * math.pi / (BEAMS - 1)
    bins = np.rint((np.arctan2(cloud[1], cloud[0]) + math.pi) / step).astype(int)
    nearest = np.full(BEAMS, np.inf)
    np.minimum.at(nearest, bins, distances)
    return np.where(np.isfinite(nearest), nearest, 0.0)
