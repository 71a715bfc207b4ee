"""Simulated view of a Car in the LiDAR plane from a robot that drives around it: the mapper's surfels and all
returns."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple

import numpy as np

from mtr_car_locator.measure.close_up import CloseUp
from mtr_car_locator.surfels import Surfels
from mtr_car_locator.survey.surfel_grid import SurfelGrid
from mtr_core import sensor_figures
from mtr_core.arrays import FloatArray
from mtr_simulation.noise import stream

# Number of places around the Car, their distance from it, and number and field of the beams towards it.
PLACES, RING_M, BEAMS, FIELD_RAD = 240, 1.6, 300, math.radians(160.0)
NOISE_M, MAP_SIGMA_M = sensor_figures.SIMULATED_RANGE_NOISE_M[0], 0.002


class View(NamedTuple):
    """Surfels and close-up in the frame of the segments."""

    surfels: Surfels
    close_up: CloseUp


def view_of(segments: FloatArray, length_m: float, width_m: float, seed: int) -> View:
    """Return the surfaces as a LiDAR with noise measures them from a rounded path around the Car's rectangle."""
    noise = stream(seed, "ranges at a car with different ends")
    grid, points, beams = SurfelGrid(0.0, 0.0), [], []
    for viewer in _ring(0.5 * length_m, 0.5 * width_m):
        angles = math.atan2(-viewer[1], -viewer[0]) + np.linspace(-0.5, 0.5, BEAMS) * FIELD_RAD
        directions = np.column_stack((np.cos(angles), np.sin(angles)))
        ranges = cast(viewer, directions, segments)
        is_hit = np.isfinite(ranges)
        away = directions[is_hit]
        seen = viewer + (ranges[is_hit] + noise.normal(0.0, NOISE_M, is_hit.sum()))[:, np.newaxis] * away
        grid.add(seen, viewer)
        points.append(seen)
        beams.append(away)
    return View(grid.surfels(MAP_SIGMA_M), CloseUp(np.concatenate(points), np.concatenate(beams)))


def _ring(x_m: float, y_m: float) -> FloatArray:
    """Return places (n, 2) at the same distance from the rectangle, equally spaced along the path."""
    turns = np.linspace(0.0, 2.0 * math.pi, 2000, endpoint=False)
    corners = np.column_stack((np.sign(np.cos(turns)) * x_m, np.sign(np.sin(turns)) * y_m))
    way = corners + RING_M * np.column_stack((np.cos(turns), np.sin(turns)))
    steps = np.linalg.norm(np.diff(way, axis=0, append=way[:1]), axis=1)
    along = np.concatenate(([0.0], np.cumsum(steps)))
    closed = np.vstack((way, way[:1]))
    wanted = np.linspace(0.0, along[-1], PLACES, endpoint=False)
    return np.column_stack([np.interp(wanted, along, closed[:, axis]) for axis in (0, 1)])


def cast(viewer: FloatArray, directions: FloatArray, segments: FloatArray) -> FloatArray:
    """Return the distance to the nearest segment along each direction (n, 2); infinite if there is none."""
    start, edge = segments[:, :2] - viewer, segments[:, 2:] - segments[:, :2]
    cos, sin = directions[:, :1], directions[:, 1:]
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = cos * edge[:, 1] - sin * edge[:, 0]
        along = (start[:, 0] * edge[:, 1] - start[:, 1] * edge[:, 0]) / cross
        share = (start[:, 0] * sin - start[:, 1] * cos) / cross
        is_hit = (along > 0.0) & (share >= 0.0) & (share <= 1.0)
    return np.where(is_hit, along, np.inf).min(axis=1)
