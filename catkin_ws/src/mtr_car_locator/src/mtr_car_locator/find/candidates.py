"""Rectangles that may be the Car: pairs of opposite surfaces at a Car's distance, near where it should stand."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from dataclasses import dataclass
from typing import Iterator, List, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2

from ..measure.side import ENDS, LONG_SIDES, MIDDLE_SHARE, Side, side_of
from ..measure.wheels import CarWheels, wheel_sides, wheels_between
from ..parameters import DataSheet, LocatorParameters
from ..rectangle import Rectangle
from ..surfels import SAMPLE_M, Surfels
from .prior import Prior
from .scoring import Score, score_of

# Surface within this distance beyond the expected Car and the tolerance of its place may be its own.
MARGIN_M = 0.8
HEADING_BIN_RAD, HEADING_SIGMA_BINS = math.radians(0.5), 3.0
MAX_HEADINGS, MIN_SHARE_OF_BEST_HEADING = 3, 0.4
# Directions of a few surfaces of wheels are off by so many bins together, either way.
FAN_STEPS = 10
LEVEL_BIN_M, LEVEL_SIGMA_BINS = 0.02, 1.5
# So much surface makes a level: half a sill, or the middle of a bumper.
MIN_SURFACE_M = {"front": 0.25, "rear": 0.25, "left": 0.4, "right": 0.4}
MAX_LEVELS = 5


@dataclass(frozen=True)
class CarCandidate:
    """A rectangle with its evidence; wheels when neither front nor rear was seen."""

    car: Rectangle
    score: Score
    wheels: Optional[CarWheels] = None


def near(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> Surfels:
    """Those that may be the Car's."""
    car, swing_m = prior.car, prior.reach_m * parameters.heading_tolerance_rad
    reach = 0.5 * math.hypot(car.length, car.width) + parameters.position_tolerance_m + swing_m + MARGIN_M
    return surfels.where(np.hypot(*(surfels.position - (car.pose.x, car.pose.y)).T) < reach)


