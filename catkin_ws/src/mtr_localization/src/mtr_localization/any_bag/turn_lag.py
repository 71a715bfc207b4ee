"""Stamp offset between two sensors, from the robot's turns that both measured."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from .motion import Sweep

# Search range and step of offsets.
MAX_LAG_S, STEP_S = 6.0, 0.05
# Delays by drivers and networks are smaller, and the method is not more accurate.
MIN_LAG_S = 0.3
# Lowest standard deviation of both rates, shortest common time, and its lowest share of the shorter recording.
MIN_RATE_RADPS, MIN_OVERLAP_S, MIN_OVERLAP = 0.05, 10.0, 0.5
# Lowest correlation at the offset, and lowest ratio of the unexplained variances without and with the offset.
MIN_CORRELATION, MIN_GAIN = 0.7, 2.0
# Closer scans contain too little turn for a comparison; scans farther apart have different views.
MIN_PAIR_S, MAX_PAIR_S = 0.09, 0.5
BIN_RAD, MAX_TURN_RAD = np.radians(1.0), np.radians(30.0)
# Limit of the influence of an edge that appears between two scans, as a ratio of ranges (natural logarithm).
MAX_DIFFERENCE = 0.3
MIN_BINS, MIN_SHARE = 30, 0.5
# More pairs take time without a benefit.
MAX_PAIRS = 6000
# A longer span contains stamps of another clock.
MAX_SPAN_S = 4.0 * 3600.0


class Rates(NamedTuple):
    """Turn rates in rad/s, left positive, with their times in s."""

    times_s: FloatArray
    rates_radps: FloatArray


class Lag(NamedTuple):
    """Lag of the stamps of a sensor in s; is_certain: the turns exclude an offset of zero."""

    lag_s: float
    is_certain: bool


def rates_of(samples: Sequence[Tuple[float, float]]) -> Rates:
    """Return finite samples (time in s, rate in rad/s) in the order of their times."""
    table = np.array(samples, dtype=float).reshape(-1, 2)
    table = table[np.isfinite(table).all(axis=1)]
    times_s, first = np.unique(table[:, 0], return_index=True)
    return Rates(times_s, table[first, 1])


def turn_lag(reference: Rates, other: Rates, max_lag_s: float = MAX_LAG_S) -> Optional[Lag]:
    """Return the lag of the other stamps behind the reference; None if the turns do not show it."""
    if min(len(reference.times_s), len(other.times_s)) < 2:
        return None
    begin_s = min(reference.times_s[0], other.times_s[0]) - STEP_S
    end_s = max(reference.times_s[-1], other.times_s[-1]) + STEP_S
    if end_s - begin_s > MAX_SPAN_S:
        return None
    grid_s = np.arange(begin_s, end_s, STEP_S)
    ours, theirs = _resampled(reference, grid_s), _resampled(other, grid_s)
    steps = np.arange(-round(max_lag_s / STEP_S), round(max_lag_s / STEP_S) + 1)
    needed = max(MIN_OVERLAP_S / STEP_S, MIN_OVERLAP * min(np.isfinite(ours).sum(), np.isfinite(theirs).sum()))
    found = np.array([_correlation(ours, theirs, int(step), needed) for step in steps])
    if not np.isfinite(found).any():
        return None
    best, none = int(np.nanargmax(found)), found[len(steps) // 2]
    if found[best] < MIN_CORRELATION or not np.isfinite(none):
        return None
    lag_s = float(steps[best] * STEP_S)
    gain = (1.0 - none ** 2) / max(1.0 - found[best] ** 2, 1e-6)
    return Lag(lag_s, bool(abs(lag_s) >= MIN_LAG_S and gain >= MIN_GAIN))


def _resampled(rates: Rates, grid_s: FloatArray) -> FloatArray:
    """Return the mean over about 0.2 s on the grid; NaN outside the samples and in gaps."""
    values = np.interp(grid_s, rates.times_s, rates.rates_radps, left=np.nan, right=np.nan)
    after = np.clip(np.searchsorted(rates.times_s, grid_s), 1, len(rates.times_s) - 1)
    values[rates.times_s[after] - rates.times_s[after - 1] > 2.0 * MAX_PAIR_S] = np.nan
    smooth: FloatArray = np.convolve(values, np.full(5, 0.2), mode="same")
    return smooth


def _correlation(ours: FloatArray, theirs: FloatArray, step: int, needed: float) -> float:
    """Return the correlation of both rates for a lag in steps.

    NaN if there are fewer common samples than needed, or no turn.
    """
    if abs(step) >= len(ours):
        return float("nan")
    one = ours[max(0, -step):len(ours) - max(0, step)]
    two = theirs[max(0, step):len(theirs) - max(0, -step)]
    both = np.isfinite(one) & np.isfinite(two)
    if both.sum() < needed:
        return float("nan")
    one, two = one[both] - one[both].mean(), two[both] - two[both].mean()
    if min(one.std(), two.std()) < MIN_RATE_RADPS:
        return float("nan")
    return float((one * two).mean() / (one.std() * two.std()))


class ScanTurns:
    """Turn rates of a LiDAR, from the shift of its ranges between two scans."""

    def __init__(self, sense: float) -> None:
        """Create an estimator. sense: -1 for a LiDAR that is mounted upside down."""
        self._sense = sense
        self._last: Optional[Tuple[float, FloatArray]] = None
        self._samples: List[Tuple[float, float]] = []

    def add(self, scan: Sweep) -> None:
        """Compare a scan with the previous one."""
        time_s = scan.stamp_s
        passed_s = MAX_PAIR_S if self._last is None else time_s - self._last[0]
        if 0.0 <= passed_s < MIN_PAIR_S or len(self._samples) >= MAX_PAIRS:
            return
        profile = _profile(scan)
        if self._last is not None and 0.0 < passed_s < MAX_PAIR_S and len(profile) == len(self._last[1]):
            turn = _turn(self._last[1], profile)
            if turn is not None:
                self._samples.append((time_s - 0.5 * passed_s, self._sense * turn / passed_s))
        self._last = time_s, profile

    @property
    def rates(self) -> Rates:
        """All rates so far."""
        return rates_of(self._samples)


def _profile(scan: Sweep) -> FloatArray:
    """Return the logarithm of the range per degree, increasing to the left; NaN without an echo."""
    ranges = np.asarray(scan.ranges, dtype=float)
    ranges[~((ranges >= max(scan.range_min_m, 1e-3)) & (ranges <= scan.range_max_m))] = np.nan
    if ranges.size < 2 or not np.isfinite(scan.angle_increment_rad):
        return np.zeros(0)
    span = abs(scan.angle_increment_rad) * (ranges.size - 1)
    picks = np.round(np.linspace(0, ranges.size - 1, max(2, min(720, round(span / BIN_RAD) + 1)))).astype(int)
    profile: FloatArray = np.log(ranges[picks if scan.angle_increment_rad > 0.0 else picks[::-1]])
    return profile


def _turn(before: FloatArray, after: FloatArray) -> Optional[float]:
    """Return the turn to the left in rad; None with too few common echoes, or if the best shift is the largest one."""
    most = min(round(MAX_TURN_RAD / BIN_RAD), len(before) // 3)
    costs = []
    for shift in range(-most, most + 1):
        one = before[max(0, shift):len(before) + min(0, shift)]
        two = after[max(0, -shift):len(after) - max(0, shift)]
        difference = np.abs(one - two)
        difference = difference[np.isfinite(difference)]
        few = difference.size < max(MIN_BINS, MIN_SHARE * np.isfinite(after).sum())
        costs.append(np.inf if few else float(np.minimum(difference, MAX_DIFFERENCE).mean()))
    best = int(np.argmin(costs))
    if not 0 < best < len(costs) - 1 or not np.isfinite(costs[best - 1:best + 2]).all():
        return None
    left, middle, right = costs[best - 1:best + 2]
    bend = left - 2.0 * middle + right
    return float((best - most + (0.5 * (left - right) / bend if bend > 0.0 else 0.0)) * BIN_RAD)
