"""The Car seen anew against the surfaces that it was measured by: how far it has moved, and how sure that is."""
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

# Points farther from every known surface are something else: a person, an open door.
FIRST_GATE_M, LAST_GATE_M = 0.20, 0.05
ROUNDS = 8
# A LiDAR's range, and what the surfels simplify, have this 1 sigma together.
POINT_SIGMA_M = sensor_figures.ASSUMED_POINT_M.value
# Without evidence the Car stands where it stood: 1 sigma before the observation, along x, y (m) and heading (rad).
BEFORE_SIGMAS = (0.10, 0.10, math.radians(2.0))
MIN_POINTS = 40
MIN_POINTS_ON_SIDE = 20
SIDE_COSINE = 0.8
# Neighbouring beams hit the same unevenness and are wrong together: so many of them count as one.
BEAMS_PER_SAMPLE = 10.0
# A place elsewhere has to explain so much more of what is seen than the Car's own.
CLEARLY_MORE = 1.2


@dataclass(frozen=True)
class Evidence:
    """What one observation, or several, tell of the Car's motion (x, y, heading) in its own frame.

    Attributes:
        information: inverse covariance by the points' scatter, 3x3.
        weighted: information times motion.
        sides: median shift outwards of each side that was seen, m.
        points: how many were used.
        common: covariance of what is common to a whole observation: the robot's pose, and what is left of the LiDARs'
            range biases.
    """

    information: FloatArray
    weighted: FloatArray
    sides: Dict[str, float]
    points: int
    common: FloatArray

    @property
    def motion(self) -> Pose2:
        """Most likely motion of the Car; 0 in directions that were not seen."""
        x, y, heading = np.linalg.solve(self.information + _before(), self.weighted)
        return Pose2(float(x), float(y), float(heading))

    @property
    def covariance(self) -> FloatArray:
        """Of the motion."""
        own = np.linalg.inv(self.information + _before())
        return own + self.common

    @property
    def sigmas(self) -> Tuple[float, float]:
        """1 sigma of the shift, in its worst direction (m), and of the turn (rad)."""
        covariance = self.covariance
        return (math.sqrt(float(np.linalg.eigvalsh(covariance[:2, :2])[-1])), math.sqrt(float(covariance[2, 2])))

    @property
    def pose_sigmas(self) -> Tuple[float, float, float]:
        """1 sigma of the motion's x, y (m) and heading (rad), for those who take these for independent.

        Each is larger than its own by what goes together with the others, such as turn and shift seen by a robot whose
        heading is unsure: in no direction do the three together say less than the covariance.
        """
        covariance = self.covariance
        sigmas = np.sqrt(np.diag(covariance))
        # A covariance less this diagonal is diagonally dominant, and so negative in no direction.
        x, y, heading = sigmas * np.sqrt(np.sum(np.abs(covariance) / np.outer(sigmas, sigmas), axis=1))
        return float(x), float(y), float(heading)

    @property
    def shift_m(self) -> float:
        """Shift of the Car's centre or of a side, the larger."""
        motion = self.motion
        return max([math.hypot(motion.x, motion.y), *(abs(shift) for shift in self.sides.values())])

    def significance(self) -> float:
        """Mahalanobis distance of the motion from none."""
        motion = self.motion
        vector = np.array([motion.x, motion.y, motion.heading])
        return math.sqrt(max(float(vector @ np.linalg.solve(self.covariance, vector)), 0.0))


@dataclass(frozen=True)
class _Seen:
    """Points (n, 2) in the Car's frame, from where each was seen, and which of them the rear LiDAR saw."""

    points: FloatArray
    viewer: FloatArray
    is_rear: BoolArray


class _Matches(NamedTuple):
    """Of each point that is near a surface: its Jacobian, its distance outwards of the surface (m), the surface's
    normal, what a range that is too long adds to that distance (m/m), and which point it is."""

    rows: FloatArray
    rest: FloatArray
    normals: FloatArray
    along: FloatArray
    number: IntArray


