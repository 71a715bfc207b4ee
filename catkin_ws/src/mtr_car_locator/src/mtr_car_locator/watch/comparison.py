"""Comparison of a new observation with the measured surfaces of the Car: its motion, and the uncertainty."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Optional, Tuple

import numpy as np
from scipy.spatial import cKDTree

from mtr_core import sensor_figures
from mtr_core.arrays import BoolArray, FloatArray, IntArray
from mtr_core.se2 import Pose2

from ..measure.incidence import MIN_INCIDENCE_COSINE
from ..measure.side import OUTWARDS
from ..poses import RobotPose
from ..scan import Returns
from ..surfels import Surfels, in_frame, rotated_back
from .elsewhere import STEP_M, place_beside

# Points farther from every known surface belong to something else: a person, an open door.
FIRST_GATE_M, LAST_GATE_M = 0.20, 0.05
ROUNDS = 8
# 1 sigma of a LiDAR range, including the approximation by surfels.
POINT_SIGMA_M = sensor_figures.ASSUMED_POINT_M.value
# Prior of the motion without evidence: 1 sigma along x, y (m) and heading (rad).
BEFORE_SIGMAS = (0.10, 0.10, math.radians(2.0))
MIN_POINTS = 40
MIN_POINTS_ON_SIDE = 20
SIDE_COSINE = 0.8
# Neighbouring beams hit the same unevenness and have common errors: this number counts as one.
BEAMS_PER_SAMPLE = 10.0
# Another place must explain this many times more points than the Car's own.
CLEARLY_MORE = 1.2


@dataclass(frozen=True)
class Evidence:
    """Evidence of one or several observations for a motion of the Car (x, y, heading) in its own frame.

    Attributes:
        information: inverse covariance from the points' scatter, 3x3.
        weighted: information times motion.
        sides: median shift outwards of each seen side, m.
        points: number of used points.
        common: covariance of errors common to a whole observation: the robot's pose, and the remaining range biases of
            the LiDARs.
    """

    information: FloatArray
    weighted: FloatArray
    sides: Dict[str, float]
    points: int
    common: FloatArray

    @property
    def motion(self) -> Pose2:
        """Most likely motion of the Car; 0 in directions without evidence."""
        x, y, heading = np.linalg.solve(self.information + _before(), self.weighted)
        return Pose2(float(x), float(y), float(heading))

    @property
    def covariance(self) -> FloatArray:
        """Covariance of the motion."""
        own = np.linalg.inv(self.information + _before())
        return own + self.common

    @property
    def sigmas(self) -> Tuple[float, float]:
        """1 sigma of the shift in its worst direction (m), and of the turn (rad)."""
        covariance = self.covariance
        return (math.sqrt(float(np.linalg.eigvalsh(covariance[:2, :2])[-1])), math.sqrt(float(covariance[2, 2])))

    @property
    def pose_sigmas(self) -> Tuple[float, float, float]:
        """1 sigma of the motion's x, y (m) and heading (rad), for use as independent values.

        Each is increased by its correlation with the others, such as turn and shift for an uncertain heading of the
        robot. In no direction is the resulting covariance smaller than the true one.
        """
        covariance = self.covariance
        sigmas = np.sqrt(np.diag(covariance))
        # The diagonal matrix less the covariance is diagonally dominant, and therefore positive semidefinite.
        x, y, heading = sigmas * np.sqrt(np.sum(np.abs(covariance) / np.outer(sigmas, sigmas), axis=1))
        return float(x), float(y), float(heading)

    @property
    def shift_m(self) -> float:
        """Shift of the Car's centre or of a side, the larger one."""
        motion = self.motion
        return max([math.hypot(motion.x, motion.y), *(abs(shift) for shift in self.sides.values())])

    def significance(self) -> float:
        """Mahalanobis distance of the motion from zero."""
        motion = self.motion
        vector = np.array([motion.x, motion.y, motion.heading])
        return math.sqrt(max(float(vector @ np.linalg.solve(self.covariance, vector)), 0.0))


@dataclass(frozen=True)
class _Seen:
    """Points (n, 2) in the Car's frame, the viewpoint of each, and a mask of the rear LiDAR's points."""

    points: FloatArray
    viewer: FloatArray
    is_rear: BoolArray


class _Matches(NamedTuple):
    """Matches of points with surfaces.

    Arrays with one entry per match: Jacobian, distance outwards of the surface (m), normal, effect of a range error on
    the distance (m/m), and index of the point.
    """

    rows: FloatArray
    rest: FloatArray
    normals: FloatArray
    along: FloatArray
    number: IntArray


