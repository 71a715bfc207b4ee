"""Splits the uncertainty of a boundary into parts of the axis, the campaign, and the Car.

By the law of total variance, the variance of a boundary has two parts. The mean of its variances given the Car's timing
is the axis' own (phases and noise of its passes). The variance of its means given the timing is common: all axes move
together. A part of the common variance repeats in each further campaign on the same Car, because passes cannot resolve
it in any number. The rest is the scatter of the campaign's axes, which is independent in another campaign. To first
order, omitting or repeating an axis i moves the mean of the boundary by the covariance, over the timings, of its mean
given the timing and the axis' evidence. The scatter is therefore

    sum over axes i of (influence_i - mean influence)^2,    influence_i = cov(mean | timing, log evidence_i)

(infinitesimal jackknife; Giordano and Broderick 2023, arXiv 2305.06466).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

import numpy as np

from ..interval import FloatArray


def parts_of(boundary_m: FloatArray, weights: FloatArray, evidence: Sequence[FloatArray]) -> tuple[float, float]:
    """Return 1 sigma in m of the error common to all axes, and of the part that all campaigns on the Car have in
    common.

    weights: of the positions boundary_m, axes [timing, reaction, boundary]. evidence: of each axis, [timing, reaction].
    """
    given = np.sum(weights, axis=2)
    share = given / np.sum(given)
    means_m = weights @ boundary_m / np.maximum(given, np.finfo(float).tiny)
    off_m = means_m - np.sum(share * means_m)
    common = float(np.sum(share * off_m ** 2))
    influences = np.array([np.sum(share * off_m * each) for each in evidence])
    scatter = float(np.var(influences, ddof=1)) * len(influences) if len(influences) > 1 else math.inf
    return math.sqrt(common), math.sqrt(max(common - scatter, 0.0))
