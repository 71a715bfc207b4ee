"""Motion of a LiDAR between two of its scans, from the scans alone, independent of odometry, gyro and mount.

Every rotation and shift of a grid is tried first, because an initial guess by a wrongly mounted sensor would mislead
the search; the best few are refined by point-to-line ICP.
"""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from typing import List, NamedTuple, Optional, Tuple

import numpy as np
from scipy.spatial import cKDTree

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2
from mtr_core.sensor_figures import ASSUMED_RANGE_NOISE_M

# Half a second at 1 m/s and 1.5 rad/s, more than drive control permits at once, and the grid's spacing.
MAX_SHIFT_M, SHIFT_STEP_M = 0.5, 0.25
MAX_TURN_RAD, TURN_STEP_RAD = 0.8, 0.1
# Beyond this range a LiDAR's neighbouring beams are too far apart for lines.
MAX_RANGE_M = 25.0
# Numbers of points of the grid's search and of the refinement; the cost of a match is proportional to them.
GRID_POINTS, FINE_POINTS = 90, 360
# Distance limits of a pair of points: saturation in the grid search, and gate of the refinement at its start and end.
FAR_M, FIRST_GATE_M, LAST_GATE_M = 0.5, 0.4, 0.08
GATE_SHRINK = 0.75
REFINED, ITERATIONS, CONVERGED = 3, 20, 1e-5
# Number of points of a line.
NEIGHBOURS = 5
# A match is valid if at least this number of points of both scans meet, and this share of the possible ones.
MIN_POINTS, MIN_SHARE = 25, 0.6
# Beyond these sigmas the surroundings do not determine the motion in some direction, for example along a bare wall.
MAX_SIGMA_M, MAX_SIGMA_RAD = 0.01, 0.01


class Refined(NamedTuple):
    """first_from_second of one start of the refinement, the share of points that meet, and their information."""

    pose: Pose2
    share: float
    information: FloatArray


def match(first_m: FloatArray, second_m: FloatArray) -> Optional[Pose2]:
    """Return first_from_second of a LiDAR from points of two sweeps, (n, 2) in m; None if the scans do not determine
    it."""
    first, second = near(first_m), near(second_m)
    if min(len(first), len(second)) < MIN_POINTS:
        return None
    tree = cKDTree(first)
    normals = normals_of(first, tree)
    fine = thinned(second, FINE_POINTS)
    refined = [refine(start, fine, first, normals, tree) for start in starts(tree, thinned(second, GRID_POINTS))]
    best = max(refined, key=lambda each: each.share)
    return best.pose if is_trusted(best, len(fine)) else None


def near(points: FloatArray) -> FloatArray:
    """Return the points close enough to have neighbours."""
    return points[np.hypot(points[:, 0], points[:, 1]) < MAX_RANGE_M]


def thinned(points: FloatArray, count: int) -> FloatArray:
    """Return at most `count` of the points, evenly selected."""
    return points[np.linspace(0, len(points) - 1, min(count, len(points))).astype(int)]


def normals_of(points: FloatArray, tree: cKDTree) -> FloatArray:
    """Return unit vectors across the line through each point and its neighbours, (n, 2)."""
    _, neighbours = tree.query(points, k=NEIGHBOURS)
    groups = points[neighbours] - points[neighbours].mean(axis=1, keepdims=True)
    _, vectors = np.linalg.eigh(np.einsum("nki,nkj->nij", groups, groups))
    across: FloatArray = vectors[:, :, 0]
    return across


def starts(tree: cKDTree, points: FloatArray) -> List[Pose2]:
    """Return the best poses of the grid, by the mean distance to the nearest point."""
    turns = np.arange(-MAX_TURN_RAD, MAX_TURN_RAD + 1e-9, TURN_STEP_RAD)
    shifts = np.arange(-MAX_SHIFT_M, MAX_SHIFT_M + 1e-9, SHIFT_STEP_M)
    poses = [Pose2(float(x), float(y), float(turn)) for turn, x, y in itertools.product(turns, shifts, shifts)
             if math.hypot(x, y) <= MAX_SHIFT_M]
    placed = np.concatenate([moved(points, pose) for pose in poses])
    distances, _ = tree.query(placed, distance_upper_bound=FAR_M)
    scores = np.minimum(distances, FAR_M).reshape(len(poses), -1).mean(axis=1)
    return [poses[index] for index in np.argsort(scores)[:REFINED]]


def moved(points: FloatArray, pose: Pose2) -> FloatArray:
    """Return the points in the target of the pose."""
    cos, sin = math.cos(pose.heading), math.sin(pose.heading)
    return points @ np.array([[cos, sin], [-sin, cos]]) + np.array([pose.x, pose.y])


def refine(start: Pose2, points: FloatArray, first: FloatArray, normals: FloatArray, tree: cKDTree) -> Refined:
    """Refine by point-to-line ICP with a narrowing gate."""
    pose, gate_m = start, FIRST_GATE_M
    share, information = 0.0, np.zeros((3, 3))
    for _ in range(ITERATIONS):
        pose, share, information, change = improve(pose, points, gate_m, (first, normals, tree))
        if change < CONVERGED and gate_m == LAST_GATE_M:
            break
        gate_m = max(LAST_GATE_M, GATE_SHRINK * gate_m)
    return Refined(pose, share, information)


def improve(pose: Pose2, points: FloatArray, gate_m: float, lines: Tuple[FloatArray, FloatArray, cKDTree]
            ) -> Tuple[Pose2, float, FloatArray, float]:
    """Run one Gauss-Newton step: pose, share of points inside the gate, information, size of the step."""
    first, normals, tree = lines
    placed = moved(points, pose)
    distances, indices = tree.query(placed, distance_upper_bound=gate_m)
    inside = np.isfinite(distances)
    across, at = normals[indices[inside]], placed[inside]
    residuals = np.einsum("ni,ni->n", across, at - first[indices[inside]])
    jacobian = np.column_stack([across, across[:, 1] * at[:, 0] - across[:, 0] * at[:, 1]])
    information = jacobian.T @ jacobian
    step = -np.linalg.solve(information + 1e-9 * np.eye(3), jacobian.T @ residuals)
    share = float(np.count_nonzero(inside)) / len(points)
    return Pose2(*step.tolist()) @ pose, share, information, float(np.abs(step).max())


def is_trusted(refined: Refined, count: int) -> bool:
    """Return True if enough points meet, and they determine all three unknowns."""
    if refined.share < MIN_SHARE or refined.share * count < MIN_POINTS or not refined.pose.is_finite():
        return False
    covariance = np.linalg.pinv(refined.information) * 2.0 * ASSUMED_RANGE_NOISE_M.value ** 2
    sigma_m, sigma_rad = math.sqrt(np.linalg.norm(covariance[:2, :2], 2)), math.sqrt(covariance[2, 2])
    # The pseudoinverse of a singular matrix would hide its undetermined direction.
    return bool(np.linalg.matrix_rank(refined.information) == 3) and sigma_m < MAX_SIGMA_M and sigma_rad < MAX_SIGMA_RAD
