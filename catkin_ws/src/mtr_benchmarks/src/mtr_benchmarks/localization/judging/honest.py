"""Bounds of a system with consistent covariances whose errors are as correlated in time as the observed ones.

An error of the map or of the Car is constant during a drive. Even with right covariances, the mean normalised squared
error of one drive scatters about 1, and the worst of many drives deviates further.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple, Optional, Sequence

import numpy as np
from scipy import stats

from mtr_core.arrays import FloatArray

from ..methods.errors import PoseErrors
from .figures import DIMENSIONS

SAMPLE_S = 1.0
CONFIDENCE = 0.95


class Bounds(NamedTuple):
    """Bounds that contain 95 % of single consistent drives, or with 95 % probability all of a set of them."""

    low: float
    high: float


def freedom_of(drives: Sequence[PoseErrors]) -> Optional[float]:
    """Return the degrees of freedom of the mean normalised squared error of the median drive; None without a pose.

    Constant errors give 3, and uncorrelated ones 3 per instant. Errors are assumed to have zero mean, so that a
    constant error counts as fully correlated.
    """
    lags = [lag_sums(sampled(each)) for each in drives]
    longest = max((len(each.counts) for each in lags), default=0)
    sums, counts = np.zeros(longest), np.zeros(longest)
    for each in lags:
        sums[:len(each.sums)] += each.sums
        counts[:len(each.counts)] += each.counts
    if not longest or not sums[0] > 0.0:
        return None
    alike = np.square(sums / np.maximum(counts, 1.0) * counts[0] / sums[0])
    found = []
    for each in lags:
        # Each lag except zero has two pairs of instants.
        pairs = np.concatenate((each.counts[:1], 2.0 * each.counts[1:]))
        if pairs.sum() > 0.0:
            found.append(DIMENSIONS * pairs.sum() / float(np.dot(pairs, alike[:len(pairs)])))
    return float(np.median(found))


def bounds_of(freedom: float, drives: int = 1) -> Bounds:
    """Return bounds of the mean normalised squared error divided by its expectation, for one drive or all of a set."""
    beyond = 0.5 * (1.0 - CONFIDENCE ** (1.0 / drives))
    low, high = stats.chi2.ppf((beyond, 1.0 - beyond), freedom) / freedom
    return Bounds(float(low), float(high))


class LagSums(NamedTuple):
    """Sums by lag: products of errors at that lag, and number of pairs."""

    sums: FloatArray
    counts: FloatArray


def sampled(errors: PoseErrors) -> FloatArray:
    """Return the whitened errors (n, 3) at each second."""
    if not len(errors.stamps_s):
        return np.zeros((0, DIMENSIONS))
    wanted = np.arange(errors.stamps_s[0], errors.stamps_s[-1] + 1e-6, SAMPLE_S)
    return errors.whitened[np.minimum(np.searchsorted(errors.stamps_s, wanted), len(errors.stamps_s) - 1)]


def lag_sums(whitened: FloatArray) -> LagSums:
    """Return the sums over all three components; an instant without a pose does not count."""
    known = np.isfinite(whitened).all(axis=1)
    values = np.where(known[:, np.newaxis], whitened, 0.0)
    if not len(values):
        return LagSums(np.zeros(0), np.zeros(0))
    sums = sum(_correlated(values[:, axis]) for axis in range(DIMENSIONS))
    return LagSums(np.asarray(sums), DIMENSIONS * _correlated(known.astype(float)))


def _correlated(values: FloatArray) -> FloatArray:
    return np.correlate(values, values, "full")[len(values) - 1:]
