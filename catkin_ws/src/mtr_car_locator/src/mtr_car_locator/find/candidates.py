"""Candidate rectangles: pairs of opposite surfaces at a Car's distance, near the expected place."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from dataclasses import dataclass
from typing import Iterator, List, Optional, Tuple

import numpy as np

from mtr_core.arrays import BoolArray
from mtr_core.se2 import Pose2

from ..measure.side import ENDS, LONG_SIDES, MIDDLE_SHARE, side_of
from ..measure.wheels import FACE_DEPTH_M, MAX_FACE_M, CarWheels, wheel_sides, wheels_between
from ..parameters import DataSheet, LocatorParameters
from ..rectangle import Rectangle
from ..surfels import SAMPLE_M, Surfels
from .far_tyres import with_far_tyres
from .levels import levels, peaks, sharpness, smoothed
from .prior import Prior
from .scoring import Score, score_of

# Surfaces within this distance beyond the expected Car and its position tolerance are considered.
MARGIN_M = 0.8
HEADING_BIN_RAD, HEADING_SIGMA_BINS = math.radians(0.5), 3.0
MAX_HEADINGS, MIN_SHARE_OF_BEST_HEADING = 3, 0.4
# Directions of the few surfaces of wheels may have a common error of this number of bins, in both directions.
FAN_STEPS = 10


@dataclass(frozen=True)
class CarCandidate:
    """A rectangle with its score and supporting surfels; with wheels if neither front nor rear was seen."""

    car: Rectangle
    score: Score
    seen: Surfels
    wheels: Optional[CarWheels] = None


def near(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> Surfels:
    """Return the surfels that may belong to the Car."""
    car, swing_m = prior.car, prior.reach_m * parameters.heading_tolerance_rad
    reach = 0.5 * math.hypot(car.length, car.width) + parameters.position_tolerance_m + swing_m + MARGIN_M
    return surfels.where(np.hypot(*(surfels.position - (car.pose.x, car.pose.y)).T) < reach)


def candidates(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> List[CarCandidate]:
    """Return the candidates within the tolerance of the prior, best first."""
    sheet = parameters.sheet
    found = []
    for turn in headings(surfels, prior, parameters.heading_tolerance_rad):
        frame = prior.car.pose @ Pose2(0.0, 0.0, turn)
        for in_frame in with_far_tyres(surfels.in_frame(frame)):
            seen = in_frame.in_frame(frame.inverse())
            for car, wheels in _rectangles(in_frame, sheet):
                placed = Rectangle(frame @ car.pose, car.length, car.width)
                if is_allowed(placed, prior, parameters):
                    found.append(CarCandidate(placed, score_of(seen, placed, prior, sheet), seen, wheels))
    return sorted(found, key=lambda each: -each.score.total)


def is_allowed(car: Rectangle, prior: Prior, parameters: LocatorParameters) -> bool:
    """Return True if the candidate is within the Operator's placement tolerance."""
    off_m, off_rad = prior.error_of(car.pose)
    return off_m <= parameters.position_tolerance_m and off_rad <= parameters.heading_tolerance_rad


def headings(surfels: Surfels, prior: Prior, tolerance_rad: float) -> List[float]:
    """Return the turns from the prior's heading with much surface parallel or perpendicular to the Car."""
    turn = np.arctan2(surfels.normal[:, 1], surfels.normal[:, 0]) - prior.car.pose.heading
    quarter = np.remainder(turn + 0.25 * math.pi, 0.5 * math.pi) - 0.25 * math.pi
    edges = np.arange(-0.25 * math.pi, 0.25 * math.pi + HEADING_BIN_RAD, HEADING_BIN_RAD)
    counts, edges = np.histogram(quarter, bins=edges, weights=surfels.length)
    density = smoothed(counts, HEADING_SIGMA_BINS)
    density[np.abs(0.5 * (edges[:-1] + edges[1:])) > tolerance_rad] = 0.0
    best = peaks(density, MIN_SHARE_OF_BEST_HEADING * density.max())[:MAX_HEADINGS]
    found = [float(0.5 * (edges[index] + edges[index + 1])) for index in best]
    for peak in list(found):
        for correction in sharp_turns(surfels.in_frame(prior.car.pose @ Pose2(0.0, 0.0, peak))):
            sharper = peak + correction
            if abs(sharper) <= tolerance_rad and all(abs(sharper - other) >= HEADING_BIN_RAD for other in found):
                found.append(sharper)
    return found


