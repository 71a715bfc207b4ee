"""The field after presses: Laplace's approximation of the latent heights, and where a press tells most.

Newton's method finds the most probable heights at the presses, the curvature there their covariance: Rasmussen and
Williams, Gaussian Processes for Machine Learning (2006), algorithms 3.1 and 3.2. A lapse counts as fading.

What a press tells of the field is the information between its outcome and the latent height: Houlsby et al., Bayesian
active learning for classification (2011), its closed form for a normal height and the normal distribution's integral.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Callable

import numpy as np
from scipy.linalg import cho_solve, cholesky, solve_triangular
from scipy.special import entr, expit, ndtr

from ..interval import FloatArray
from .prior import FieldPrior

_MAX_STEPS = 60
_STOP = 1e-6
# A latent height has this much of its own, so that the covariance of equal places can be factored.
_JITTER = 1e-6
_MIN_CURVATURE = 1e-12
# The logistic is nearly a normal distribution's integral, of a height scaled by this (MacKay 1992).
_PROBIT_SCALE = math.sqrt(math.pi / 8.0)
_BITS = 1.0 / math.log(2.0)
# Of the bell that approximates the entropy of an outcome over its latent height (Houlsby 2011).
_BELL = math.pi * math.log(2.0) / 2.0

Covariance = Callable[[FloatArray, FloatArray], FloatArray]


class LatentField:
    """After presses at places (rows of x, y, height, gap in m); worked: 1 for each that did, else 0."""

    def __init__(self, prior: FieldPrior, places: FloatArray, worked: FloatArray):
        self._prior = prior
        self._places = places
        covariance = prior.covariance(places, places) + _JITTER * np.eye(len(places))
        weights = _most_probable(covariance, prior.mean(places), worked)
        share = expit(covariance @ weights + prior.mean(places))
        self._gradient = worked - share
        self._root = _root(share)
        self._factor = _factor(self._root, covariance)

    def marginals(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Mean and standard deviation of the latent height at places."""
        mean, explained = self._explained(places, self._prior.covariance)
        return mean, _sigma(self._prior.covariance, places, explained)

    def smooth_marginals(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same of the latent height without the fading of the place: what holds for its surroundings."""
        mean, explained = self._explained(places, self._prior.smooth)
        return mean, _sigma(self._prior.smooth, places, explained)

    def draws(self, places: FloatArray, count: int, seed: int) -> FloatArray:
        """Fields that are possible, one a row: shares of presses that work at places."""
        mean, explained = self._explained(places, self._prior.covariance)
        values, vectors = np.linalg.eigh(self._prior.covariance(places, places) - explained.T @ explained)
        normal = np.random.default_rng(seed).standard_normal((count, len(places)))
        return np.asarray(expit(mean + (normal * np.sqrt(np.maximum(values, 0.0))) @ vectors.T))

    def probability(self, places: FloatArray) -> FloatArray:
        """Share of presses that is expected to work."""
        mean, sigma = self.marginals(places)
        return np.asarray(ndtr(_PROBIT_SCALE * mean / np.sqrt(1.0 + (_PROBIT_SCALE * sigma) ** 2)))

    def information(self, places: FloatArray) -> FloatArray:
        """What one more press at each place tells of the field without fading, in bits.

        So a press at a place that was pressed at before tells little: its fading is known, and of no use elsewhere.
        """
        mean, explained = self._explained(places, self._prior.covariance)
        smooth = self._explained(places, self._prior.smooth)[1]
        common = _variances(self._prior.smooth, places) - np.sum(explained * smooth, axis=0)
        of_smooth = _sigma(self._prior.smooth, places, smooth) ** 2
        told = np.minimum(common ** 2 / of_smooth, _sigma(self._prior.covariance, places, explained) ** 2)
        left = _sigma(self._prior.covariance, places, explained) ** 2 - told
        shrunk = np.sqrt(1.0 + _PROBIT_SCALE ** 2 * left)
        mean, variance = _PROBIT_SCALE * mean / shrunk, _PROBIT_SCALE ** 2 * told / shrunk ** 2
        expected = ndtr(mean / np.sqrt(1.0 + variance))
        outcome = (entr(expected) + entr(1.0 - expected)) * _BITS
        known = math.sqrt(_BELL) * np.exp(-mean ** 2 / (2.0 * (variance + _BELL))) / np.sqrt(variance + _BELL)
        return np.asarray(np.maximum(outcome - known, 0.0))

    def _explained(self, places: FloatArray, covariance: Covariance) -> tuple[FloatArray, FloatArray]:
        """Mean at places, and the columns whose products are what the presses take from the prior's covariance."""
        cross = covariance(self._places, places)
        explained = cross
        if len(self._places):
            explained = solve_triangular(self._factor, self._root[:, None] * cross, lower=True)
        return np.asarray(self._prior.mean(places) + cross.T @ self._gradient), np.asarray(explained)


def _variances(covariance: Covariance, places: FloatArray) -> FloatArray:
    return np.array([covariance(place[None], place[None])[0, 0] for place in places])


def _sigma(covariance: Covariance, places: FloatArray, explained: FloatArray) -> FloatArray:
    left = _variances(covariance, places) - np.sum(explained ** 2, axis=0)
    return np.asarray(np.sqrt(np.maximum(left, _JITTER)))


def _most_probable(covariance: FloatArray, mean: FloatArray, worked: FloatArray) -> FloatArray:
    """Weights w of the most probable heights, covariance @ w + mean."""
    weights = np.zeros(len(mean))
    if not len(mean):
        return weights
    value = _log_posterior(covariance, mean, worked, weights)
    for _ in range(_MAX_STEPS):
        height = covariance @ weights + mean
        share = expit(height)
        root = _root(share)
        wanted = root ** 2 * (height - mean) + worked - share
        newton = wanted - root * cho_solve((_factor(root, covariance), True), root * (covariance @ wanted))
        step = 1.0
        while step > _STOP and _log_posterior(covariance, mean, worked, weights + step * (newton - weights)) < value:
            step /= 2.0
        weights = weights + step * (newton - weights)
        reached = _log_posterior(covariance, mean, worked, weights)
        if reached - value < _STOP:
            break
        value = reached
    return weights


def _log_posterior(covariance: FloatArray, mean: FloatArray, worked: FloatArray, weights: FloatArray) -> float:
    above = covariance @ weights
    height = above + mean
    return float(-0.5 * weights @ above - np.sum(np.logaddexp(0.0, np.where(worked > 0.0, -height, height))))


def _root(share: FloatArray) -> FloatArray:
    return np.asarray(np.sqrt(np.maximum(share * (1.0 - share), _MIN_CURVATURE)))


def _factor(root: FloatArray, covariance: FloatArray) -> FloatArray:
    curved = np.eye(len(root)) + root[:, None] * covariance * root
    return np.asarray(cholesky(curved, lower=True) if len(root) else curved)
