"""How much a press at a place would tell: expected information on d50 and on the width, in nats.

    I(x; q) = H(mean of p(x)) - mean over q of H(mean of p(x) given q),   H(p) = -p ln p - (1-p) ln (1-p),

for q = d50 and q = width, added. Not that on both together: it would go on counting what presses at one place tell of
combinations of the two that leave d50 open. Sources: Lindley, Annals of Mathematical Statistics 27 (1956); Kontsevich
and Tyler, Bayesian adaptive estimation of psychometric slope and threshold, Vision Research 39 (1999).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from scipy.special import entr

from ..interval import FloatArray
from .posterior import RadialPosterior
from .transition import falling_single

# A summary of the posterior is enough for a choice: so many places of the boundary, and widths that matter.
_BINS = 30
_MIN_SHARE = 3e-3
_TAIL = 1e-4
_MIN_WEIGHT = 1e-300
# Of the information on the width against that on d50: less of it saves one press in fifteen, and the pooled width, with
# it the 95 % distance, is known worse.
WIDTH_PART = 1.0


class PressInformation:
    """Summary of a posterior; probability and information of a press at places."""

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
        """Probability that a press works, and its information, at each place."""
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
