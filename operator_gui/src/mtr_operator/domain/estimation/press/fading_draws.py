"""Draws of the fading along a line, as all presses leave it possible, wherever they were made.

The fading is a normal process whose correlation is the sinc of the distance in half wavelengths: its spectrum ends
there, so that its values at places half a wavelength apart are independent and determine all others (Whittaker and
Shannon's sampling theorem). Presses at such places are explained by the grid of hypotheses, each place for itself. A
press between them depends on the fading of several places: draws that explain the others are weighted by it, in steps
that leave half of the draws of use, renewed, and moved about so that equal ones become different again (sequential
Monte Carlo). Fading moves by elliptical slices, the mean boundary by Metropolis' steps.

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

# Of the draws that remain of use before they are renewed.
_USEFUL_SHARE = 0.5
_MOVES, _MAX_SHRINKS, _HALVINGS = 3, 12, 20
_MIN_PROBABILITY = 1e-9


@dataclass(frozen=True)
class FadingDraws:
    """Hypotheses, one of each in a row; fading: in sigmas, of the places in columns."""

    d50_m: FloatArray
    width_m: FloatArray
    lapse: FloatArray
    shared: FloatArray
    fading: FloatArray

    @property
    def fading_m(self) -> FloatArray:
        """Sigma of the boundary's displacement by the fading that stays."""
        return np.asarray(np.sqrt(self.shared) * SIGMA_PER_SCALE * self.width_m / WIDTH_PER_SCALE)

    @property
    def own_width_m(self) -> FloatArray:
        """Width of the transition at one place."""
        return np.asarray(np.sqrt(1.0 - self.shared) * self.width_m)

    def chosen(self, rows: npt.NDArray[np.int_]) -> FadingDraws:
        """Some of the draws, again and again."""
        return FadingDraws(self.d50_m[rows], self.width_m[rows], self.lapse[rows], self.shared[rows], self.fading[rows])


class _Explained:
    """How well draws explain presses.

    Attributes: part: of the likelihood of the presses between the places that counts so far.
    """

    def __init__(self, presses: Sequence[Press], are_between: Sequence[bool], weights: FloatArray):
        self._distances_m = np.array([press.distance_m for press in presses])
        self._worked = np.array([press.worked for press in presses])
        self._are_between = np.array(are_between)
        self._weights = weights
        self.part = 0.0

    def displaced(self, fading: FloatArray) -> FloatArray:
        """Fading at the presses, in sigmas."""
        return np.asarray(fading @ self._weights)

    def log(self, draws: FadingDraws, displaced: FloatArray) -> FloatArray:
        """Of each draw, all presses."""
        return np.asarray(self._logs(draws, displaced) @ np.where(self._are_between, self.part, 1.0))

    def log_between(self, draws: FadingDraws) -> FloatArray:
        """Of each draw, the presses between the places in full."""
        return np.asarray(self._logs(draws, self.displaced(draws.fading))[:, self._are_between].sum(axis=1))

    def _logs(self, draws: FadingDraws, displaced: FloatArray) -> FloatArray:
        beyond_m = draws.d50_m[:, None] + draws.fading_m[:, None] * displaced - self._distances_m
        half = 0.5 * WIDTH_PER_SCALE * beyond_m / draws.own_width_m[:, None]
        works = (1.0 - draws.lapse[:, None]) * (0.5 + 0.5 * np.tanh(half))
        return np.asarray(np.log(np.maximum(np.where(self._worked, works, 1.0 - works), _MIN_PROBABILITY)))


def explaining(draws: FadingDraws, presses: Sequence[Press], are_between: Sequence[bool], weights: FloatArray,
               chance: np.random.Generator) -> FadingDraws:
    """Draws that explain the presses at the places, made to explain those between them too.

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
    """Largest part of the likelihood that leaves enough draws of use."""
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
    """Systematic draws."""
    below = np.cumsum(weights)
    wanted = (np.arange(len(weights)) + chance.random()) / len(weights) * below[-1]
    return np.asarray(np.minimum(np.searchsorted(below, wanted), len(weights) - 1))


def _with_other_fading(draws: FadingDraws, explained: _Explained, chance: np.random.Generator) -> FadingDraws:
    """An elliptical slice of each draw."""
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
        # A draw that found no other place stays where it is.
        moved = here * np.cos(angle)[:, None] + there * np.sin(angle)[:, None]
        angle = np.where(explained.log(draws, moved) < least, 0.0, angle)
    return replace(draws, fading=draws.fading * np.cos(angle)[:, None] + other * np.sin(angle)[:, None])


def _with_other_boundary(draws: FadingDraws, explained: _Explained, chance: np.random.Generator) -> FadingDraws:
    """Mean boundaries, all as likely as each other before the presses, a little beside those of now."""
    displaced = explained.displaced(draws.fading)
    moved = replace(draws, d50_m=draws.d50_m + draws.own_width_m * chance.standard_normal(len(draws.d50_m)) / 2.0)
    gained = explained.log(moved, displaced) - explained.log(draws, displaced)
    return replace(draws, d50_m=np.where(np.log(chance.random(len(gained))) < gained, moved.d50_m, draws.d50_m))
