"""What the robot sees, in the Car coordinate system, and which way is not free."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from mtr_operator.domain.actions.distance import gap_to_outline
from mtr_operator.domain.geometry.pose import Point, Pose
from mtr_operator.domain.results.picture import Stretch
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus
from mtr_operator.domain.surroundings import StopZone

# How far the robot reaches beyond its key, away from the Car, and to both sides of the line, with the planner's margin
# and half a cell of the map; docs of mtr_motion_planner: 0.27 m ahead, 0.254 m behind, 0.22 m aside, key 0.25 m ahead.
_BEHIND_KEY_M, _ASIDE_M = 0.6, 0.4
# Nearer to its outline the Car itself is seen.
_CAR_M = 0.4
_SAME_BEARING_RAD = 0.1

Array = Any


@dataclass(frozen=True)
class View:
    """points: returns of the LiDARs, (n, 2). path: to the waypoint. viewer: the robot. obstacle: place of what hinders
    it and its distance from the footprint, None when nothing does. Places in the Car coordinate system, m."""

    points: Array
    path: tuple[Point, ...]
    viewer: Point
    zone: StopZone
    obstacle: tuple[Point, float] | None


@dataclass(frozen=True)
class Hindered:
    """Lines on whose way something stands, by their labels, and how far the nearest of it is from the Car, m."""

    labels: tuple[str, ...]
    gap_m: float


def view_of(status: RobotStatus) -> View | None:
    """None in a Status that does not carry it, and where nobody knows where the robot is."""
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
    """Of the obstacle in base_link: the nearest return on that bearing; without one its distance from the middle."""
    off = np.abs(np.remainder(np.arctan2(points[:, 1], points[:, 0]) - bearing_rad + np.pi, 2.0 * np.pi) - np.pi)
    along = np.hypot(points[:, 0], points[:, 1])[off < _SAME_BEARING_RAD]
    range_m = float(along.min()) if len(along) else distance_m
    return range_m * math.cos(bearing_rad), range_m * math.sin(bearing_rad)


def hindered_lines(stretches: Sequence[Stretch], car: CarDimensions, places: Array) -> Hindered | None:
    """Lines on whose way one of these places lies; None when all are free, as far as was seen."""
    half = np.array([car.length / 2.0, car.width / 2.0])
    places = places[np.hypot(*np.maximum(np.abs(places) - half, 0.0).T) > _CAR_M]
    found = [(stretch.label, place) for stretch in stretches for place in _on_way(stretch, places)]
    if not found:
        return None
    labels = tuple(dict.fromkeys(label for label, _ in found))
    return Hindered(labels, min(gap_to_outline((float(place[0]), float(place[1])), car) for _, place in found))


def _on_way(stretch: Stretch, places: Array) -> Array:
    """Places that the robot would touch while its key is carried along."""
    (near_x, near_y), (far_x, far_y) = stretch.start, stretch.end
    length_m = math.hypot(far_x - near_x, far_y - near_y)
    if length_m == 0.0 or not len(places):
        return places[:0]
    ahead_x, ahead_y = (far_x - near_x) / length_m, (far_y - near_y) / length_m
    along = (places[:, 0] - near_x) * ahead_x + (places[:, 1] - near_y) * ahead_y
    aside = np.abs((places[:, 1] - near_y) * ahead_x - (places[:, 0] - near_x) * ahead_y)
    return places[(along > -_ASIDE_M) & (along < length_m + _BEHIND_KEY_M) & (aside < _ASIDE_M)]
