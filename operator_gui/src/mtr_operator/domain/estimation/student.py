"""Quantiles of Student's t: how far a mean reaches that few values are known of."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from scipy.special import ndtri, stdtrit

from .interval import LEVEL

# Student's t has no larger table; from here on it is the normal distribution.
NORMAL_FROM = 1e6


def quantile(freedom: float) -> float:
    """Half the width of a 95 % interval in standard errors, with these degrees of freedom."""
    probability = (1.0 + LEVEL) / 2.0
    return float(ndtri(probability) if freedom > NORMAL_FROM else stdtrit(freedom, probability))
