"""What presses and the campaign's other radials leave possible for one radial."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from scipy.special import logsumexp

from ..interval import FloatArray, Interval, interval_of
from .hypotheses import Hypotheses
from .transition import D95_PER_SCALE, WIDTH_PER_SCALE


class RadialPosterior:
    """Probabilities over the grid.

    Attributes:
        probability: axes [shared, lapse, width, d50]; its sum is 1.
    """

    def __init__(self, hypotheses: Hypotheses, log_likelihood: FloatArray, log_shape_prior: FloatArray,
                 log_place_prior: FloatArray):
        self.hypotheses = hypotheses
        total = log_likelihood + log_shape_prior[..., None] + log_place_prior
        weights = np.exp(total - np.max(total))
        self.probability: FloatArray = weights / np.sum(weights)

    def d50(self) -> Interval:
        """Distance at which half of the presses work."""
        return interval_of(self.hypotheses.edges_m, self.places())

    def d95(self) -> Interval:
        """Distance at which 95 % of the presses work, lapses apart."""
        grid = self.hypotheses
        offsets_m = D95_PER_SCALE * grid.width_m / WIDTH_PER_SCALE
        weights = np.sum(self.probability, axis=(0, 1))
        steps = np.round(offsets_m / grid.step_m).astype(int)
        count = len(grid.d50_m)
        moved = np.zeros(count + int(steps[-1]))
        for row, step in zip(weights, steps):
            moved[steps[-1] - step:steps[-1] - step + count] += row
        first_m = grid.edges_m[0] - grid.step_m * steps[-1]
        return interval_of(first_m + grid.step_m * np.arange(len(moved) + 1), moved)

    def places(self) -> FloatArray:
        """Probability of each d50."""
        result: FloatArray = np.sum(self.probability, axis=(0, 1, 2))
        return result

    def widths(self) -> FloatArray:
        """Probability of each width."""
        result: FloatArray = np.sum(self.probability, axis=(0, 1, 3))
        return result

    @property
    def lapse(self) -> float:
        """Mean share of presses that fail at any distance."""
        return float(np.sum(self.probability, axis=(0, 2, 3)) @ self.hypotheses.lapse)

    @property
    def fading(self) -> float:
        """Probability that presses at one place share their fading."""
        return float(np.sum(self.probability, axis=(1, 2, 3))[self.hypotheses.shared > 0.0].sum())


def log_evidence(log_likelihood: FloatArray) -> FloatArray:
    """Logarithm of the likelihood with d50 integrated out; axes [shared, lapse, width]."""
    result: FloatArray = logsumexp(log_likelihood, axis=-1) - np.log(log_likelihood.shape[-1])
    return result
