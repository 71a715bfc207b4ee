"""What of a boundary's uncertainty is the axis' own, the campaign's, and the Car's.

By the law of total variance the variance of a boundary is the mean of its variances given the Car's timing (own: phases
and noise of its passes), and the variance of its means given the timing (common: all axes move together). Of the
common part a further campaign on the same Car repeats some: what passes cannot tell of a Car, whatever their number,
they never tell. The rest is the scatter of the campaign's axes, which another campaign has anew. To first order an
axis i more or less moves the mean of the boundary by the covariance, over the timings, of its mean given the timing
and the axis' evidence, so that the scatter is

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
    """1 sigma in m of what all axes have alike, and of what of it all campaigns on the Car have alike.

    weights: of the places boundary_m, axes [timing, reaction, boundary]. evidence: of each axis, [timing, reaction].
    """
    given = np.sum(weights, axis=2)
    share = given / np.sum(given)
    means_m = weights @ boundary_m / np.maximum(given, np.finfo(float).tiny)
    off_m = means_m - np.sum(share * means_m)
    common = float(np.sum(share * off_m ** 2))
    influences = np.array([np.sum(share * off_m * each) for each in evidence])
    scatter = float(np.var(influences, ddof=1)) * len(influences) if len(influences) > 1 else math.inf
    return math.sqrt(common), math.sqrt(max(common - scatter, 0.0))
