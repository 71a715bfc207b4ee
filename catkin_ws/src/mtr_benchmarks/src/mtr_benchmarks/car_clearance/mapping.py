"""Locates a Car from simulated scans around it and converts the result as the planner receives it."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Tuple

import numpy as np

from mtr_car_locator.conversions import estimate_message
from mtr_car_locator.estimate import Estimate
from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.find.prior import prior_at
from mtr_car_locator.measure.car_fit import CarFit
from mtr_car_locator.measure.close_up import CloseUp
from mtr_car_locator.parameters import DataSheet, LocatorParameters
from mtr_car_locator.rectangle import Rectangle
from mtr_car_locator.survey.surfel_grid import SurfelGrid
from mtr_core.arrays import FloatArray
from mtr_core.problems import NO_PROBLEM
from mtr_core.se2 import Pose2
from mtr_core.states import CarState
from mtr_motion_planner.conversions import car_from
from mtr_motion_planner.inputs import EstimatedCar

from .bodies import TrueCar
from .draw import SIZE, WHOLE, RandomClearanceCar

LIDAR_HEIGHT_M, RING_M, VIEW_STEP_M, BEAMS = 0.30, 1.6, 0.12, 720
RANGE_SIGMA_M, POSE_SIGMA_M = 0.008, 0.002
# Error of the starting place that the Operator entered.
PRIOR_ERROR = Pose2(0.2, -0.15, 0.05)


def sheet_of(drawn: RandomClearanceCar) -> DataSheet:
    """Return the data sheet that the laboratory has entered for the Car."""
    car = drawn.car
    if drawn.sheet == WHOLE:
        return DataSheet(known_length_m=car.length_m, known_width_m=car.width_m, wheelbase_m=car.wheelbase_m,
                         front_overhang_m=car.front_overhang_m)
    return DataSheet(known_length_m=car.length_m, known_width_m=car.width_m) if drawn.sheet == SIZE else DataSheet()


def located(drawn: RandomClearanceCar, chance: np.random.Generator) -> CarFit:
    """Return the located Car in map.

    Raises:
        NotLocated: the locator asks the Operator instead.
    """
    parameters = LocatorParameters(sheet=sheet_of(drawn))
    views = _views(drawn.car)
    segments = np.vstack([_closed(corners) for corners in drawn.car.section(LIDAR_HEIGHT_M)])
    grid, points, beams = SurfelGrid(drawn.pose.x, drawn.pose.y), [], []
    for view in views:
        directions, ranges = _seen(view, segments, chance)
        place, seen = _in_map(drawn.pose, np.array([view]))[0], _in_map(drawn.pose, view + ranges * directions)
        grid.add(seen, place)
        points.append(seen)
        beams.append(_turned(directions, drawn.pose.heading))
    guess = prior_at(Rectangle(drawn.pose @ PRIOR_ERROR, parameters.sheet.length_m, parameters.sheet.width_m))
    return fit_car(grid.surfels(POSE_SIGMA_M), guess, parameters, CloseUp(np.concatenate(points),
                                                                          np.concatenate(beams)))


def received(fit: CarFit, now_s: float) -> EstimatedCar:
    """Return the located Car after a round trip through the message that the planner receives."""
    estimate = Estimate(CarState.LOCATED, fit.rectangle, fit.outline, fit.sigmas, fit.length_sigma, fit.width_sigma,
                        None, 1, NO_PROBLEM, 1, side_sigmas=fit.side_sigmas)
    car = car_from(estimate_message(estimate, None), now_s)
    assert car
    return car


def _views(car: TrueCar) -> List[FloatArray]:
    """Return the robot's positions on the path around the Car, in the Car's frame."""
    half_x, half_y = 0.5 * car.length_m + RING_M, 0.5 * car.width_m + RING_M
    corners = np.array([(half_x, half_y), (-half_x, half_y), (-half_x, -half_y), (half_x, -half_y)])
    return [a + share * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0))
            for share in np.arange(0.0, 1.0, VIEW_STEP_M / float(np.hypot(*(b - a))))]


def _closed(corners: Tuple[Tuple[float, float], ...]) -> FloatArray:
    points = np.array(corners)
    return np.hstack((points, np.roll(points, -1, axis=0)))


def _seen(view: FloatArray, segments: FloatArray, chance: np.random.Generator) -> Tuple[FloatArray, FloatArray]:
    """Return directions (n, 2) of the beams that hit an edge, and their ranges (n, 1)."""
    angles = 2.0 * math.pi * (np.arange(BEAMS) + chance.random()) / BEAMS
    directions = np.column_stack((np.cos(angles), np.sin(angles)))
    start, along = segments[:, :2] - view, segments[:, 2:] - segments[:, :2]
    cross = directions[:, :1] * along[:, 1] - directions[:, 1:] * along[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = (start[:, 0] * along[:, 1] - start[:, 1] * along[:, 0]) / cross
        share = (start[:, 0] * directions[:, 1:] - start[:, 1] * directions[:, :1]) / cross
    reach[~((share >= 0.0) & (share <= 1.0) & (reach > 0.0))] = np.inf
    nearest = reach.min(axis=1)
    hit = np.isfinite(nearest)
    ranges = nearest[hit] + chance.normal(0.0, RANGE_SIGMA_M, int(hit.sum()))
    return directions[hit], ranges[:, None]


def _turned(vectors: FloatArray, heading: float) -> FloatArray:
    cos, sin = math.cos(heading), math.sin(heading)
    return np.column_stack((cos * vectors[:, 0] - sin * vectors[:, 1], sin * vectors[:, 0] + cos * vectors[:, 1]))


def _in_map(pose: Pose2, points: FloatArray) -> FloatArray:
    return _turned(points, pose.heading) + (pose.x, pose.y)
