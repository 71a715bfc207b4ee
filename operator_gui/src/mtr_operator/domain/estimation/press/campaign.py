"""Common properties of the radials of a campaign: the transition's shape, and its approximate position.

Shape: the evidence of a radial is its likelihood with d50 integrated out. Widths of radials differ slightly from a
common one (the antenna's pattern, the path loss), by a normal of SPREAD in the logarithm, K:

    prior of r(shape) = sum over common of  K(shape | common) * prior(common) *
                        product over the other radials of  sum over theirs of  K(theirs | common) * evidence(theirs)

Position: d50 of a radial is assumed near d50 of another one, within NEAR of the searched range. That holds for
distances from the Car's centre. From its sides and corners they differ more, and the other radials are ignored.

Both are mixed with the probability that a radial differs from the others, so that one behind a pillar is not
suppressed. No radial's presses count twice. Sources: Gelman et al., Bayesian Data Analysis, chapter 5 (hierarchy);
Schmidli et al., Biometrics 70 (2014) (robust mixture).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..interval import FloatArray
from .hypotheses import Hypotheses
from .one_boundary import RARE, are_uneven

# Standard deviation of the logarithm of the width among the radials of a Car.
SPREAD = 0.1
# Sigma of the difference between the d50 of radials, relative to the range.
NEAR = 0.05
# Probabilities that width and position of a radial are independent of the others.
UNLIKE_WIDTH, UNLIKE_PLACE = 0.01, 0.2
_TINY = float(np.finfo(float).tiny)


class Campaign:
    """State of each radial, by its number."""

    def __init__(self, hypotheses: Hypotheses, are_near: bool = True):
        """are_near: the d50 of the radials are near each other."""
        self._are_near = are_near
        self._prior = hypotheses.shape_prior()
        logs = np.log(hypotheses.width_m)
        kernel = np.exp(-0.5 * ((logs[:, None] - logs) / SPREAD) ** 2)
        self._kernel: FloatArray = kernel / np.sum(kernel, axis=0)
        self._hypotheses = hypotheses
        self._evidence: dict[int, FloatArray] = {}
        self._places: dict[int, tuple[Hypotheses, FloatArray]] = {}
        self._shape_priors: dict[int, FloatArray] = {}
        self._place_priors: dict[int, FloatArray] = {}
        self._discord: dict[int, float] = {}

    def keep_evidence(self, radial: int, log_evidence: FloatArray) -> None:
        """Add or replace the evidence of a radial on the shape; axes [shared, lapse, width]."""
        evidence = np.exp(log_evidence - np.max(log_evidence))
        self._evidence[radial] = np.log(np.maximum(evidence @ self._kernel, _TINY))
        self._forget_priors_beside(radial)

    def keep_place(self, radial: int, d50: FloatArray, hypotheses: Hypotheses | None = None) -> None:
        """Add or replace a radial's probabilities of d50, on its own grid or on the campaign's."""
        self._places[radial] = hypotheses or self._hypotheses, d50
        self._forget_priors_beside(radial)

    def keep_discord(self, radial: int, probability: float) -> None:
        """Add or replace the probability of the order of a radial's presses on falling curves."""
        self._discord[radial] = probability

    def is_uneven(self, radial: int) -> bool:
        """Return True if a single falling curve does not describe a radial, or describes none of the Car's."""
        return self._discord.get(radial, 1.0) < RARE or are_uneven(self._discord.values())

    def log_shape_prior(self, radial: int) -> FloatArray:
        """Return the prior of a radial's shape from all other radials; axes [shared, lapse, width]."""
        if radial not in self._shape_priors:
            self._shape_priors[radial] = self._log_shape_prior(radial)
        return self._shape_priors[radial]

    def log_place_prior(self, radial: int, hypotheses: Hypotheses | None = None) -> FloatArray:
        """Return the prior of a radial's d50 from all other radials, on this radial's only grid."""
        if radial not in self._place_priors:
            self._place_priors[radial] = self._log_place_prior(radial, hypotheses or self._hypotheses)
        return self._place_priors[radial]

    def _forget_priors_beside(self, radial: int) -> None:
        """Discard the priors of the other radials: a radial's evidence does not change its own prior."""
        for priors in (self._shape_priors, self._place_priors):
            for number in [number for number in priors if number != radial]:
                del priors[number]

    def _log_shape_prior(self, radial: int) -> FloatArray:
        common = np.log(self._prior) + sum(evidence for number, evidence in self._evidence.items() if number != radial)
        like_others: FloatArray = np.exp(common - np.max(common)) @ self._kernel.T
        like_others /= np.sum(like_others)
        any_width = np.mean(like_others, axis=-1, keepdims=True)
        return np.asarray(np.log((1.0 - UNLIKE_WIDTH) * like_others + UNLIKE_WIDTH * any_width))

    def _log_place_prior(self, radial: int, hypotheses: Hypotheses) -> FloatArray:
        count = len(hypotheses.d50_m)
        even = np.full(count, 1.0 / count)
        others = [_on_grid(place, grid, hypotheses) for number, (grid, place) in self._places.items()
                  if number != radial]
        if not others or not self._are_near:
            return np.asarray(np.log(even))
        near = gaussian_filter1d(np.mean(others, axis=0), NEAR * count, mode="constant")
        return np.asarray(np.log((1.0 - UNLIKE_PLACE) * near + UNLIKE_PLACE * even))


def _on_grid(places: FloatArray, own: Hypotheses, wanted: Hypotheses) -> FloatArray:
    """Return the probabilities of d50 on another grid over the same range, uniform within each step."""
    if own is wanted or len(own.d50_m) == len(wanted.d50_m):
        return places
    below = np.concatenate(([0.0], np.cumsum(places)))
    return np.asarray(np.diff(np.interp(wanted.edges_m, own.edges_m, below)))
