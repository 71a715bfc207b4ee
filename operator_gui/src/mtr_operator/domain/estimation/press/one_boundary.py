"""Test for a single boundary of a radial: where the ground reflection cancels the wave, presses work again beyond a
hole.

A search from the far end may stop on an island beyond such a hole, metres too far. Presses in equal parts of the path
show it: near parts fail, and farther parts work. Its frequency on falling curves that explain the presses, each with
different fading, is the posterior predictive probability of

    T = sum over parts i nearer than j of  (1 - share of i) * share of j.

Below RARE, one curve does not describe the radial; if several radials are affected, it describes none of the Car's.
Their interval is then the one without a curve: the share of presses near each distance is drawn repeatedly, and for
each draw the nearest falling curve is used (see line_boundary).

Sources: Gelman et al., Bayesian Data Analysis, chapter 6 (posterior predictive checks); Efron and Tibshirani, An
Introduction to the Bootstrap, 1993; T. S. Rappaport, Wireless Communications, 2nd ed., 4.6 (two rays).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable, Sequence

import numpy as np
import numpy.typing as npt
from scipy.special import expit, ndtr

from ..interval import SIGMAS_OF_LEVEL, FloatArray
from .lattice import Lattice
from .likelihood import Press
from .line_boundary import drawn
from .posterior import RadialPosterior
from .transition import WIDTH_PER_SCALE

# On falling curves less than this share of radials is below it: posterior predictive probabilities concentrate near
# 0.5.
RARE = 0.1
# This number of radials, and this share of them, show that no radial of the Car has a falling curve.
_SEVERAL, _SHARE = 2, 0.2
# Length of a part of the path: a null at 868 MHz is about 2 m wide, and narrower ones do not affect the range.
PART_M = 1.0
_HALF = 0.5
_DRAWS, _SEED, _ROUNDING = 2000, 1, 1e-9
# For the share of presses near a distance: 1 sigma of their weights, step, and weight of a prior share of one half.
_NEAR_M, _STEP_M, _BESIDES = 0.7, 0.1, 0.5


@dataclass(frozen=True)
class Uneven:
    """Radial that no falling curve describes.

    Attributes:
        low_m, high_m: ends of the interval of d50 without a curve.
        hole_m: from the farthest successful press before the nearest hole, None without one, to the nearest successful
            one beyond it; None without a hole.
    """

    low_m: float
    high_m: float
    hole_m: tuple[float | None, float] | None


def parts_m(minimum_m: float, maximum_m: float) -> FloatArray:
    """Return the borders of equal parts of a path."""
    return np.linspace(minimum_m, maximum_m, max(1, round((maximum_m - minimum_m) / PART_M)) + 1)


def are_uneven(probabilities: Iterable[float]) -> bool:
    """Return True if enough radials of a test are rare, so that no radial of the Car has a falling curve."""
    rare = [probability < RARE for probability in probabilities]
    return sum(rare) >= max(_SEVERAL, _SHARE * len(rare))


def probability_of(posterior: RadialPosterior, presses: Sequence[Press], lattice: Lattice,
                   edges_m: FloatArray) -> float:
    """Return the probability that the same presses on a falling curve with different fading are at least as
    discordant."""
    places_m, worked = _arrays(presses)
    part = _parts(places_m, edges_m)
    chance = np.random.default_rng(_SEED)
    numbers, place = np.unique(lattice.places_of(places_m), return_inverse=True)
    draws = drawn(posterior, _DRAWS, len(numbers), chance)
    middle_m = draws.d50_m[:, None] + draws.fading_m[:, None] * draws.fading[:, place]
    works = (1.0 - draws.lapse[:, None]) * expit((middle_m - places_m) * WIDTH_PER_SCALE / draws.own_width_m[:, None])
    repeated = (chance.random(works.shape) < works).astype(float)
    return float(np.mean(_discordant(repeated, part) >= _discordant(worked[None, :], part) - _ROUNDING))


def uneven(presses: Sequence[Press], edges_m: FloatArray, sigmas: float = SIGMAS_OF_LEVEL) -> Uneven:
    """Evaluate presses without a curve; sigmas: reach of the interval."""
    places_m, worked = _arrays(presses)
    distances_m = np.arange(edges_m[0], edges_m[-1] + _STEP_M, _STEP_M)
    chance = np.random.default_rng(_SEED)
    again = (chance.random((_DRAWS, len(places_m))) < _shares(places_m, places_m) @ worked
             + _HALF * (1.0 - np.sum(_shares(places_m, places_m), axis=1))).astype(float)
    weights = _shares(distances_m, places_m)
    curves = again @ weights.T + _HALF * (1.0 - np.sum(weights, axis=1))
    ends_m = distances_m[np.argmax(np.cumsum(curves - _HALF, axis=1), axis=1)]
    tail = float(ndtr(-sigmas))
    low_m, high_m = np.quantile(ends_m, [tail, 1.0 - tail])
    return Uneven(float(low_m), float(high_m), _nearest_hole(places_m, worked, _parts(places_m, edges_m)))


def _arrays(presses: Sequence[Press]) -> tuple[FloatArray, FloatArray]:
    return (np.array([press.distance_m for press in presses]),
            np.array([press.worked for press in presses], dtype=np.float64))


def _parts(places_m: FloatArray, edges_m: FloatArray) -> npt.NDArray[np.int_]:
    return np.asarray(np.clip(np.searchsorted(edges_m, places_m, side="right") - 1, 0, len(edges_m) - 2))


def _shares(distances_m: FloatArray, places_m: FloatArray) -> FloatArray:
    """Return the weight of each press for the share at each distance; the remainder to 1 is the prior's weight."""
    near = np.exp(-0.5 * ((distances_m[:, None] - places_m) / _NEAR_M) ** 2)
    return np.asarray(near / (np.sum(near, axis=1, keepdims=True) + _BESIDES))


def _nearest_hole(places_m: FloatArray, worked: FloatArray,
                  part: npt.NDArray[np.int_]) -> tuple[float | None, float] | None:
    used = np.unique(part)
    shares = np.array([np.mean(worked[part == number]) for number in used])
    failing = next((index for index in range(len(used)) if shares[index] < _HALF
                    and np.any(shares[index + 1:] >= _HALF)), None)
    if failing is None:
        return None
    beyond = used[failing + 1:][shares[failing + 1:] >= _HALF][0]
    before_m = places_m[(part < used[failing]) & (worked > 0.0)]
    return (float(np.max(before_m)) if len(before_m) else None,
            float(np.min(places_m[(part == beyond) & (worked > 0.0)])))


def _discordant(worked: FloatArray, part: npt.NDArray[np.int_]) -> FloatArray:
    """Return T of each row of presses."""
    shares = np.stack([np.mean(worked[:, part == number], axis=1) for number in np.unique(part)], axis=1)
    beyond = np.cumsum(shares[:, ::-1], axis=1)[:, ::-1] - shares
    return np.asarray(np.sum((1.0 - shares) * beyond, axis=1))