def sharp_turns(seen: Surfels) -> List[float]:
    """Return the turns, in rad, with the sharpest levels of the long sides: with all surfaces, and without bodies.

    The side of another car parked alongside has more surface than the wheels of the Car. The positions of a wheel's few
    surfaces are known better than their directions, and two wheels of a side are far apart.
    """
    of_all = _sharpest(seen)
    turned = seen.in_frame(Pose2(0.0, 0.0, of_all))
    return [of_all, of_all + _sharpest(turned.where(~_is_body(turned)))]


def _sharpest(seen: Surfels) -> float:
    best_turn, best = 0.0, -1.0
    for step in range(-FAN_STEPS, FAN_STEPS + 1):
        # Start with the smallest turn, so that it wins among equal ones.
        turn = HEADING_BIN_RAD * ((step + FAN_STEPS + 1) // 2) * (-1.0) ** (step + FAN_STEPS)
        turned = seen.in_frame(Pose2(0.0, 0.0, turn))
        found = sum(sharpness(side_of(name, turned, -math.inf)) for name in LONG_SIDES)
        if found > best:
            best_turn, best = turn, found
    return best_turn


def _is_body(seen: Surfels) -> BoolArray:
    """Return a mask of the surfels at levels of the long sides that have more surface than two tyres."""
    found = np.zeros(len(seen), dtype=bool)
    for side in (side_of(name, seen, -math.inf) for name in LONG_SIDES):
        for level in levels(side):
            there = np.abs(side.outward - level) <= FACE_DEPTH_M
            if np.count_nonzero(there) * SAMPLE_M > 2.0 * MAX_FACE_M:
                found[side.surfel[there]] = True
    return found


def _rectangles(seen: Surfels, sheet: DataSheet) -> Iterator[Tuple[Rectangle, Optional[CarWheels]]]:
    """Yield rectangles in a frame whose x axis is the Car's."""
    left, right = (side_of(name, seen, -math.inf) for name in LONG_SIDES)
    front, rear = (side_of(name, seen, -math.inf) for name in ENDS)
    treads = wheel_sides(seen)
    for y, width in _spans(levels(left), levels(right), sheet.width_m, sheet.size_tolerance_m / 2.0):
        middle = (y - 0.5 * MIDDLE_SHARE * width, y + 0.5 * MIDDLE_SHARE * width)
        ahead, behind = levels(front.within(*middle)), levels(rear.within(*middle))
        for x, length in _spans(ahead, behind, sheet.length_m, sheet.size_tolerance_m):
            yield Rectangle(Pose2(x, y, 0.0), length, width), None
        for wheels in wheels_between(treads, y, width, sheet):
            yield Rectangle(Pose2(wheels.ends.centre_m, y, 0.0), wheels.ends.length_m, width), wheels


def _spans(ahead: List[float], behind: List[float], expected_m: float,
           tolerance_m: float) -> Iterator[Tuple[float, float]]:
    """Yield middle and size between opposite surfaces, one of which may be unseen."""
    for a, b in itertools.product(ahead, behind):
        if abs(a + b - expected_m) <= tolerance_m:
            yield 0.5 * (a - b), a + b
    yield from ((a - 0.5 * expected_m, expected_m) for a in ahead)
    yield from ((0.5 * expected_m - b, expected_m) for b in behind)
