"""Profile of one side of the Car from all returns near it, and its outermost level."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import Iterator, Optional

import numpy as np

from mtr_core import sensor_figures
from mtr_core.arrays import BoolArray, FloatArray, IntArray

from .side import SideExtent

BIN_M = 0.02
# A bin with fewer returns is a smeared edge; the share is relative to the median bin.
MIN_RETURNS, MIN_SHARE_OF_MEDIAN = 20, 0.3
# Returns farther from the middle of their bin are strays: 2.5 sigma of a LiDAR with 2 cm of noise.
STRAY_M = 2.5 * sensor_figures.WORST_RANGE_NOISE_M.value
# Bins farther from a parabola have less weight.
STRAY_SIGMAS = 3.0
ROUNDS = 3
# A piece of a long side is straight if its means scatter about the line by at most their noise and this 1 sigma. The
# mean square, a single bin and the bend must not exceed these limits, in sigmas.
MIN_STRAIGHT_BINS, STRAIGHT_SIGMA_M, MAX_MEAN_SQUARE, MAX_SIGMAS, MAX_BEND_SIGMAS = 5, 0.0005, 3.0, 4.0, 3.0
# A wheel arch begins in the next bin if it falls off the line by this much; the mean of that bin is smeared. The start
# of the arch within the bin has the standard deviation of a uniform distribution.
STEP_M, STEP_SIGMAS, EDGE_SIGMA_BINS = 0.003, 2.0, 0.29
# Bins beyond the line, this near an end of the side, belong to a short bumper; mirrors are farther away. A short bumper
# is smeared at the arch and curves towards the end: its outermost point is some millimetres farther out.
SHORT_BINS, SHORT_REACH_M, SHORT_SIGMA_M = 3, 0.25, 0.005
# Depth to which a bumper is a parabola; 1 sigma of its scatter.
TOP_M, SHAPE_SIGMA_M, MIN_BUMPER_BINS = 0.01, 0.001, 8


@dataclass(frozen=True)
class SideProfile:
    """Mean distance outwards of each bin along a side, in their order, with the mean's 1 sigma; (n,) each, in m."""

    number: IntArray
    level: FloatArray
    sigma: FloatArray

    @property
    def along(self) -> FloatArray:
        """Middles of the bins along the side, m."""
        return (self.number + 0.5) * BIN_M

    def below(self, level_m: float) -> "SideProfile":
        """Return the profile without bins that reach farther out."""
        keep = self.level <= level_m
        return SideProfile(self.number[keep], self.level[keep], self.sigma[keep])


def profile_of(along: FloatArray, outward: FloatArray) -> Optional[SideProfile]:
    """Return the profile of returns; None with too few returns."""
    if len(along) < MIN_RETURNS:
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
    minimum = max(MIN_RETURNS, MIN_SHARE_OF_MEDIAN * float(np.median(returns[returns > 0])))
    good = np.nonzero(returns >= minimum)[0]
    return SideProfile(good + first, level[good], np.sqrt(variance[good] / returns[good])) if len(good) else None


def outermost(side: SideProfile) -> Optional[SideExtent]:
    """Return the outermost level of a long side: at the end of a straight piece, as next to a wheel arch."""
    found = [end for piece in _straight_pieces(side) for end in piece.ends(side)]
    if not found:
        return None
    straight = max(found, key=lambda each: each.level - each.sigma)
    return _short_bumper(side, straight) or _with_unresolved_bumper(side, straight)


def _with_unresolved_bumper(side: SideProfile, straight: SideExtent) -> SideExtent:
    """Return the level with a larger sigma if single bins near the ends of the side protrude.

    A bumper that is round from the wheel arch on has its full width over a few centimetres only.
    """
    from_end_m = BIN_M * np.minimum(side.number[-1] - side.number, side.number - side.number[0])
    beyond_m = side.level - straight.level
    stands_out = (from_end_m <= SHORT_REACH_M) & (beyond_m > STEP_M + STEP_SIGMAS * side.sigma)
    return replace(straight, sigma=math.hypot(straight.sigma, float(np.max(beyond_m[stands_out], initial=0.0))))


def summit(end: SideProfile) -> Optional[SideExtent]:
    """Return the outermost level of an end: the top of the parabola through nearby bins."""
    if len(end.number) < MIN_BUMPER_BINS:
        return None
    top = _top_of(end, np.ones(len(end.number), dtype=bool))
    for _ in range(ROUNDS - 1):
        near = np.abs(end.level - top.level) < TOP_M
        if np.count_nonzero(near) < MIN_BUMPER_BINS:
            break
        top = _top_of(end, near)
    return top


