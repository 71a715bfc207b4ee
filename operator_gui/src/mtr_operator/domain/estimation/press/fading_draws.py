"""Random draws of the fading along a line from its posterior after all presses.

The fading is a normal process whose correlation is the sinc of the distance in half wavelengths. Its spectrum is band
limited, so values at places half a wavelength apart are independent and determine all others (sampling theorem of
Whittaker and Shannon). The grid of hypotheses explains presses at such places, each place separately. A press between
them depends on the fading of several places. Draws that explain the others are weighted by it, in steps that keep half
of the draws effective, resampled, and moved, so that equal ones become different (sequential Monte Carlo). Fading moves
by elliptical slices, the mean boundary by Metropolis steps.

Sources: Del Moral, Doucet and Jasra, Sequential Monte Carlo samplers, J. R. Statist. Soc. B 68 (2006); Murray, Adams
and MacKay, Elliptical slice sampling (2010).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Sequence

import numpy as np
import numpy.typing as npt

from ..interval import FloatArray
from .likelihood import Press
from .transition import SIGMA_PER_SCALE, WIDTH_PER_SCALE

# Share of effective draws at which they are resampled.
_USEFUL_SHARE = 0.5
_MOVES, _MAX_SHRINKS, _HALVINGS = 3, 12, 20
_MIN_PROBABILITY = 1e-9


@dataclass(frozen=True)
class FadingDraws:
    """Draws of hypotheses, one per row; fading: in sigmas, of the places in columns."""

    d50_m: FloatArray
    width_m: FloatArray
    lapse: FloatArray
    shared: FloatArray
    fading: FloatArray

    @property
    def fading_m(self) -> FloatArray:
        """Sigma of the boundary's displacement by the permanent fading."""
        return np.asarray(np.sqrt(self.shared) * SIGMA_PER_SCALE * self.width_m / WIDTH_PER_SCALE)

    @property
    def own_width_m(self) -> FloatArray:
        """Width of the transition at one place."""
        return np.asarray(np.sqrt(1.0 - self.shared) * self.width_m)

    def chosen(self, rows: npt.NDArray[np.int_]) -> FadingDraws:
        """Return some of the draws, possibly repeated."""
        return FadingDraws(self.d50_m[rows], self.width_m[rows], self.lapse[rows], self.shared[rows], self.fading[rows])


class _Explained:
    """Likelihood of presses for draws.

    Attributes: part: exponent of the likelihood of presses between the places.
    """

    def __init__(self, presses: Sequence[Press], are_between: Sequence[bool], weights: FloatArray):
        self._distances_m = np.array([press.distance_m for press in presses])
        self._worked = np.array([press.worked for press in presses])
        self._are_between = np.array(are_between)
        self._weights = weights
        self.part = 0.0

    def displaced(self, fading: FloatArray) -> FloatArray:
        """Return the fading at the presses, in sigmas."""
        return np.asarray(fading @ self._weights)

    def log(self, draws: FadingDraws, displaced: FloatArray) -> FloatArray:
        """Return the log likelihood of each draw, for all presses."""
        return np.asarray(self._logs(draws, displaced) @ np.where(self._are_between, self.part, 1.0))

    def log_between(self, draws: FadingDraws) -> FloatArray:
        """Return the full log likelihood of each draw, for presses between the places."""
        return np.asarray(self._logs(draws, self.displaced(draws.fading))[:, self._are_between].sum(axis=1))

    def _logs(self, draws: FadingDraws, displaced: FloatArray) -> FloatArray:
        beyond_m = draws.d50_m[:, None] + draws.fading_m[:, None] * displaced - self._distances_m
        half = 0.5 * WIDTH_PER_SCALE * beyond_m / draws.own_width_m[:, None]
        works = (1.0 - draws.lapse[:, None]) * (0.5 + 0.5 * np.tanh(half))
        return np.asarray(np.log(np.maximum(np.where(self._worked, works, 1.0 - works), _MIN_PROBABILITY)))


def explaining(draws: FadingDraws, presses: Sequence[Press], are_between: Sequence[bool], weights: FloatArray,
               chance: np.random.Generator) -> FadingDraws:
    """Return draws that explain all presses, from draws that explain the presses at the places.

    weights: of the fading's columns at each press.
    """
    explained = _Explained(presses, are_between, weights)
    while explained.part < 1.0:
        between = explained.log_between(draws)
        step = _step(between, 1.0 - explained.part)
        draws = draws.chosen(_renewed(np.exp(step * (between - np.max(between))), chance))
        explained.part = 1.0 if step >= 1.0 - explained.part else explained.part + step
        for _ in range(_MOVES):
            draws = _with_other_fading(draws, explained, chance)
            draws = _with_other_boundary(draws, explained, chance)
    return draws


def _step(between: FloatArray, left: float) -> float:
    """Return the largest part of the likelihood that keeps enough draws effective."""
    if _useful_share(left * between) >= _USEFUL_SHARE:
        return left
    low, high = 0.0, left
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        low, high = (middle, high) if _useful_share(middle * between) >= _USEFUL_SHARE else (low, middle)
    return high


def _useful_share(log_weights: FloatArray) -> float:
    weights = np.exp(log_weights - np.max(log_weights))
    return float(np.sum(weights) ** 2 / np.sum(weights ** 2) / len(weights))


def _renewed(weights: FloatArray, chance: np.random.Generator) -> npt.NDArray[np.int_]:
    """Return the rows of systematic resampling."""
    below = np.cumsum(weights)
    wanted = (np.arange(len(weights)) + chance.random()) / len(weights) * below[-1]
    return np.asarray(np.minimum(np.searchsorted(below, wanted), len(weights) - 1))


def _with_other_fading(draws: FadingDraws, explained: _Explained, chance: np.random.Generator) -> FadingDraws:
    """Move each draw by an elliptical slice."""
    count = len(draws.fading)
    other = chance.standard_normal(draws.fading.shape)
    here, there = explained.displaced(draws.fading), explained.displaced(other)
    least = explained.log(draws, here) + np.log(chance.random(count))
    angle = 2.0 * math.pi * chance.random(count)
    low, high = angle - 2.0 * math.pi, angle.copy()
    for _ in range(_MAX_SHRINKS):
        moved = here * np.cos(angle)[:, None] + there * np.sin(angle)[:, None]
        refused = explained.log(draws, moved) < least
        if not np.any(refused):
            break
        low, high = np.where(refused & (angle < 0.0), angle, low), np.where(refused & (angle >= 0.0), angle, high)
        angle = np.where(refused, low + (high - low) * chance.random(count), angle)
    else:
        # A draw without a new position keeps its current one.
        moved = here * np.cos(angle)[:, None] + there * np.sin(angle)[:, None]
        angle = np.where(explained.log(draws, moved) < least, 0.0, angle)
    return replace(draws, fading=draws.fading * np.cos(angle)[:, None] + other * np.sin(angle)[:, None])


def _with_other_boundary(draws: FadingDraws, explained: _Explained, chance: np.random.Generator) -> FadingDraws:
    """Move mean boundaries, which have a uniform prior, by small random steps."""
    displaced = explained.displaced(draws.fading)
    moved = replace(draws, d50_m=draws.d50_m + draws.own_width_m * chance.standard_normal(len(draws.d50_m)) / 2.0)
    gained = explained.log(moved, displaced) - explained.log(draws, displaced)
    return replace(draws, d50_m=np.where(np.log(chance.random(len(gained))) < gained, moved.d50_m, draws.d50_m))
