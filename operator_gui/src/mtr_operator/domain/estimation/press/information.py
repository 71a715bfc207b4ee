"""Expected information of a press on d50 and on the width, in nats.

    I(x; q) = H(mean of p(x)) - mean over q of H(mean of p(x) given q),   H(p) = -p ln p - (1-p) ln (1-p),

for q = d50 and q = width, added. The joint information on both would also count combinations of the two that repeated
presses at one place determine, but that leave d50 uncertain. Sources: Lindley, Annals of Mathematical Statistics 27
(1956); Kontsevich and Tyler, Bayesian adaptive estimation of psychometric slope and threshold, Vision Research 39
(1999).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from scipy.special import entr

from ..interval import FloatArray
from .posterior import RadialPosterior
from .transition import falling_single

# A summary of the posterior suffices for the selection: number of boundary positions, and least share of a width.
_BINS = 30
_MIN_SHARE = 3e-3
_TAIL = 1e-4
_MIN_WEIGHT = 1e-300
# Weight of the information on the width relative to d50. A smaller one saves one press in fifteen, but the pooled
# width, and thus the 95 % distance, becomes less accurate.
WIDTH_PART = 1.0


class PressInformation:
    """Summary of a posterior that gives probability and information of presses."""

    def __init__(self, posterior: RadialPosterior):
        grid = posterior.hypotheses
        by_width = posterior.by_width
        kept = np.sum(by_width, axis=1) > _MIN_SHARE
        below = np.cumsum(np.sum(by_width, axis=0))
        first, last = np.searchsorted(below, [_TAIL, 1.0 - _TAIL])
        last = min(last, len(below) - 1)
        starts = np.unique(np.linspace(first, last, _BINS, endpoint=False).astype(int))
        sizes = np.diff(np.append(starts, last + 1))
        weights = np.add.reduceat(by_width[kept][:, :last + 1], starts, axis=1)
        self._weights = weights / np.sum(weights)
        self._d50_m = grid.d50_m[starts] + grid.step_m * (sizes - 1) / 2.0
        self._width_m = grid.width_m[kept]
        self._works = 1.0 - posterior.lapse

    def at(self, places_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the probability that a press works, and its information, at each place."""
        works = np.float32(self._works) * falling_single(places_m, self._d50_m[:, None], self._width_m[:, None, None])
        mean = np.tensordot(self._weights, works, axes=2)
        joint = self._weights[..., None] * works
        total = np.zeros_like(mean)
        for axis, part in ((0, 1.0), (1, WIDTH_PART)):
            weights = np.sum(self._weights, axis=axis)[:, None]
            given = np.sum(joint, axis=axis) / np.maximum(weights, _MIN_WEIGHT)
            total += part * (_entropy(mean) - np.sum(weights * _entropy(given), axis=0))
        return mean, np.maximum(total, 0.0)


def _entropy(probability: FloatArray) -> FloatArray:
    result: FloatArray = entr(probability) + entr(1.0 - probability)
    return result
