"""Poses of the LiDARs on the robot from a recorded drive, by comparing each LiDAR's motion with the base's.

Hand-eye calibration in the plane (Shiu and Ahmad 1989; with odometry Censi et al. 2013): base_from_lidar X satisfies B
X = X L for every step. B is the base's motion from wheels and gyro, L the LiDAR's from matching two of its sweeps.
Further unknowns are scales, gyro bias, delay of the scans and the point about which the base turns. The motion within
sweeps is compensated before. Each unknown has a prior: a drive determines only some of them, and the others keep their
prior and are reported as such.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Sequence, Tuple

import numpy as np
from scipy.optimize import least_squares

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2
from mtr_core.sensor_figures import ASSUMED_GYRO_BIAS_AT_START_RADPS, ASSUMED_GYRO_SCALE
from mtr_motion_check.matching import match
from mtr_motion_check.recording import ScanSample, Sweep, scan_sample

from .readings import ReadingsUnusable

# Half a second of driving, in which the motion is integrated in this number of parts.
STEP_S, PARTS = 0.5, 5
# A smaller motion contains only noise.
MOVES_M, TURNS_RAD = 0.05, 0.05
MIN_STEPS = 20
# 1 sigma of unmeasured quantities: a mount fitted by hand, stamps of a driver, tyres, tracks that turn about a point
# other than base_link.
MOUNT_M, MOUNT_RAD, DELAY_S, WHEELS = 0.01, math.radians(1.0) / math.sqrt(3.0), 0.02, 0.02
TURNS_ABOUT_X_M, TURNS_ABOUT_Y_M = 0.05, 0.01
# Ratio to the prior's sigma below which the drive has determined an unknown.
TOLD = 0.7
# Time step for the speeds within a sweep.
SPEED_S = 0.05
# Initial sigma of a match; later ones follow from the residuals. Outliers have less weight.
MATCH_M, MATCH_RAD, ROBUST = 0.005, 0.003, 2.0
ROUNDS = 3


class Unknown(NamedTuple):
    """Estimated difference from the assumed value, with 1 sigma and the prior sigma."""

    value: float
    sigma: float
    prior_sigma: float

    @property
    def is_told(self) -> bool:
        """True if the drive has improved the prior."""
        return self.sigma < TOLD * self.prior_sigma


class Odometry(NamedTuple):
    """Distance in m and rotation in rad at times in s, integrated from wheels and gyro."""

    times_s: FloatArray
    way_m: FloatArray
    turn_rad: FloatArray

    def speeds(self, time_s: float) -> Tuple[float, float]:
        """Return m/s and rad/s around a time."""
        times = np.array([time_s - SPEED_S, time_s + SPEED_S])
        way, turn = (np.interp(times, self.times_s, summed) for summed in (self.way_m, self.turn_rad))
        return float(np.diff(way)[0]) / (2.0 * SPEED_S), float(np.diff(turn)[0]) / (2.0 * SPEED_S)

    def parts(self, begin_s: FloatArray, end_s: FloatArray) -> Tuple[FloatArray, FloatArray]:
        """Return distances and rotations (n, PARTS) between the times (n)."""
        times = begin_s[:, None] + (end_s - begin_s)[:, None] * np.linspace(0.0, 1.0, PARTS + 1)
        return (np.diff(np.interp(times, self.times_s, self.way_m), axis=1),
                np.diff(np.interp(times, self.times_s, self.turn_rad), axis=1))


@dataclass(frozen=True)
class Pairs:
    """Steps of one LiDAR: start and end in s (n), and first_from_second of it (n, 3) in m and rad."""

    mount: Pose2
    begin_s: FloatArray
    end_s: FloatArray
    motions: FloatArray


@dataclass(frozen=True)
class Calibration:
    """Result of one drive.

    Attributes:
        lidars: for each LiDAR x_m, y_m, yaw_rad and delay_s, differences from its mount and stamps.
        base: wheel_scale and gyro_scale as differences from 1, gyro_bias_radps, and the point about which the base
            turns, turns_about_x_m ahead of base_link and turns_about_y_m left of it.
        steps: their number.
    """

    lidars: List[Dict[str, Unknown]]
    base: Dict[str, Unknown]
    steps: int


MOUNT_PRIORS = {"x_m": MOUNT_M, "y_m": MOUNT_M, "yaw_rad": MOUNT_RAD, "delay_s": DELAY_S}
BASE_PRIORS = {"wheel_scale": WHEELS, "gyro_scale": ASSUMED_GYRO_SCALE.value,
               "gyro_bias_radps": ASSUMED_GYRO_BIAS_AT_START_RADPS, "turns_about_x_m": TURNS_ABOUT_X_M,
               "turns_about_y_m": TURNS_ABOUT_Y_M}


def pairs_of(scans: Sequence[ScanSample], mount: Pose2, odometry: Odometry) -> Pairs:
    """Match sweeps half a second apart in which the robot moves."""
    found: List[Tuple[float, float, Pose2]] = []
    first = None
    for scan in scans:
        if first is None or scan.time_s >= first.time_s + STEP_S - 1e-6:
            if first is not None:
                way, turn = odometry.parts(np.array([first.time_s]), np.array([scan.time_s]))
                if np.abs(way).sum() > MOVES_M or np.abs(turn).sum() > TURNS_RAD:
                    moved = match(first.points_m, scan.points_m)
                    found += [] if moved is None else [(first.time_s, scan.time_s, moved)]
            first = scan
    table = np.array([(begin, end, *_row(moved)) for begin, end, moved in found]).reshape(-1, 5)
    return Pairs(mount, table[:, 0], table[:, 1], table[:, 2:])


def still(sweep: Sweep, mount: Pose2, odometry: Odometry) -> ScanSample:
    """Return the hits of a sweep as seen from the LiDAR's position in the middle of the sweep."""
    hits, beams = scan_sample(sweep), np.arange(len(sweep.ranges_m))
    with np.errstate(invalid="ignore"):
        ranges = np.asarray(sweep.ranges_m, dtype=np.float64)
        seen = np.isfinite(ranges) & (ranges >= sweep.range_min_m) & (ranges <= sweep.range_max_m)
    after_s = sweep.time_increment_s * (beams[seen] - 0.5 * len(beams))
    speed_mps, turn_radps = odometry.speeds(hits.time_s)
    on_base = _compose(np.broadcast_to(_row(mount), (len(after_s), 3)), _points(hits.points_m))
    moved = np.stack([speed_mps * after_s, np.zeros_like(after_s), turn_radps * after_s], axis=1)
    back = np.broadcast_to(_inverse(_row(mount)[None])[0], (len(after_s), 3))
    return ScanSample(hits.time_s, _compose(back, _compose(moved, on_base))[:, :2])


