"""Whether a radial has one boundary: where the ground's reflection cancels the wave, presses work again beyond a hole.

A search that comes from far may end on an island beyond such a hole, metres too far. Presses in equal parts of the way
show it: parts that fail nearer than parts that work. How often that is so on falling curves that explain the presses,
each with other fading, is the posterior predictive probability of

    T = sum over parts i nearer than j of  (1 - share of i) * share of j.

Below RARE one curve does not describe the radial; where that is so on several radials, it describes none of the Car's.
Their interval is then also that of no curve at all: the share of presses near each distance, drawn again and again,
and of each draw the falling curve that is nearest (see line_boundary).

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

# On falling curves fewer than so many radials are below it: posterior predictive probabilities gather about a half.
RARE = 0.1
# So many radials, and this share of them, show that no radial of the Car falls along one curve.
_SEVERAL, _SHARE = 2, 0.2
# Length of a part of the way: a null at 868 MHz is some 2 m wide, and narrower ones decide no range.
PART_M = 1.0
_HALF = 0.5
_DRAWS, _SEED, _ROUNDING = 2000, 1, 1e-9
# Of the share of presses near a distance: 1 sigma of their weights, steps, and presses that work half the time which
# it is taken to know besides.
_NEAR_M, _STEP_M, _BESIDES = 0.7, 0.1, 0.5


@dataclass(frozen=True)
class Uneven:
    """A radial that no falling curve describes.

    Attributes:
        low_m, high_m: ends of the interval of d50 without a curve.
        hole_m: from the farthest press that worked before the nearest hole, None without one, to the nearest that
            worked beyond it; None where no hole is seen.
    """

    low_m: float
    high_m: float
    hole_m: tuple[float | None, float] | None


def parts_m(minimum_m: float, maximum_m: float) -> FloatArray:
    """Borders of equal parts of a way."""
    return np.linspace(minimum_m, maximum_m, max(1, round((maximum_m - minimum_m) / PART_M)) + 1)


def are_uneven(probabilities: Iterable[float]) -> bool:
    """True when so many radials of a test are rare that no radial of the Car falls along one curve."""
    rare = [probability < RARE for probability in probabilities]
    return sum(rare) >= max(_SEVERAL, _SHARE * len(rare))


def probability_of(posterior: RadialPosterior, presses: Sequence[Press], lattice: Lattice,
                   edges_m: FloatArray) -> float:
    """That the same presses on a falling curve with other fading are at least as discordant."""
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
    """What presses say without a curve; sigmas: how many of them the interval reaches."""
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
    """Weight of each press for the share at each distance; what is left to 1 is of what is known besides."""
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
    """T of each row of presses."""
    shares = np.stack([np.mean(worked[:, part == number], axis=1) for number in np.unique(part)], axis=1)
    beyond = np.cumsum(shares[:, ::-1], axis=1)[:, ::-1] - shares
    return np.asarray(np.sum((1.0 - shares) * beyond, axis=1))