@dataclass(frozen=True)
class _Piece:
    """Bins first to last of a profile, and the line through them: level at its middle, and rise per bin."""

    first: int
    last: int
    middle_m: float
    rise_m: float
    sigma_m: float

    def ends(self, side: SideProfile) -> Iterator[SideExtent]:
        """Yield the levels at both ends; next to a wheel arch, the piece extends into the bin where the arch begins."""
        half = 0.5 * (self.last - self.first)
        count = self.last - self.first + 1
        for sign, beside, neighbour in ((1.0, self.last, self.last + 1), (-1.0, self.first, self.first - 1)):
            expected_m = self.middle_m + sign * self.rise_m * (half + 1.0)
            is_arch = _falls_away(side, beside, neighbour, expected_m)
            reach = half + (1.0 if is_arch else 0.5)
            spread = math.sqrt(1.0 / count + 12.0 * reach ** 2 / (count * (count ** 2 - 1.0)))
            sigma_m = math.hypot(spread * self.sigma_m, EDGE_SIGMA_BINS * self.rise_m if is_arch else 0.0)
            yield SideExtent(self.middle_m + sign * self.rise_m * reach, sigma_m)


def _short_bumper(side: SideProfile, straight: SideExtent) -> Optional[SideExtent]:
    """Return a part near an end of the side that protrudes beyond the straight pieces and is shorter than these."""
    found = None
    for first in range(len(side.number) - SHORT_BINS + 1):
        bins = slice(first, first + SHORT_BINS)
        number, level, sigma = side.number[bins], side.level[bins], side.sigma[bins]
        from_end_m = BIN_M * min(number[-1] - side.number[0], side.number[-1] - number[0])
        stands_out = np.all(level > straight.level + STEP_M + STEP_SIGMAS * sigma)
        if (from_end_m <= SHORT_REACH_M and number[-1] - number[0] == SHORT_BINS - 1 and stands_out
                and (found is None or level.mean() > found.level)):
            found = SideExtent(float(level.mean()), math.hypot(float(sigma.max()), SHORT_SIGMA_M))
    return found


def _straight_pieces(side: SideProfile) -> Iterator[_Piece]:
    """Yield straight pieces of maximum length."""
    last = ended = -1
    for first in range(len(side.number) - MIN_STRAIGHT_BINS + 1):
        last = max(last, first + MIN_STRAIGHT_BINS - 1)
        piece = longer = _straight(side, first, last)
        while longer is not None:
            piece = longer
            longer = _straight(side, first, piece.last + 1)
        if piece is not None and piece.last > ended:
            last = ended = piece.last
            yield piece


def _straight(side: SideProfile, first: int, last: int) -> Optional[_Piece]:
    """Return the piece between two bins; None if it has gaps or is not straight."""
    if last >= len(side.number) or side.number[last] - side.number[first] != last - first:
        return None
    bins = np.arange(last - first + 1) - 0.5 * (last - first)
    level, sigma = side.level[first:last + 1], np.hypot(side.sigma[first:last + 1], STRAIGHT_SIGMA_M)
    middle, rise = float(level.mean()), float(bins @ level / (bins @ bins))
    rest = (level - middle - rise * bins) / sigma
    bend = np.square(bins) - np.square(bins).mean()
    if (rest @ rest > MAX_MEAN_SQUARE * (len(bins) - 2) or np.abs(rest).max() > MAX_SIGMAS
            or abs(rest @ bend) > MAX_BEND_SIGMAS * math.sqrt(bend @ bend)):
        return None
    return _Piece(first, last, middle, rise, float(sigma.mean()))


def _top_of(end: SideProfile, near: BoolArray) -> SideExtent:
    return _top_of_parabola(end.along[near], end.level[near], np.hypot(end.sigma[near], SHAPE_SIGMA_M))


def _top_of_parabola(along: FloatArray, level: FloatArray, sigma: FloatArray) -> SideExtent:
    scale = max(float(np.abs(along).max()), BIN_M)
    matrix = np.vander(along / scale, 3)
    shape, weights = np.array([0.0, 0.0, float(np.median(level))]), 1.0 / sigma
    for _ in range(2 * ROUNDS):
        robust = weights / np.sqrt(1.0 + np.square((level - matrix @ shape) * weights / STRAY_SIGMAS))
        shape = np.linalg.lstsq(matrix * robust[:, np.newaxis], level * robust, rcond=None)[0]
    bend, slope, _ = shape
    top = float(np.clip(-0.5 * slope / bend, -0.5, 0.5)) if bend < 0.0 else 0.0
    at_top = np.array([top * top, top, 1.0])
    covariance = np.linalg.inv((matrix * robust[:, np.newaxis] ** 2).T @ matrix)
    return SideExtent(float(at_top @ shape), math.sqrt(float(at_top @ covariance @ at_top)))


def _falls_away(side: SideProfile, beside: int, neighbour: int, expected_m: float) -> bool:
    """Return True if the neighbouring bin is clearly inside of the continued line."""
    if not 0 <= neighbour < len(side.number) or abs(side.number[neighbour] - side.number[beside]) != 1:
        return False
    return bool(side.level[neighbour] < expected_m - STEP_M - STEP_SIGMAS * side.sigma[neighbour])


def _medians(index: IntArray, values: FloatArray, count: int) -> FloatArray:
    """Return the median of each group, 0 for an empty one."""
    order = np.lexsort((values, index))
    sizes = np.bincount(index, minlength=count)
    middle = np.minimum(np.cumsum(sizes) - sizes + sizes // 2, len(values) - 1)
    return np.where(sizes > 0, values[order][middle], 0.0)
