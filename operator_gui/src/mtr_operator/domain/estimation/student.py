"""Quantiles of Student's t, for means of few values."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from scipy.special import ndtri, stdtrit

from .interval import LEVEL

# Tables of Student's t end here; beyond it the normal distribution is used.
NORMAL_FROM = 1e6


def quantile(freedom: float) -> float:
    """Return half the width of a 95 % interval in standard errors, for these degrees of freedom."""
    probability = (1.0 + LEVEL) / 2.0
    return float(ndtri(probability) if freedom > NORMAL_FROM else stdtrit(freedom, probability))