def calibrated(lidars: Sequence[Pairs], odometry: Odometry, gyro_scale_sigma: float) -> Calibration:
    """Estimate the unknowns by least squares with outliers.

    Args:
        gyro_scale_sigma: of the source of the rotation; larger for the wheels than for a gyro.

    Raises:
        ReadingsUnusable: the drive is too short, or the surroundings do not determine the LiDARs' motion.
    """
    steps = min(len(pairs.begin_s) for pairs in lidars)
    if steps < MIN_STEPS:
        raise ReadingsUnusable(f"The drive has {steps} steps in which a LiDAR tells how it moved; at least {MIN_STEPS} "
                               "are needed. Drive 20 s ahead, back and in turns both ways, with walls in sight.")
    base_sigmas = np.array(list({**BASE_PRIORS, "gyro_scale": gyro_scale_sigma}.values()))
    sigmas = np.concatenate([base_sigmas, *[np.array(list(MOUNT_PRIORS.values()))] * len(lidars)])
    scales = [np.array([MATCH_M, MATCH_M, MATCH_RAD])] * len(lidars)
    values = np.zeros(len(sigmas))
    for _ in range(ROUNDS):
        solved = least_squares(lambda unknowns, scales=scales: np.concatenate(
            [unknowns / sigmas, *_weighted(unknowns, lidars, odometry, scales)]), values, loss="soft_l1",
            f_scale=ROBUST, x_scale=sigmas)
        values = solved.x
        scales = [np.maximum(1.4826 * np.median(np.abs(off), axis=0), 1e-5)
                  for off in _residuals(values, lidars, odometry)]
    spread = np.sqrt(np.diag(np.linalg.inv(solved.jac.T @ solved.jac)))
    unknowns = [Unknown(*row) for row in zip(values.tolist(), spread.tolist(), sigmas.tolist())]
    base, count = len(BASE_PRIORS), len(MOUNT_PRIORS)
    return Calibration([dict(zip(MOUNT_PRIORS, unknowns[base + count * index:])) for index in range(len(lidars))],
                       dict(zip(BASE_PRIORS, unknowns)), steps)


