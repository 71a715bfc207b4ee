"""Front and rear of the Car along its x axis: from bumpers in the scan plane, axles and data sheet.

In the scan plane, a bumper is behind the outermost part of its end by an unknown inset. Insets of front and rear are
independent and not negative. Their prior is half-normal: if an end is published at the scan plane, its true position is
farther out by at most 2 sigma in 95 % of all cars.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Tuple

import numpy as np
from scipy.special import log_ndtr

from mtr_core.arrays import FloatArray

from ..parameters import DATA_SHEET_SIGMA_M
from .side import SideExtent

# A bumper contradicts axles and data sheet if it is this much beyond the end that they define.
CONTRADICTION_SIGMAS = 4.0
# With a larger inset, in sigmas of its prior, the axle is probably false.
IMPLAUSIBLE_SIGMAS = 3.0
GRID_POINTS, GRID_SIGMAS = 2001, 5.0


class Estimate(NamedTuple):
    """A distance outwards, m, and its 1 sigma."""

    value_m: float
    sigma_m: float


@dataclass(frozen=True)
class EndEvidence:
    """Evidence of one end, by distances outwards from the frame's origin.

    Attributes:
        level: of the bumper in the scan plane; None if it was not seen.
        inset_sigma_m: sigma of the half-normal prior of the inset.
        by_axle: the end from its axle and overhang; None if these are unknown.
    """

    level: Optional[SideExtent]
    inset_sigma_m: float
    by_axle: Optional[Estimate] = None

    @property
    def alone(self) -> Optional[Estimate]:
        """Return the end without the other one.

        The inset's mean is not corrected, so a distance from it is never too short.
        """
        if self.by_axle is not None:
            return self.by_axle
        if self.level is None:
            return None
        return Estimate(self.level.level, math.hypot(self.level.sigma, self.inset_sigma_m))

    def contradiction_m(self, *, is_axle_sure: bool) -> float:
        """Return the significant excess of the bumper beyond the end from the axle; otherwise 0.

        A negative value means that the bumper is so far inside that the axle is probably false; is_axle_sure excludes
        that.
        """
        if self.level is None or self.by_axle is None:
            return 0.0
        beyond_m = self.level.level - self.by_axle.value_m
        allowed_m = CONTRADICTION_SIGMAS * math.hypot(self.level.sigma, self.by_axle.sigma_m)
        is_inside = beyond_m < -allowed_m - IMPLAUSIBLE_SIGMAS * self.inset_sigma_m
        return beyond_m if beyond_m > allowed_m or (is_inside and not is_axle_sure) else 0.0

    def log_likelihood(self, outward_m: FloatArray, common_sigma_m: float = 0.0) -> FloatArray:
        """Return the log likelihood of the end at these distances; common_sigma_m is added to each error."""
        total = np.zeros_like(outward_m)
        if self.by_axle is not None:
            sigma_m = math.hypot(self.by_axle.sigma_m, common_sigma_m)
            total -= 0.5 * np.square((outward_m - self.by_axle.value_m) / sigma_m)
        if self.level is not None:
            # A normal error plus a half-normal inset has a skew normal density.
            inset_m, sigma_m = outward_m - self.level.level, math.hypot(self.level.sigma, common_sigma_m)
            whole_m = math.hypot(sigma_m, self.inset_sigma_m)
            total += log_ndtr(inset_m * self.inset_sigma_m / (sigma_m * whole_m)) - 0.5 * np.square(inset_m / whole_m)
        return total

    def reach(self) -> Tuple[float, float]:
        """Return the distances between which the end lies."""
        pieces = []
        if self.by_axle is not None:
            value_m, sigma_m = self.by_axle
            pieces.append((value_m - GRID_SIGMAS * sigma_m, value_m + GRID_SIGMAS * sigma_m))
        if self.level is not None:
            pieces.append((self.level.level - GRID_SIGMAS * self.level.sigma,
                           self.level.level + GRID_SIGMAS * math.hypot(self.level.sigma, self.inset_sigma_m)))
        return min(low for low, _ in pieces), max(high for _, high in pieces)


@dataclass(frozen=True)
class Ends:
    """Front and rear along the x axis, with 1 sigma of each and of their distance, m.

    front_beyond_m: excess of the bumper beyond the front from axle and overhang (negative inside of it), if these were
    rejected because of the contradiction; otherwise 0.
    """

    front_m: float
    rear_m: float
    front_sigma_m: float
    rear_sigma_m: float
    length_sigma_m: float
    front_beyond_m: float = 0.0

    @property
    def centre_m(self) -> float:
        """Middle between front and rear."""
        return 0.5 * (self.front_m + self.rear_m)

    @property
    def length_m(self) -> float:
        """Distance between front and rear."""
        return self.front_m - self.rear_m

    @property
    def centre_sigma_m(self) -> float:
        """1 sigma of the middle, derived from the other sigmas."""
        squares = 0.5 * (self.front_sigma_m ** 2 + self.rear_sigma_m ** 2) - 0.25 * self.length_sigma_m ** 2
        return math.sqrt(max(squares, 0.0))


def ends_of(front: EndEvidence, rear: EndEvidence, ordinary: Estimate, known_length_m: float = 0.0) -> Optional[Ends]:
    """Return both ends; None without any evidence. ordinary: length of any car, for an end without evidence."""
    length = Estimate(known_length_m, DATA_SHEET_SIGMA_M) if known_length_m else ordinary
    ahead, behind = front.alone, rear.alone
    if ahead and behind:
        return _between(front, rear, length) if known_length_m else Ends(
            ahead.value_m, -behind.value_m, ahead.sigma_m, behind.sigma_m, math.hypot(ahead.sigma_m, behind.sigma_m))
    seen = ahead or behind
    if seen is None:
        return None
    hidden_sigma_m = math.hypot(seen.sigma_m, length.sigma_m)
    if ahead:
        return Ends(seen.value_m, seen.value_m - length.value_m, seen.sigma_m, hidden_sigma_m, length.sigma_m)
    return Ends(length.value_m - seen.value_m, -seen.value_m, hidden_sigma_m, seen.sigma_m, length.sigma_m)


def _between(front: EndEvidence, rear: EndEvidence, length: Estimate) -> Ends:
    """Return both ends of a Car of known length, where each end constrains the other."""
    ahead, behind = _posterior(front, rear, length), _posterior(rear, front, length)
    centre_m = 0.5 * (ahead.value_m - behind.value_m)
    front_m, rear_m = centre_m + 0.5 * length.value_m, centre_m - 0.5 * length.value_m
    return Ends(front_m, rear_m, math.hypot(ahead.sigma_m, front_m - ahead.value_m),
                math.hypot(behind.sigma_m, rear_m + behind.value_m), length.sigma_m)


def _posterior(end: EndEvidence, other: EndEvidence, length: Estimate) -> Estimate:
    """Return mean and standard deviation of one end."""
    low, high = end.reach()
    nearest, farthest = other.reach()
    grid = np.linspace(min(low, length.value_m - farthest), max(high, length.value_m - nearest), GRID_POINTS)
    total = end.log_likelihood(grid) + other.log_likelihood(length.value_m - grid, length.sigma_m)
    weights = np.exp(total - total.max())
    weights /= weights.sum()
    mean_m = float(weights @ grid)
    sigma_m = math.sqrt(float(weights @ np.square(grid - mean_m)))
    return Estimate(mean_m, math.hypot(sigma_m, _excess(end, other, length)))


def _excess(end: EndEvidence, other: EndEvidence, length: Estimate) -> float:
    """Return the excess of the measured length over the known one, per end, m; it indicates an error at one of them."""
    if end.level is None or other.level is None:
        return 0.0
    return 0.5 * max(0.0, end.level.level + other.level.level - length.value_m)
