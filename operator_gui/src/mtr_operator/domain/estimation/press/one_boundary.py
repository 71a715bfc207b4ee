"""Whether a radial has one boundary: where the ground's reflection cancels the wave, presses work again beyond a hole.

A search that comes from far may end on an island beyond such a hole, metres too far. Presses in equal parts of the way
show it: parts that fail nearer than parts that work. How often that is so on falling curves that explain the presses,
each with other fading, is the posterior predictive probability of the count

    T = sum over parts i nearer than j of  (1 - share of i) * share of j,

and below RARE the radial has more than one boundary. Sources: Gelman et al., Bayesian Data Analysis, chapter 6
(posterior predictive checks); T. S. Rappaport, Wireless Communications, 2nd ed., 4.6 (two rays).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

import numpy as np
from scipy.special import expit

from ..interval import FloatArray
from .lattice import Lattice
from .likelihood import Press
from .line_boundary import drawn
from .posterior import RadialPosterior
from .transition import WIDTH_PER_SCALE

# Posterior predictive probabilities lie about a half more often than even ones do: on falling curves fewer than so
# many radials are below it.
RARE = 0.1
# Length of a part of the way. A null is a third of its distance wide, and none nearer than 3 m decides a range.
PART_M = 1.0
_DRAWS, _SEED = 1000, 1
_HALF = 0.5


def parts_m(minimum_m: float, maximum_m: float) -> FloatArray:
    """Borders of equal parts of a way."""
    return np.linspace(minimum_m, maximum_m, max(1, round((maximum_m - minimum_m) / PART_M)) + 1)


def hole_m(posterior: RadialPosterior, presses: Sequence[Press], lattice: Lattice,
           edges_m: FloatArray) -> tuple[float | None, float] | None:
    """The nearest hole of a radial with more than one boundary; None where one falling curve explains the presses.

    From the farthest press that worked before the hole, None without one, to the nearest that worked beyond it.
    """
    places_m = np.array([press.distance_m for press in presses])
    worked = np.array([press.worked for press in presses], dtype=float)
    part = np.clip(np.searchsorted(edges_m, places_m, side="right") - 1, 0, len(edges_m) - 2)
    found = _nearest_hole(places_m, worked, part)
    if found is None or _probability(posterior, lattice, places_m, worked, part) >= RARE:
        return None
    return found


def _nearest_hole(places_m: FloatArray, worked: FloatArray, part: FloatArray) -> tuple[float | None, float] | None:
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


def _probability(posterior: RadialPosterior, lattice: Lattice, places_m: FloatArray, worked: FloatArray,
                 part: FloatArray) -> float:
    """That the same presses on a falling curve with other fading are at least as discordant."""
    chance = np.random.default_rng(_SEED)
    numbers, place = np.unique(lattice.places_of(places_m), return_inverse=True)
    draws = drawn(posterior, _DRAWS, len(numbers), chance)
    middle_m = draws.d50_m[:, None] + draws.fading_m[:, None] * draws.fading[:, place]
    works = (1.0 - draws.lapse[:, None]) * expit((middle_m - places_m) * WIDTH_PER_SCALE / draws.own_width_m[:, None])
    repeated = (chance.random(works.shape) < works).astype(float)
    return float(np.mean(_discordant(repeated, part) >= _discordant(worked[None, :], part) - 1e-9))


def _discordant(worked: FloatArray, part: FloatArray) -> FloatArray:
    """T of each row of presses."""
    shares = np.stack([np.mean(worked[:, part == number], axis=1) for number in np.unique(part)], axis=1)
    beyond = np.cumsum(shares[:, ::-1], axis=1)[:, ::-1] - shares
    return np.asarray(np.sum((1.0 - shares) * beyond, axis=1))
