"""The profile of one side of the Car from all returns near it, and the outermost level that it reaches."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Iterator, Optional

import numpy as np

from .side import Extent

BIN_M = 0.02
# A bin with fewer returns is the smeared edge of something; the share is of the median bin.
LEAST_RETURNS, LEAST_OF_MEDIAN = 20, 0.3
# Returns farther than this from the middle of their bin are strays: 2.5 sigma of a LiDAR with 2 cm of noise.
STRAY_M = 0.05
ROUNDS = 3
# A long side is straight over so many bins, or its means scatter about the line by more than noise and this, 1 sigma.
STRAIGHT_BINS, STRAIGHT_SIGMA_M, MOST_SCATTER = 5, 0.0005, 3.0
# Where the next bin falls away from the line by so much, a wheel arch begins in it, and its mean is smeared.
STEP_M, STEP_SIGMAS = 0.003, 2.0
# Of a bumper the scatter about a parabola by its shape, number plate and grille.
SHAPE_SIGMA_M = 0.003
LEAST_BUMPER_BINS = 15


@dataclass(frozen=True)
class Profile:
    """Mean distance outwards of each bin along a side, in the order of the bins, with the mean's 1 sigma."""

    number: np.ndarray
    level: np.ndarray
    sigma: np.ndarray

    @property
    def along(self) -> np.ndarray:
        """Middles of the bins along the side, m."""
        return (self.number + 0.5) * BIN_M

    def below(self, level_m: float) -> "Profile":
        """Without the bins that reach farther out."""
        keep = self.level <= level_m
        return Profile(self.number[keep], self.level[keep], self.sigma[keep])


def profile_of(along: np.ndarray, outward: np.ndarray) -> Optional[Profile]:
    """Profile of returns; None when there are next to none."""
    if len(along) < LEAST_RETURNS:
        return None
    number = np.floor(along / BIN_M).astype(int)
    first = number.min()
    index, count = number - first, number.max() - first + 1
    level = _medians(index, outward, count)
    for _ in range(ROUNDS):
        near = np.abs(outward - level[index]) < STRAY_M
        returns, sums, squares = (np.bincount(index[near], weights=weights, minlength=count) for weights in (
            None, outward[near], np.square(outward[near])))
        level = sums / np.maximum(returns, 1)
    variance = np.maximum(squares / np.maximum(returns, 1) - level ** 2, 0.0)
    least = max(LEAST_RETURNS, LEAST_OF_MEDIAN * float(np.median(returns[returns > 0])))
    good = np.nonzero(returns >= least)[0]
    return Profile(good + first, level[good], np.sqrt(variance[good] / returns[good])) if len(good) else None


def outermost(side: Profile) -> Optional[Extent]:
    """Where a long side reaches farthest out: at the end of a straight piece, as beside a wheel arch."""
    found = [end for first in range(len(side.number) - STRAIGHT_BINS + 1) for end in _ends_of(side, first)]
    return max(found, key=lambda each: each.level - each.sigma, default=None)


def summit(end: Profile) -> Optional[Extent]:
    """How far an end reaches out: the top of the parabola through most of it."""
    if len(end.number) < LEAST_BUMPER_BINS:
        return None
    along, reach = end.along, max(float(np.abs(end.along).max()), BIN_M)
    matrix = np.vander(along / reach, 3)
    weights = 1.0 / np.hypot(end.sigma, SHAPE_SIGMA_M)
    shape = np.array([0.0, 0.0, float(np.median(end.level))])
    for _ in range(2 * ROUNDS):
        rest = (end.level - matrix @ shape) / np.hypot(end.sigma, SHAPE_SIGMA_M)
        robust = weights / np.sqrt(1.0 + rest ** 2)
        shape = np.linalg.lstsq(matrix * robust[:, np.newaxis], end.level * robust, rcond=None)[0]
    bend, slope, _ = shape
    top = float(np.clip(-0.5 * slope / bend, -0.5, 0.5)) if bend < 0.0 else 0.0
    at_top = np.array([top * top, top, 1.0])
    covariance = np.linalg.inv((matrix * robust[:, np.newaxis] ** 2).T @ matrix)
    return Extent(float(at_top @ shape), math.sqrt(float(at_top @ covariance @ at_top)))


def _ends_of(side: Profile, first: int) -> Iterator[Extent]:
    """Both ends of the straight piece that begins with a bin; none when it is not one piece or not straight."""
    last = first + STRAIGHT_BINS - 1
    if side.number[last] - side.number[first] != last - first:
        return
    bins = np.arange(STRAIGHT_BINS) - 0.5 * (STRAIGHT_BINS - 1)
    level, sigma = side.level[first:last + 1], np.hypot(side.sigma[first:last + 1], STRAIGHT_SIGMA_M)
    mean, slope = float(level.mean()), float(bins @ level / (bins @ bins))
    rest = (level - mean - slope * bins) / sigma
    if rest @ rest > MOST_SCATTER * (STRAIGHT_BINS - 2):
        return
    for sign, neighbour in ((1.0, last + 1), (-1.0, first - 1)):
        reach = 0.5 * STRAIGHT_BINS + (1.0 if _falls_away(side, neighbour, mean + sign * slope * (bins[-1] + 1.0),
                                                          first if sign < 0.0 else last) else 0.0)
        spread = math.sqrt(1.0 / STRAIGHT_BINS + reach ** 2 / float(bins @ bins))
        yield Extent(mean + sign * slope * reach, spread * float(sigma.mean()))


def _falls_away(side: Profile, neighbour: int, expected_m: float, beside: int) -> bool:
    """True when the bin next to another lies clearly inside of where a straight line would go on."""
    if not 0 <= neighbour < len(side.number) or abs(side.number[neighbour] - side.number[beside]) != 1:
        return False
    return bool(side.level[neighbour] < expected_m - STEP_M - STEP_SIGMAS * side.sigma[neighbour])


def _medians(index: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Median of each group, 0 for an empty one."""
    order = np.lexsort((values, index))
    sizes = np.bincount(index, minlength=count)
    middle = np.minimum(np.cumsum(sizes) - sizes + sizes // 2, len(values) - 1)
    return np.where(sizes > 0, values[order][middle], 0.0)
