"""Normal approximation of latent heights after presses by expectation propagation, and the evidence of the presses.

Each press is replaced by a normal factor of its place's height (a site, of precision tau and shift nu). Mean and
variance at the place then equal the moments of the press itself combined with all other sites. Rasmussen and Williams,
Gaussian Processes for Machine Learning (2006), 3.6 and algorithm 3.5, with all sites updated at once. If heights are
known only to some units of the logistic, Laplace's approximation is too narrow and its evidence wrong: Nickisch and
Rasmussen, Approximations for binary Gaussian process classification (2008).

The first axis of all arrays is the prior's grid.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.linalg import solve_triangular
from scipy.special import log_ndtr

from ..interval import FloatArray

# The logistic approximates the normal distribution function of a height scaled by this (MacKay 1992).
PROBIT_SCALE = math.sqrt(math.pi / 8.0)
_MAX_STEPS = 40
_STOP = 1e-3
# Damping of a step of all sites, so that interdependent sites do not overshoot.
_DAMPED = 0.8
_MIN_PRECISION = 1e-9
_LOG_ROOT_2_PI = 0.5 * math.log(2.0 * math.pi)


@dataclass(frozen=True)
class Sites:
    """Normal factors that replace the presses; axes [grid, press]."""

    tau: FloatArray
    nu: FloatArray

    def extended(self, rows: npt.NDArray[np.int_], presses: int) -> Sites:
        """Return some rows of the grid, extended by uninformative sites for newer presses."""
        wider = ((0, 0), (0, presses - self.tau.shape[1]))
        return Sites(np.pad(self.tau[rows], wider), np.pad(self.nu[rows], wider))


class Approximation:
    """Approximation of the heights at the presses.

    Attributes:
        sites: of the presses.
        gradient: columns of the covariance times this are added to the mean.
        log_evidence: of the presses, for each row of the grid.
    """

    def __init__(self, covariance: FloatArray, mean: FloatArray, worked: FloatArray, start: Sites):
        self._covariance, self._mean = covariance, mean
        self._signs = np.where(worked > 0.0, 1.0, -1.0)
        self._take(start)
        for _ in range(_MAX_STEPS):
            wanted = self._renewed()
            change = max(float(np.max(np.abs(new - old), initial=0.0)) for new, old in
                         ((wanted.tau, self.sites.tau), (wanted.nu, self.sites.nu)))
            if change < _STOP:
                break
            self._take(Sites(self.sites.tau + _DAMPED * (wanted.tau - self.sites.tau),
                             self.sites.nu + _DAMPED * (wanted.nu - self.sites.nu)))
        self.log_evidence = self._log_evidence()

    def explained(self, cross: FloatArray) -> FloatArray:
        """Return columns whose products are the reduction of a covariance with other places by the presses."""
        return _solved(self._factor, self._root[:, :, None] * cross)

    def _take(self, sites: Sites) -> None:
        self.sites = sites
        self._root = np.sqrt(sites.tau)
        curved = np.eye(sites.tau.shape[1]) + self._root[:, :, None] * self._covariance * self._root[:, None, :]
        self._factor = np.linalg.cholesky(curved)
        explained = self.explained(self._covariance)
        self._variance = np.diagonal(self._covariance, axis1=1, axis2=2) - np.sum(explained ** 2, axis=1)
        shifted = _times(self._covariance, sites.nu)
        inner = _solved(self._factor, (self._root * shifted)[:, :, None])
        self.gradient = sites.nu - self._root * _solved(self._factor, inner, transposed=True)[:, :, 0]
        # The height is relative to the prior's mean.
        self._height = _times(self._covariance, self.gradient)

    def _cavity(self) -> tuple[FloatArray, FloatArray]:
        """Return precision and shift of each height from all other presses."""
        precision = np.maximum(1.0 / self._variance - self.sites.tau, _MIN_PRECISION)
        return precision, self._height / self._variance - self.sites.nu

    def _margin(self, precision: FloatArray, shift: FloatArray) -> FloatArray:
        """Return the margin of each press's outcome, in sigmas."""
        spread = np.sqrt(1.0 + PROBIT_SCALE ** 2 / precision)
        return np.asarray(self._signs * PROBIT_SCALE * (shift / precision + self._mean) / spread)

    def _renewed(self) -> Sites:
        precision, shift = self._cavity()
        margin = self._margin(precision, shift)
        ratio = np.exp(-0.5 * margin ** 2 - _LOG_ROOT_2_PI - log_ndtr(margin))
        scale = PROBIT_SCALE ** 2 / (1.0 + PROBIT_SCALE ** 2 / precision)
        curvature = scale * ratio * (margin + ratio)
        # Matched mean and variance, written as sites: tau = curvature / (1 - curvature / precision).
        left = np.maximum(1.0 - curvature / precision, _MIN_PRECISION)
        tau = np.maximum(curvature / left, _MIN_PRECISION)
        gained = self._signs * np.sqrt(scale) * ratio
        return Sites(tau, (gained + curvature * shift / precision) / left)

    def _log_evidence(self) -> FloatArray:
        """Return the evidence, equations 3.73 and 3.74."""
        tau, nu = self.sites.tau, self.sites.nu
        precision, shift = self._cavity()
        place = shift / precision
        together = tau + precision
        terms = (log_ndtr(self._margin(precision, shift)) + 0.5 * np.log1p(tau / precision)
                 - np.log(np.diagonal(self._factor, axis1=1, axis2=2))
                 + 0.5 * nu * self._height - 0.5 * nu ** 2 / together
                 + 0.5 * place * precision / together * (tau * place - 2.0 * nu))
        return np.asarray(np.sum(terms, axis=1))


def _times(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    return np.asarray((matrices @ vectors[:, :, None])[:, :, 0])


def _solved(factors: FloatArray, columns: FloatArray, transposed: bool = False) -> FloatArray:
    if not factors.shape[1]:
        return columns
    return np.stack([solve_triangular(factor, column, trans=int(transposed), lower=True, check_finite=False)
                     for factor, column in zip(factors, columns)])