def candidates(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> List[CarCandidate]:
    """Candidates within the tolerance of the prior, best first."""
    sheet = parameters.sheet
    found = []
    for turn in headings(surfels, prior, parameters.heading_tolerance_rad):
        frame = prior.car.pose @ Pose2(0.0, 0.0, turn)
        for car, wheels in _rectangles(surfels.in_frame(frame), sheet):
            placed = Rectangle(frame @ car.pose, car.length, car.width)
            if is_allowed(placed, prior, parameters):
                found.append(CarCandidate(placed, score_of(surfels, placed, prior, sheet), wheels))
    return sorted(found, key=lambda each: -each.score.total)


def is_allowed(car: Rectangle, prior: Prior, parameters: LocatorParameters) -> bool:
    """True when the Operator may have been so wrong."""
    off_m, off_rad = prior.error_of(car.pose)
    return off_m <= parameters.position_tolerance_m and off_rad <= parameters.heading_tolerance_rad


def headings(surfels: Surfels, prior: Prior, tolerance_rad: float) -> List[float]:
    """Turns from the prior's heading at which much surface is parallel or square to the Car."""
    turn = np.arctan2(surfels.normal[:, 1], surfels.normal[:, 0]) - prior.car.pose.heading
    quarter = np.remainder(turn + 0.25 * math.pi, 0.5 * math.pi) - 0.25 * math.pi
    edges = np.arange(-0.25 * math.pi, 0.25 * math.pi + HEADING_BIN_RAD, HEADING_BIN_RAD)
    counts, edges = np.histogram(quarter, bins=edges, weights=surfels.length)
    density = smoothed(counts, HEADING_SIGMA_BINS)
    density[np.abs(0.5 * (edges[:-1] + edges[1:])) > tolerance_rad] = 0.0
    best = peaks(density, MIN_SHARE_OF_BEST_HEADING * density.max())[:MAX_HEADINGS]
    found = [float(0.5 * (edges[index] + edges[index + 1])) for index in best]
    for peak in list(found):
        sharper = peak + sharpest(surfels.in_frame(prior.car.pose @ Pose2(0.0, 0.0, peak)))
        if abs(sharper) <= tolerance_rad and all(abs(sharper - other) >= HEADING_BIN_RAD for other in found):
            found.append(sharper)
    return found


def sharpest(seen: Surfels) -> float:
    """Turn of the frame, in rad, in which the long sides' surface lies at the sharpest levels.

    The places of a wheel's few surfaces are known better than their directions, and two wheels of a side lie far apart.
    """
    best_turn, best = 0.0, -1.0
    for step in range(-FAN_STEPS, FAN_STEPS + 1):
        # From the middle outwards, so that of two alike the smaller turn is kept.
        turn = HEADING_BIN_RAD * ((step + FAN_STEPS + 1) // 2) * (-1.0) ** (step + FAN_STEPS)
        turned = seen.in_frame(Pose2(0.0, 0.0, turn))
        sharpness = sum(_sharpness(side_of(name, turned, -math.inf)) for name in LONG_SIDES)
        if sharpness > best:
            best_turn, best = turn, sharpness
    return best_turn


def _sharpness(side: Side) -> float:
    """Sum of the squares of the surface at each level."""
    density = smoothed(_surface_by_level(side)[0], LEVEL_SIGMA_BINS)
    return float(density @ density)


def levels(side: Side) -> List[float]:
    """Distances outwards at which the side has much surface, the most first."""
    surface_m, low = _surface_by_level(side)
    density = smoothed(surface_m, LEVEL_SIGMA_BINS)
    # A single level of surface s makes a peak of this height.
    height = MIN_SURFACE_M[side.name] / (LEVEL_SIGMA_BINS * math.sqrt(2.0 * math.pi))
    return [low + (index + 0.5) * LEVEL_BIN_M for index in peaks(density, height)[:MAX_LEVELS]]


def _surface_by_level(side: Side) -> Tuple[FloatArray, float]:
    """Surface in m in each bin of LEVEL_BIN_M outwards, and where the first begins."""
    if len(side.outward) == 0:
        return np.zeros(1), 0.0
    low = side.outward.min() - 5 * LEVEL_BIN_M
    count = math.ceil((side.outward.max() - low) / LEVEL_BIN_M) + 5
    counts, _ = np.histogram(side.outward, bins=count, range=(low, low + count * LEVEL_BIN_M))
    return counts * SAMPLE_M, float(low)


def smoothed(values: FloatArray, sigma_bins: float) -> FloatArray:
    """Convolution with a Gaussian."""
    reach = np.arange(-math.ceil(3 * sigma_bins), math.ceil(3 * sigma_bins) + 1)
    kernel = np.exp(-0.5 * (reach / sigma_bins) ** 2)
    return np.convolve(values.astype(float), kernel / kernel.sum(), mode="same")


def peaks(density: FloatArray, minimum: float) -> List[int]:
    """Indices of the local maxima above a height, highest first."""
    padded = np.concatenate(([-1.0], density, [-1.0]))
    top = (density > padded[:-2]) & (density >= padded[2:]) & (density > 0.0) & (density >= minimum)
    return sorted(np.nonzero(top)[0].tolist(), key=lambda index: -density[index])


def _rectangles(seen: Surfels, sheet: DataSheet) -> Iterator[Tuple[Rectangle, Optional[CarWheels]]]:
    """Rectangles in the frame of seen, whose x axis is the Car's."""
    left, right = (side_of(name, seen, -math.inf) for name in LONG_SIDES)
    front, rear = (side_of(name, seen, -math.inf) for name in ENDS)
    treads = wheel_sides(seen)
    for y, width in _spans(levels(left), levels(right), sheet.width_m, sheet.size_tolerance_m / 2.0):
        middle = (y - 0.5 * MIDDLE_SHARE * width, y + 0.5 * MIDDLE_SHARE * width)
        ahead, behind = levels(front.within(*middle)), levels(rear.within(*middle))
        for x, length in _spans(ahead, behind, sheet.length_m, sheet.size_tolerance_m):
            yield Rectangle(Pose2(x, y, 0.0), length, width), None
        for wheels in wheels_between(treads, y, width, sheet):
            yield Rectangle(Pose2(wheels.centre_m, y, 0.0), wheels.length_m, width), wheels


def _spans(ahead: List[float], behind: List[float], expected_m: float,
           tolerance_m: float) -> Iterator[Tuple[float, float]]:
    """Middle and size between opposite surfaces, one of which may not have been seen."""
    for a, b in itertools.product(ahead, behind):
        if abs(a + b - expected_m) <= tolerance_m:
            yield 0.5 * (a - b), a + b
    yield from ((a - 0.5 * expected_m, expected_m) for a in ahead)
    yield from ((0.5 * expected_m - b, expected_m) for b in behind)
