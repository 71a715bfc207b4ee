"""View of the robot for the Operator's picture: thinned LiDAR returns, path and obstacle."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Optional, Sequence

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2
from mtr_proto import robot_link_pb2 as link

# Two LiDARs have about 1400 beams; this many points five times a second are at most 12 kB/s, with the path 17 kB/s.
MAX_POINTS = 500
MAX_PATH_POINTS = 200
# No test takes place beyond this distance; the LiDARs measure up to 30 m.
_MAX_COORDINATE_M = 200.0
_CM_PER_M = 100.0


class Sweep(NamedTuple):
    """One LiDAR sweep at a time of the robot's clock; ranges_m: by beam, from first_rad on at steps of step_rad."""

    stamp_s: float
    ranges_m: Sequence[float]
    first_rad: float
    step_rad: float
    range_min_m: float
    range_max_m: float
    base_from_lidar: Pose2


class Motion(NamedTuple):
    """Motion of base_link at a time of the robot's clock."""

    stamp_s: float
    speed_mps: float
    yaw_rate_radps: float


class Obstacle(NamedTuple):
    """Obstacle of the collision stop from DriveStatus; distance_m and bearing_rad are NaN without an obstacle."""

    zone: int
    distance_m: float
    bearing_rad: float


class Surroundings(NamedTuple):
    """points: (n, 2) in base_link; path: (n, 2) in the Car coordinate system; m."""

    points: FloatArray
    path: FloatArray
    obstacle: Optional[Obstacle] = None


def points_of(sweeps: Sequence[Sweep], motion: Motion) -> FloatArray:
    """Return the returns of all sweeps in base_link at the motion's time, (n, 2) in m, evenly thinned."""
    found = [_carried(sweep, motion) for sweep in sweeps]
    points = np.concatenate(found) if found else np.empty((0, 2))
    return points[::max(1, math.ceil(len(points) / MAX_POINTS))]


def _carried(sweep: Sweep, motion: Motion) -> FloatArray:
    # A broken driver may send any value; drive control stops the robot for it.
    if not (math.isfinite(sweep.first_rad) and math.isfinite(sweep.step_rad)):
        return np.empty((0, 2))
    ranges = np.asarray(sweep.ranges_m, dtype=float)
    good = np.isfinite(ranges) & (ranges >= sweep.range_min_m) & (ranges < sweep.range_max_m)
    beams = sweep.first_rad + sweep.step_rad * np.nonzero(good)[0]
    lidar = np.column_stack((ranges[good] * np.cos(beams), ranges[good] * np.sin(beams)))
    age_s = motion.stamp_s - sweep.stamp_s
    moved = Pose2(motion.speed_mps * age_s, 0.0, motion.yaw_rate_radps * age_s)
    return transformed(moved.inverse() @ sweep.base_from_lidar, lidar)


def transformed(target_from_source: Pose2, points: FloatArray) -> FloatArray:
    """Return points (n, 2) in the target frame."""
    cos, sin = math.cos(target_from_source.heading), math.sin(target_from_source.heading)
    x, y = points[:, 0], points[:, 1]
    return np.column_stack((target_from_source.x + cos * x - sin * y, target_from_source.y + sin * x + cos * y))


def path_of(points: FloatArray, car_from_map: Pose2) -> FloatArray:
    """Return a path in map as a path in car, evenly thinned; its end is retained."""
    step = max(1, math.ceil(len(points) / (MAX_PATH_POINTS - 1)))
    return transformed(car_from_map, np.concatenate((points[::step], points[-1:]))) if len(points) else points


def fill(message: link.Surroundings, seen: Surroundings) -> None:
    """Write the surroundings; points beyond the range of all tests are omitted."""
    message.points_cm.extend(_centimetres(seen.points))
    message.path_cm.extend(_centimetres(seen.path))
    obstacle = seen.obstacle
    if obstacle is None:
        return
    # The enumeration of DriveStatus starts with CLEAR, the proto's with UNSPECIFIED.
    message.zone = obstacle.zone + link.STOP_ZONE_CLEAR if 0 <= obstacle.zone <= 3 else link.STOP_ZONE_UNSPECIFIED
    if math.isfinite(obstacle.distance_m) and math.isfinite(obstacle.bearing_rad):
        message.obstacle_m, message.obstacle_bearing_rad = obstacle.distance_m, obstacle.bearing_rad


def _centimetres(points: FloatArray) -> List[int]:
    near = points[(np.abs(points) < _MAX_COORDINATE_M).all(axis=1)]
    return [int(value) for value in np.rint(near * _CM_PER_M).ravel()]
