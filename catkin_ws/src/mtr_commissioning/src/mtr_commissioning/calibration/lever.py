"""Key's lever in base_link: the key touches the same plumb line from several headings of the robot.

Localization supplies the robot's poses; the plumb line is fixed: p_i + R(heading_i) lever = line. Least squares over
all poses determine lever and line together, and the residuals determine the lever's accuracy.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2

from .readings import Estimate, ReadingsUnusable

# Two unknowns of the lever and two of the line; one additional pose tests the agreement of the others.
MIN_PLACES = 4
# With a smaller spread of headings the line is not determined along the robot's direction.
MIN_SPREAD_RAD = math.radians(120.0)
# Accuracy of a contact by hand and a pose; a larger sigma means a swinging key or a wrong reading.
MAX_SIGMA_M = 0.01


@dataclass(frozen=True)
class Lever:
    """Lever of the key in base_link: ahead and to the left, m."""

    ahead: Estimate
    left: Estimate


def lever_of(places: Sequence[Pose2]) -> Lever:
    """Estimate the lever from the robot's poses, in map, at which the key touched the line.

    Raises:
        ReadingsUnusable: too few poses, headings too similar, or contradicting poses.
    """
    if len(places) < MIN_PLACES:
        raise ReadingsUnusable(f"The key touched the line at {len(places)} headings; at least {MIN_PLACES} are needed.")
    spread_rad = spread_of([place.heading for place in places])
    if spread_rad < MIN_SPREAD_RAD:
        raise ReadingsUnusable(f"The headings cover {math.degrees(spread_rad):.0f} degrees; at least "
                               f"{math.degrees(MIN_SPREAD_RAD):.0f} are needed. Turn the robot farther.")
    rows, targets = _equations(places)
    solution = np.linalg.lstsq(rows, targets, rcond=None)[0]
    freedom = len(targets) - len(solution)
    variance = float(np.sum((targets - rows @ solution) ** 2)) / freedom
    sigmas = np.sqrt(np.diag(np.linalg.inv(rows.T @ rows)) * variance)
    worst_mm = 1000.0 * max(sigmas[:2])
    if worst_mm > 1000.0 * MAX_SIGMA_M:
        raise ReadingsUnusable(f"The places contradict each other: 1 sigma of the lever is {worst_mm:.0f} mm; allowed "
                               f"is {1000.0 * MAX_SIGMA_M:.0f} mm. Let the line hang still, have the robot stand "
                               "before each reading, and read again.")
    ahead, left = (Estimate(float(solution[index]), float(sigmas[index]), float(freedom)) for index in (0, 1))
    return Lever(ahead, left)


def spread_of(headings_rad: Sequence[float]) -> float:
    """Return the full turn less the largest gap between neighbouring headings, rad."""
    ordered = sorted(heading % (2.0 * math.pi) for heading in headings_rad)
    gaps = [after - before for before, after in zip(ordered, [*ordered[1:], ordered[0] + 2.0 * math.pi])]
    return 2.0 * math.pi - max(gaps)


def _equations(places: Sequence[Pose2]) -> Tuple[FloatArray, FloatArray]:
    rows, targets = [], []
    for place in places:
        cos, sin = math.cos(place.heading), math.sin(place.heading)
        rows += [[cos, -sin, -1.0, 0.0], [sin, cos, 0.0, -1.0]]
        targets += [-place.x, -place.y]
    return np.array(rows), np.array(targets)