class CarReference:
    """Reference surfaces of the Car in its own frame."""

    def __init__(self, surfels: Surfels, bias_sigma_m: float):
        """Create a reference. bias_sigma_m: 1 sigma of each LiDAR's remaining range bias after the correction."""
        self._bias_sigma_m = bias_sigma_m
        self._points, index = surfels.samples()
        self._normals = surfels.normal[index]
        self._tree = cKDTree(self._points)

    def compare(self, sweeps: List[Returns], car: Pose2, robot: RobotPose) -> Optional[Evidence]:
        """Return the motion from an observation at one place; None if too little of the Car was seen."""
        if not sweeps:
            return None
        seen, common = _seen(sweeps, car), _by_pose(robot, car)
        here = self._fitted(seen, np.zeros(3), common)
        beside = place_beside(seen.points, seen.viewer, self._count_explained)
        there = self._fitted(seen, beside, common) if beside is not None else None
        # A motion along the Car's sides leaves these on the same lines, so both places look alike there.
        return there if there and (here is None or there.points >= CLEARLY_MORE * here.points) else here

    def _fitted(self, seen: _Seen, motion: FloatArray, common: FloatArray) -> Optional[Evidence]:
        """Return the motion near a given one; None if too little of the Car is there."""
        for turn in range(ROUNDS):
            gate_m = max(FIRST_GATE_M * 0.6 ** turn, LAST_GATE_M)
            matched = self._match(seen.points, seen.viewer, motion, gate_m)
            if matched is None or len(matched.rest) < MIN_POINTS:
                return None
            rows, rest, normals, along, number = matched
            factors = _factors(rows, rest)
            information = factors @ rows
            # The residual refers to the present motion, but the whole motion is required.
            weighted = factors @ (rest + rows @ motion)
            motion = np.linalg.solve(information + _before(), weighted)
        gain = np.linalg.solve(information + _before(), factors)
        common = common + self._by_biases(gain, along, seen.is_rear[number])
        return Evidence(information, weighted, _side_shifts(rest + rows @ motion, normals), len(rest), common)

    def _by_biases(self, gain: FloatArray, along: FloatArray, is_rear: BoolArray) -> FloatArray:
        """Return the covariance of the motion by remaining range biases.

        gain: motion by each point's distance (3, n). The surfels contain a part of that error, too, but they were met
        from other places.
        """
        by_lidar = gain @ (along[:, np.newaxis] * np.column_stack((~is_rear, is_rear)))
        covariance: FloatArray = self._bias_sigma_m ** 2 * by_lidar @ by_lidar.T
        return covariance

    def _count_explained(self, points: FloatArray, viewer: FloatArray, motion: FloatArray) -> int:
        matched = self._match(points, viewer, motion, STEP_M)
        return len(matched.rest) if matched else 0

    def _match(self, points: FloatArray, viewer: FloatArray, motion: FloatArray,
               gate_m: float) -> Optional[_Matches]:
        """Return the points near a surface with a matching direction."""
        pose = Pose2(*motion)
        moved = in_frame(points, pose)
        distance, index = self._tree.query(moved, distance_upper_bound=gate_m)
        found = np.isfinite(distance)
        normals = self._normals[np.where(found, index, 0)]
        back = rotated_back(viewer - points, pose.heading)
        back /= np.maximum(np.linalg.norm(back, axis=1), 1e-6)[:, np.newaxis]
        cosine = np.sum(normals * back, axis=1)
        found &= cosine > MIN_INCIDENCE_COSINE
        if not np.any(found):
            return None
        moved, normals = moved[found], normals[found]
        rest = np.sum(normals * (moved - self._points[index[found]]), axis=1)
        lever = normals[:, 1] * moved[:, 0] - normals[:, 0] * moved[:, 1]
        return _Matches(np.column_stack((normals, lever)), rest, normals, -cosine[found], np.nonzero(found)[0])


def joined(first: Evidence, second: Evidence) -> Evidence:
    """Combine two observations; a side in both counts with its larger shift."""
    sides = dict(first.sides)
    for name, shift in second.sides.items():
        sides[name] = max(shift, sides.get(name, 0.0), key=abs)
    return Evidence(first.information + second.information, first.weighted + second.weighted, sides,
                    first.points + second.points, 0.5 * (first.common + second.common))


def _seen(sweeps: List[Returns], car: Pose2) -> _Seen:
    viewers = [in_frame(sweep.viewer[np.newaxis], car).repeat(len(sweep.points), axis=0) for sweep in sweeps]
    is_rear = np.repeat([sweep.is_rear for sweep in sweeps], [len(sweep.points) for sweep in sweeps])
    return _Seen(in_frame(np.vstack([sweep.points for sweep in sweeps]), car), np.vstack(viewers), is_rear)


def _factors(rows: FloatArray, rest: FloatArray) -> FloatArray:
    """Return the Jacobian of each point (3, n), weighted robustly against outliers."""
    weights = 1.0 / (1.0 + (rest / POINT_SIGMA_M) ** 2)
    scatter = math.sqrt(float(np.sum(weights * rest ** 2) / np.sum(weights)))
    scale = 1.0 / (BEAMS_PER_SAMPLE * max(scatter, 0.2 * POINT_SIGMA_M) ** 2)
    factors: FloatArray = scale * (rows * weights[:, np.newaxis]).T
    return factors


def _side_shifts(shift: FloatArray, normals: FloatArray) -> Dict[str, float]:
    found = {}
    for name, outwards in OUTWARDS.items():
        mine = normals @ np.array(outwards) > SIDE_COSINE
        if np.count_nonzero(mine) >= MIN_POINTS_ON_SIDE:
            found[name] = float(np.median(shift[mine]))
    return found


def _by_pose(robot: RobotPose, car: Pose2) -> FloatArray:
    """Return the covariance of the motion by the robot's pose; a heading error rotates the Car round the robot."""
    cos, sin = math.cos(car.heading), math.sin(car.heading)
    car_from_map = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
    lever = np.array([[1.0, 0.0, robot.pose.y - car.y], [0.0, 1.0, car.x - robot.pose.x], [0.0, 0.0, 1.0]])
    by_error = car_from_map @ lever
    covariance: FloatArray = by_error @ np.reshape(robot.covariance, (3, 3)) @ by_error.T
    return covariance


def _before() -> FloatArray:
    return np.diag(1.0 / np.square(BEFORE_SIGMAS))
