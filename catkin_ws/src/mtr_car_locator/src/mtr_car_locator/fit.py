"""Fits the Car's rectangle to points in map."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

import numpy as np

from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2

from .cluster import car_points, in_frame
from .heading import search_heading, slope_of_sides
from .parameters import LocatorParameters
from .profile import Profile, profile_of
from .rectangle import Rectangle

LEAST_CELLS = 60
# A small cluster that sticks out of what the rest shows is a bystander.
SMALL_SHARE = 0.10
STICKS_OUT_M = 0.05
HEADING_SIGMA_RAD = math.radians(0.5)
SIDES = ("front", "rear", "left", "right")
HEADING_ROUNDS = 3


class NotLocated(RobotError):
    """The points do not show a Car that can be trusted; the text says why."""


@dataclass(frozen=True)
class CarFit:
    """Rectangle, 1-sigma errors of length, width and heading, and the sides that were seen."""

    rectangle: Rectangle
    length_sigma: float
    width_sigma: float
    heading_sigma: float
    seen: Tuple[str, ...]


def fit_car(points: np.ndarray, hits: np.ndarray, prior: Rectangle, parameters: LocatorParameters) -> CarFit:
    """The Car near the prior; a side that was not seen is placed by the expected size. NotLocated when in doubt."""
    index, labels = car_points(points, prior)
    if len(index) < LEAST_CELLS:
        raise NotLocated("There is nothing of a Car's size where the Car should stand; check the starting place.")
    points, hits = points[index], hits[index]
    kept = _without_bystanders(points, hits, labels, prior)
    points, hits = points[kept], hits[kept]
    fit = _fit(points, hits, prior, parameters)
    _check(fit.rectangle, prior, parameters)
    return fit


def _fit(points: np.ndarray, hits: np.ndarray, prior: Rectangle, parameters: LocatorParameters) -> CarFit:
    frame = _frame(points, hits, prior)
    sides = profiles_of(points, hits, frame.pose)
    found = {name: sides[name].extent() for name in SIDES if sides[name].is_seen(_length_of(name, frame))}
    found = {name: extent for name, extent in found.items() if extent is not None}
    if not ({"front", "rear"} & set(found) and {"left", "right"} & set(found)):
        raise NotLocated("Not enough of the Car was seen: one long side and one end are needed at least.")
    unseen_sigma = parameters.size_tolerance_m / 2.0
    x, length, length_sigma = _span(found, ("front", "rear"), parameters.expected_length_m, unseen_sigma)
    y, width, width_sigma = _span(found, ("left", "right"), parameters.expected_width_m, unseen_sigma)
    return CarFit(Rectangle(frame.pose @ Pose2(x, y, 0.0), length, width), length_sigma, width_sigma,
                  HEADING_SIGMA_RAD, tuple(name for name in SIDES if name in found))


def _frame(points: np.ndarray, hits: np.ndarray, prior: Rectangle) -> Rectangle:
    """The prior, turned to the heading of the points and moved to their middle."""
    frame = prior.turned_by(search_heading(points, prior))
    low, high = np.quantile(in_frame(points, frame.pose), (0.02, 0.98), axis=0)
    middle = [0.5 * (a + b) if b - a > 0.8 * size else 0.0
              for a, b, size in zip(low, high, (prior.length, prior.width))]
    frame = Rectangle(frame.pose @ Pose2(middle[0], middle[1], 0.0), prior.length, prior.width)
    for _ in range(HEADING_ROUNDS):
        sides = profiles_of(points, hits, frame.pose)
        frame = frame.turned_by(math.atan(slope_of_sides(sides["left"], sides["right"], prior.length)))
    return frame


def profiles_of(points: np.ndarray, hits: np.ndarray, pose: Pose2) -> Dict[str, Profile]:
    """Profiles of the four sides of a Car whose frame is pose."""
    x, y = in_frame(points, pose).T
    return {"front": profile_of(y, x, hits), "rear": profile_of(y, -x, hits),
            "left": profile_of(x, y, hits), "right": profile_of(x, -y, hits)}


def _length_of(side: str, rectangle: Rectangle) -> float:
    return rectangle.width if side in ("front", "rear") else rectangle.length


def _span(found: Dict[str, Tuple[float, float]], names: Tuple[str, str], expected_m: float,
          unseen_sigma_m: float) -> Tuple[float, float, float]:
    """Middle, size and sigma of the size between two opposite sides; an unseen one is put at the expected size."""
    ahead, behind = found.get(names[0]), found.get(names[1])
    if ahead and behind:
        return 0.5 * (ahead[0] - behind[0]), ahead[0] + behind[0], math.hypot(ahead[1], behind[1])
    if ahead:
        return ahead[0] - 0.5 * expected_m, expected_m, unseen_sigma_m
    return 0.5 * expected_m - behind[0], expected_m, unseen_sigma_m


def _without_bystanders(points: np.ndarray, hits: np.ndarray, labels: np.ndarray, prior: Rectangle) -> np.ndarray:
    """True for the points that stay when small clusters that stick out of the rest are taken away."""
    keep = np.ones(len(points), dtype=bool)
    for label in np.unique(labels):
        mine = labels == label
        if np.count_nonzero(mine) > SMALL_SHARE * len(points):
            continue
        rest = keep & ~mine
        if np.count_nonzero(rest) >= LEAST_CELLS and _sticks_out(points[mine], points[rest], hits[rest], prior):
            keep = rest
    return keep


def _sticks_out(cluster: np.ndarray, rest: np.ndarray, hits: np.ndarray, prior: Rectangle) -> bool:
    frame = _frame(rest, hits, prior)
    sides = profiles_of(rest, hits, frame.pose)
    x, y = np.median(in_frame(cluster, frame.pose), axis=0)
    outward = {"front": x, "rear": -x, "left": y, "right": -y}
    levels: List[Tuple[float, Optional[Tuple[float, float]]]] = [
        (outward[name], sides[name].extent()) for name in SIDES if sides[name].is_seen(_length_of(name, frame))]
    return any(extent is not None and value > extent[0] + STICKS_OUT_M for value, extent in levels)


def _check(found: Rectangle, prior: Rectangle, parameters: LocatorParameters) -> None:
    for name, size, expected in (("length", found.length, parameters.expected_length_m),
                                 ("width", found.width, parameters.expected_width_m)):
        if abs(size - expected) > parameters.size_tolerance_m:
            raise NotLocated(f"What was found has a {name} of {size:.2f} m; expected is {expected:.2f} m, at most "
                             f"{parameters.size_tolerance_m:.2f} m off.")
    shift = found.pose.distance_to(prior.pose)
    if shift > parameters.position_tolerance_m:
        raise NotLocated(f"What was found is {shift:.2f} m away from where the Car should stand; allowed is "
                         f"{parameters.position_tolerance_m:.2f} m.")
