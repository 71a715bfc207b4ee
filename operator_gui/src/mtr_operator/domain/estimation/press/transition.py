"""Probability that a press works as a function of the distance.

    p(d) = (1 - lapse) / (1 + exp((d - d50) / scale))

d50         m       half of the presses work, without random misses
scale       m       width / (2 ln 9); width: from 90 to 10 %
d95         m       d50 - scale ln 19: 95 % of the presses work
lapse       share   random misses at any distance: contact of the button, bus, temporary disturbance

The logistic curve has heavier tails than the normal one that follows from fading in dB: its d95 lies nearer to the Car,
on the safe side, by 0.03 of the width. Sources: Wichmann and Hill, The psychometric function, Perception and
Psychophysics 63 (2001); MIL-HDBK-1823A for the same curve of the probability of detection.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.special import expit

from ..interval import FloatArray

SingleArray = npt.NDArray[np.float32]

WIDTH_PER_SCALE = 2.0 * math.log(9.0)
D95_PER_SCALE = math.log(19.0)
# Standard deviation of the logistic distribution with scale 1.
SIGMA_PER_SCALE = math.pi / math.sqrt(3.0)


def falling(distance_m: float | FloatArray, d50_m: float | FloatArray, width_m: float | FloatArray) -> FloatArray:
    """Return the share of successful presses, without random misses."""
    result: FloatArray = expit((d50_m - distance_m) * WIDTH_PER_SCALE / width_m)
    return result


def falling_single(distance_m: float | FloatArray, d50_m: FloatArray, width_m: FloatArray) -> SingleArray:
    """Return the same for many hypotheses at once: accurate to 1e-7, in a seventh of the time."""
    half = (d50_m - distance_m).astype(np.float32) * (0.5 * WIDTH_PER_SCALE / width_m).astype(np.float32)
    result: SingleArray = np.tanh(half, out=half)
    result *= np.float32(0.5)
    result += np.float32(0.5)
    return result
