"""Posterior of one radial from its presses and the campaign's other radials."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np

from ..interval import FloatArray, Interval, interval_of
from .hypotheses import Hypotheses
from .transition import SingleArray, falling_single

# Lower bound of a log likelihood relative to the best position of its shape: single precision ends at -87.
_MIN_LOG = -80.0


class RadialPosterior:
    """Probabilities over the grid.

    Attributes:
        shapes: axes [shared, lapse, width]; their sum is 1.
        by_width: axes [width, d50]; their sum is 1.
        log_evidence: logarithm of the likelihood with d50 integrated out; axes [shared, lapse, width].
    """

    def __init__(self, hypotheses: Hypotheses, log_likelihood: FloatArray, log_shape_prior: FloatArray,
                 log_place_prior: FloatArray):
        self.hypotheses = hypotheses
        # One exponential serves evidence and posterior; single precision needs an eighth of the time.
        peak = log_likelihood.max(axis=-1)
        below: SingleArray = (log_likelihood - peak[..., None]).astype(np.float32)
        self._likelihood: SingleArray = np.exp(np.maximum(below, _MIN_LOG, out=below), out=below)
        self._place_prior = np.exp(log_place_prior - np.max(log_place_prior))
        both = np.stack((np.full(len(self._place_prior), 1.0 / len(self._place_prior)), self._place_prior), axis=-1)
        even, shapes = np.moveaxis((self._likelihood @ both.astype(np.float32)).astype(np.float64), -1, 0)
        self.log_evidence: FloatArray = np.log(even) + peak
        log_weights = log_shape_prior + peak
        weights = np.exp(log_weights - np.max(log_weights + np.log(shapes)))
        self._weights: FloatArray = weights / np.sum(weights * shapes)
        self.shapes: FloatArray = self._weights * shapes
        self.by_width: FloatArray = self._place_prior * np.einsum(
            "slw,slwd->wd", self._weights.astype(np.float32), self._likelihood)
        self._places: FloatArray = np.sum(self.by_width, axis=0)
        self._d50 = interval_of(hypotheses.edges_m, self._places)

    @property
    def probability(self) -> FloatArray:
        """Return the probability of each hypothesis; axes [shared, lapse, width, d50]."""
        return np.asarray(self._weights[..., None] * self._likelihood * self._place_prior)

    def d50(self) -> Interval:
        """Return the distance at which half of the presses work on the mean curve, over lines with different fading."""
        return self._d50

    def places(self) -> FloatArray:
        """Return the probability of each d50."""
        return self._places

    def works(self, distance_m: float) -> float:
        """Return the probability that a press works."""
        grid = self.hypotheses
        curves = falling_single(distance_m, grid.d50_m, grid.width_m[:, None])
        return (1.0 - self.lapse) * float(np.sum(self.by_width * curves))

    def widths(self) -> FloatArray:
        """Return the probability of each width."""
        result: FloatArray = np.sum(self.shapes, axis=(0, 1))
        return result

    @property
    def lapse(self) -> float:
        """Mean share of presses that fail at any distance."""
        return float(np.sum(self.shapes, axis=(0, 2)) @ self.hypotheses.lapse)
