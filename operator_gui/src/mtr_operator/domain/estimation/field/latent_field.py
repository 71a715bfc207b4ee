"""Field after presses: the posterior at each place, and the most informative next press.

For each row of the prior's grid the latent heights are approximated by a normal vector (expectation). Rows are weighted
by the evidence of the presses: Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), 5.2. A random
miss counts as fading.

The information of a press on the field is the mutual information of its outcome and the latent height: Houlsby et al.,
Bayesian active learning for classification (2011), in its closed form for a normal height and the probit function.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import entr, expit, ndtr

from ..interval import FloatArray
from .expectation import PROBIT_SCALE, Approximation, Sites
from .prior import FieldPrior

# Independent variance of a latent height relative to the largest variance, so that the covariance of equal places can
# be factored.
_JITTER = 1e-6
_BITS = 1.0 / math.log(2.0)
# Width of the bell curve that approximates the entropy of an outcome over its latent height (Houlsby 2011).
_BELL = math.pi * math.log(2.0) / 2.0
# Rows of the grid below this weight after some presses are dropped.
_RARE = 1e-4


@dataclass(frozen=True)
class _Heights:
    """Latent heights at places; axes [grid, place].

    Attributes:
        mean, smooth_mean: with fading and without.
        total, smooth: variances with fading and without.
        common: covariance of the two.
    """

    mean: FloatArray
    smooth_mean: FloatArray
    total: FloatArray
    smooth: FloatArray
    common: FloatArray


class LatentField:
    """Field after presses at places (rows of x, y, height, gap in m); worked: 1 for each success, else 0.

    Attributes:
        prior: remaining rows of the grid.
        weights: probability of each row.
        presses: their number.
    """

    def __init__(self, prior: FieldPrior, places: FloatArray, worked: FloatArray, earlier: LatentField | None = None):
        """earlier: the field after the first of these presses."""
        rows: npt.NDArray[np.int_] = np.arange(len(prior.grid))
        start = Sites(*2 * (np.zeros((len(prior.grid), 0)),))
        if earlier is not None:
            rows = np.flatnonzero(earlier.weights >= _RARE)
            prior, start = earlier.prior, earlier._approximation.sites
        self.prior: FieldPrior = prior.only(rows)
        self._places, self.presses = places, len(places)
        covariance = self.prior.smooth(places, places) + self.prior.fading(places, places)
        self._approximation: Approximation = Approximation(
            covariance + _jitter(covariance), self.prior.mean(places), worked, start.extended(rows, len(places)))
        likely = self._approximation.log_evidence + np.log(self.prior.grid[:, 2])
        weights = np.exp(likely - np.max(likely))
        self.weights: FloatArray = weights / np.sum(weights)

    def marginals(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return mean and standard deviation of the latent height at places."""
        heights = self._heights(places)
        mean = self.weights @ heights.mean
        return mean, np.sqrt(self.weights @ (heights.total + (heights.mean - mean) ** 2))

    def covered(self, places: FloatArray) -> FloatArray:
        """Return the probability that at least half of the presses work, over the fading around each place."""
        heights = self._heights(places)
        return np.asarray(self.weights @ ndtr(heights.smooth_mean / np.sqrt(heights.smooth)))

    def draws(self, places: FloatArray, count: int, seed: int) -> FloatArray:
        """Return random fields of the posterior, one per row: shares of successful presses at places."""
        numbers = np.diff(np.floor(count * np.cumsum([0.0, *self.weights]) + 0.5).astype(int))
        chance = np.random.default_rng(seed)
        smooth, fading = self._cross(places)
        cross = smooth + fading
        explained, mean = self._approximation.explained(cross), self._mean(places, cross)
        found = []
        for row in np.flatnonzero(numbers):
            prior = self.prior.only(np.array([row]))
            left = prior.smooth(places, places) + prior.fading(places, places) - explained[row].T @ explained[row]
            factor = np.linalg.cholesky(left + _jitter(left))[0]
            found.append(mean[row] + chance.standard_normal((numbers[row], len(places))) @ factor.T)
        return np.asarray(expit(np.concatenate(found)))

    def probability(self, places: FloatArray) -> FloatArray:
        """Return the expected share of successful presses."""
        heights = self._heights(places)
        return np.asarray(self.weights @ ndtr(_margin(heights.mean, heights.total)))

    def information(self, places: FloatArray) -> FloatArray:
        """Return the information of one more press at each place on the field without fading, in bits.

        A press at a previously pressed place is therefore less informative: its fading is known, and irrelevant
        elsewhere.
        """
        heights = self._heights(places)
        told = np.minimum(heights.common ** 2 / heights.smooth, heights.total)
        shrunk = np.sqrt(1.0 + PROBIT_SCALE ** 2 * (heights.total - told))
        mean, variance = PROBIT_SCALE * heights.mean / shrunk, PROBIT_SCALE ** 2 * told / shrunk ** 2
        expected = ndtr(mean / np.sqrt(1.0 + variance))
        outcome = (entr(expected) + entr(1.0 - expected)) * _BITS
        known = math.sqrt(_BELL) * np.exp(-mean ** 2 / (2.0 * (variance + _BELL))) / np.sqrt(variance + _BELL)
        return np.asarray(self.weights @ np.maximum(outcome - known, 0.0))

    def _cross(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the covariances between presses and places: without fading, and of the fading."""
        return self.prior.smooth(self._places, places), self.prior.fading(self._places, places)

    def _heights(self, places: FloatArray) -> _Heights:
        smooth, fading = self._cross(places)
        of_smooth = self._approximation.explained(smooth)
        of_both = of_smooth + self._approximation.explained(fading)
        alone, total = self.prior.variances(places)
        return _Heights(self._mean(places, smooth + fading), self._mean(places, smooth), _left(total, of_both, of_both),
                        _left(alone, of_smooth, of_smooth), alone - np.sum(of_both * of_smooth, axis=1))

    def _mean(self, places: FloatArray, cross: FloatArray) -> FloatArray:
        return np.asarray(self.prior.mean(places) + np.einsum("gp,gpm->gm", self._approximation.gradient, cross))


def _left(variance: FloatArray, first: FloatArray, second: FloatArray) -> FloatArray:
    return np.asarray(np.maximum(variance - np.sum(first * second, axis=1), _JITTER))


def _margin(mean: FloatArray, variance: FloatArray) -> FloatArray:
    return np.asarray(PROBIT_SCALE * mean / np.sqrt(1.0 + PROBIT_SCALE ** 2 * variance))


def _jitter(covariance: FloatArray) -> FloatArray:
    """Return the jitter of each matrix."""
    diagonals = np.diagonal(covariance, axis1=1, axis2=2)
    return np.asarray(_JITTER * np.max(diagonals, axis=1, initial=1.0)[:, None, None] * np.eye(covariance.shape[1]))