class CarReference:
    """Surfaces of the Car in its own frame, ready to be compared with."""

    def __init__(self, surfels: Surfels, bias_sigma_m: float):
        """bias_sigma_m: 1 sigma of what is left of each LiDAR's range bias, when it has been taken off."""
        self._bias_sigma_m = bias_sigma_m
        self._points, index = surfels.samples()
        self._normals = surfels.normal[index]
        self._tree = cKDTree(self._points)

    def compare(self, sweeps: List[Returns], car: Pose2, robot: RobotPose) -> Optional[Evidence]:
        """Motion that fits what was seen from one place, None when too little of the Car was seen."""
        if not sweeps:
            return None
        seen, common = _seen(sweeps, car), _by_pose(robot, car)
        here = self._fitted(seen, np.zeros(3), common)
        beside = place_beside(seen.points, seen.viewer, self._count_explained)
        there = self._fitted(seen, beside, common) if beside is not None else None
        # Lines along which the Car was moved look alike from both places.
        return there if there and (here is None or there.points >= CLEARLY_MORE * here.points) else here

    def _fitted(self, seen: _Seen, motion: FloatArray, common: FloatArray) -> Optional[Evidence]:
        """The motion near another one, None when too little of the Car lies there."""
        for turn in range(ROUNDS):
            gate_m = max(FIRST_GATE_M * 0.6 ** turn, LAST_GATE_M)
            matched = self._match(seen.points, seen.viewer, motion, gate_m)
            if matched is None or len(matched.rest) < MIN_POINTS:
                return None
            rows, rest, normals, along, number = matched
            factors = _factors(rows, rest)
            information = factors @ rows
            # The residual is what is left beyond the present motion; the whole motion is sought.
            weighted = factors @ (rest + rows @ motion)
            motion = np.linalg.solve(information + _before(), weighted)
        gain = np.linalg.solve(information + _before(), factors)
        common = common + self._by_biases(gain, along, seen.is_rear[number])
        return Evidence(information, weighted, _side_shifts(rest + rows @ motion, normals), len(rest), common)

    def _by_biases(self, gain: FloatArray, along: FloatArray, is_rear: BoolArray) -> FloatArray:
        """Covariance of the motion by what is left of the range biases; gain: motion by each point's distance (3, n).

        The surfels have a part of that error, too, but they were met from other places.
        """
        by_lidar = gain @ (along[:, np.newaxis] * np.column_stack((~is_rear, is_rear)))
        covariance: FloatArray = self._bias_sigma_m ** 2 * by_lidar @ by_lidar.T
        return covariance

    def _count_explained(self, points: FloatArray, viewer: FloatArray, motion: FloatArray) -> int:
        matched = self._match(points, viewer, motion, STEP_M)
        return len(matched.rest) if matched else 0

    def _match(self, points: FloatArray, viewer: FloatArray, motion: FloatArray,
               gate_m: float) -> Optional[_Matches]:
        """The points that are near a surface that they can be points of."""
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
    """Both observations together; a side that both saw counts with its larger shift."""
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
    """Jacobian of each point (3, n) by the point's weight, robust against points that are wrong."""
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
    """Covariance of the motion by the robot's pose; an error of its heading swings the Car round the robot."""
    cos, sin = math.cos(car.heading), math.sin(car.heading)
    car_from_map = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
    lever = np.array([[1.0, 0.0, robot.pose.y - car.y], [0.0, 1.0, car.x - robot.pose.x], [0.0, 0.0, 1.0]])
    by_error = car_from_map @ lever
    covariance: FloatArray = by_error @ np.reshape(robot.covariance, (3, 3)) @ by_error.T
    return covariance


def _before() -> FloatArray:
    return np.diag(1.0 / np.square(BEFORE_SIGMAS))