def _weighted(unknowns: FloatArray, lidars: Sequence[Pairs], odometry: Odometry,
              scales: Sequence[FloatArray]) -> List[FloatArray]:
    return [(off / scale).ravel() for off, scale in zip(_residuals(unknowns, lidars, odometry), scales)]


def _residuals(unknowns: FloatArray, lidars: Sequence[Pairs], odometry: Odometry) -> List[FloatArray]:
    """Return for each LiDAR (n, 3) the difference of its observed motion from the base's."""
    base, found = unknowns[:len(BASE_PRIORS)], []
    for index, pairs in enumerate(lidars):
        start = len(BASE_PRIORS) + len(MOUNT_PRIORS) * index
        x, y, yaw, delay_s = unknowns[start:start + len(MOUNT_PRIORS)]
        mount = _row(pairs.mount @ Pose2(float(x), float(y), float(yaw)))
        motion = _base_motion(base, odometry, pairs.begin_s - delay_s, pairs.end_s - delay_s)
        expected = _compose(_inverse(mount[None]), _compose(motion, np.broadcast_to(mount, motion.shape)))
        off = _compose(_inverse(pairs.motions), expected)
        off[:, 2] = np.remainder(off[:, 2] + math.pi, 2.0 * math.pi) - math.pi
        found.append(off)
    return found


def _base_motion(base: FloatArray, odometry: Odometry, begin_s: FloatArray, end_s: FloatArray) -> FloatArray:
    """Return begin_from_end of base_link (n, 3)."""
    wheel_scale, gyro_scale, bias_radps, ahead_m, left_m = base
    ways, turns = odometry.parts(begin_s, end_s)
    ways = (1.0 + wheel_scale) * ways
    turns = (1.0 + gyro_scale) * (turns - bias_radps * ((end_s - begin_s) / PARTS)[:, None])
    pose = np.zeros((len(begin_s), 3))
    for part in range(PARTS):
        way, turn = ways[:, part], turns[:, part]
        half = np.stack([np.zeros_like(turn), np.zeros_like(turn), 0.5 * turn], axis=1)
        moved = np.stack([way + left_m * turn, -ahead_m * turn, 0.5 * turn], axis=1)
        pose = _compose(_compose(pose, half), moved)
    return pose


def _compose(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return a_from_c for rows of a_from_b and b_from_c."""
    cos, sin = np.cos(first[:, 2]), np.sin(first[:, 2])
    return np.stack([first[:, 0] + cos * second[:, 0] - sin * second[:, 1],
                     first[:, 1] + sin * second[:, 0] + cos * second[:, 1], first[:, 2] + second[:, 2]], axis=1)


def _inverse(rows: FloatArray) -> FloatArray:
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    return np.stack([-cos * rows[:, 0] - sin * rows[:, 1], sin * rows[:, 0] - cos * rows[:, 1], -rows[:, 2]], axis=1)


def _points(points: FloatArray) -> FloatArray:
    """Return points as poses with irrelevant headings."""
    return np.column_stack([points, np.zeros(len(points))])


def _row(pose: Pose2) -> FloatArray:
    return np.array([pose.x, pose.y, pose.heading])
