"""The robot's view, in the Car coordinate system."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mtr_operator.domain.geometry.pose import Point, Pose
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.surroundings import StopZone

_SAME_BEARING_RAD = 0.1

Array = Any


@dataclass(frozen=True)
class View:
    """View. points: returns of the LiDARs, (n, 2). path: to the waypoint. viewer: the robot. obstacle: position of the
    obstacle that stops it and its distance from the footprint, None without one. Positions in the Car coordinate
    system, m."""

    points: Array
    path: tuple[Point, ...]
    viewer: Point
    zone: StopZone
    obstacle: tuple[Point, float] | None


def view_of(status: RobotStatus) -> View | None:
    """Return the view of a Status; None without one, or if the robot's position is unknown."""
    seen = status.surroundings
    if seen is None or not status.pose_valid:
        return None
    pose = Pose(status.x, status.y, status.heading)
    points = np.array(seen.points, dtype=float).reshape(-1, 2)
    cos, sin = math.cos(pose.heading), math.sin(pose.heading)
    placed = np.column_stack((pose.x + cos * points[:, 0] - sin * points[:, 1],
                              pose.y + sin * points[:, 0] + cos * points[:, 1]))
    obstacle = None
    if seen.obstacle is not None:
        distance_m, bearing_rad = seen.obstacle
        obstacle = pose.apply(_place(points, bearing_rad, distance_m)), distance_m
    return View(placed, seen.path, (pose.x, pose.y), seen.zone, obstacle)


def _place(points: Array, bearing_rad: float, distance_m: float) -> Point:
    """Return the obstacle in base_link: the nearest return on that bearing; without one a point at its distance."""
    off = np.abs(np.remainder(np.arctan2(points[:, 1], points[:, 0]) - bearing_rad + np.pi, 2.0 * np.pi) - np.pi)
    along = np.hypot(points[:, 0], points[:, 1])[off < _SAME_BEARING_RAD]
    range_m = float(along.min()) if len(along) else distance_m
    return range_m * math.cos(bearing_rad), range_m * math.sin(bearing_rad)
