"""Distances on one line at which 50 and 95 % of the presses work, including its permanent fading.

The p(d) of a line is not monotonic and may cross a level several times. Its range at a level is defined by the nearest
falling curve (antitonic regression), which is where the integral of the excess over the level is largest:

    d_level = argmax over D of  integral from 0 to D of  (p(x) - level) dx.

For each hypothesis (d50 and width of the mean curve, rate of random misses, permanent part of the fading) a curve of
the line is drawn, with a fading that explains the presses (fading_draws). The level positions of the draws are the
posterior. Source: Barlow et al., Statistical Inference under Order Restrictions, 1972.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

import numpy as np
import numpy.typing as npt
from scipy.special import entr, logit

from ..interval import FloatArray, Interval, interval_of_draws
from .fading_draws import FadingDraws, explaining
from .lattice import Lattice
from .likelihood import Press
from .posterior import RadialPosterior
from .transition import WIDTH_PER_SCALE, SingleArray, falling_single

HALF, SURE = 0.5, 0.95
# Nodes of the fading at one place, in its own sigmas, and half their distance.
_NODES = np.linspace(-3.2, 3.2, 33, dtype=np.float32)
_HALF_NODE = float(_NODES[1] - _NODES[0]) / 2.0
# Weight of the information on d95 relative to d50; d50 ends a radial.
SURE_PART = 1.0
# Number of equally large groups of draws, by distance, for the entropy of a press's outcome.
_PARTS = 20
_SEED = 1
# Number of places beyond the ends of the grid whose fading is drawn too.
_BEYOND = 4
_TINY = 1e-9


class LineBoundary:
    """Draws of the line's own curve after the presses so far.

    part: draws of different parts are independent. d50_m, d95_m: of each draw.
    """

    def __init__(self, posterior: RadialPosterior, presses: Sequence[Press], lattice: Lattice, count: int,
                 part: int = 0):
        chance = np.random.default_rng(_SEED + part)
        grid = posterior.hypotheses
        self._distances_m = np.arange(grid.edges_m[0], grid.edges_m[-1], grid.step_m)
        first, last = lattice.place_of(grid.edges_m[0]), lattice.place_of(grid.edges_m[-1])
        numbers = np.arange(first - _BEYOND, last + _BEYOND + 1)
        draws = _faded(drawn(posterior, count, len(numbers), chance), presses, lattice, numbers, chance)
        displaced = draws.fading.astype(np.float32) @ lattice.weights(self._distances_m, numbers).astype(np.float32)
        beyond_m = draws.d50_m[:, None] + draws.fading_m.astype(np.float32)[:, None] * displaced - self._distances_m
        self._logits: SingleArray = (beyond_m * WIDTH_PER_SCALE / draws.own_width_m[:, None]).astype(np.float32)
        self._works: SingleArray = np.float32(0.5) + np.float32(0.5) * np.tanh(np.float32(0.5) * self._logits)
        self._sure_of_button = (1.0 - draws.lapse).astype(np.float32)[:, None]
        below = np.cumsum(self._works, axis=1, dtype=np.float64)
        self.d50_m, self.d95_m = self._crossing(below, HALF), self._crossing(below, SURE)

    def d50(self) -> Interval:
        """Return the distance at which half of the presses work, without random misses."""
        return interval_of_draws(self.d50_m)

    def d95(self) -> Interval:
        """Return the distance at which 95 % of the presses work."""
        return interval_of_draws(self.d95_m)

    def likely_ends_m(self, quantiles: FloatArray) -> FloatArray:
        """Return quantiles of the distance at which half of the presses work."""
        return np.asarray(np.quantile(self.d50_m, quantiles))

    def information(self, places_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the probability that a press works, and its information on d50 and d95 in nats, at each place."""
        columns = np.minimum(np.searchsorted(self._distances_m, places_m), len(self._distances_m) - 1)
        works = self._sure_of_button * self._works[:, columns]
        mean = np.mean(works, axis=0, dtype=np.float64)
        told = sum(part * (_entropy(mean) - _mean_entropy_within(works, distance_m))
                   for part, distance_m in ((1.0, self.d50_m), (SURE_PART, self.d95_m)))
        return mean, np.maximum(told, 0.0)

    def _crossing(self, below: FloatArray, level: float) -> FloatArray:
        """Return the distance at which each draw's falling curve crosses the level, or an end if it does not.

        below: sums of the curve up to each distance.
        """
        logits, distances_m = self._logits, self._distances_m
        last = np.argmax(below - level * np.arange(1.0, below.shape[1] + 1.0), axis=1)
        rows, following = np.arange(len(logits)), np.minimum(last + 1, logits.shape[1] - 1)
        # Between two distances the logit is linear, at any slope of the curve.
        here, after = logits[rows, last].astype(float), logits[rows, following].astype(float)
        part = np.clip((here - logit(level)) / np.maximum(here - after, _TINY), 0.0, 1.0)
        return np.asarray(distances_m[last] + part * (distances_m[following] - distances_m[last]))


def _mean_entropy_within(works: SingleArray, distance_m: FloatArray) -> FloatArray:
    """Return the entropy of a press's outcome if the group of draws with the distance is known."""
    order = np.argsort(distance_m, kind="stable")
    parts = np.array_split(works[order], _PARTS)
    means = np.stack([np.mean(part, axis=0, dtype=np.float64) for part in parts])
    shares = np.array([len(part) for part in parts]) / len(order)
    return np.asarray(shares @ _entropy(means))


def _entropy(probability: FloatArray) -> FloatArray:
    result: FloatArray = entr(probability) + entr(1.0 - probability)
    return result


def drawn(posterior: RadialPosterior, count: int, places: int, chance: np.random.Generator) -> FadingDraws:
    """Return systematic draws, evenly over the distance: each hypothesis occurs in proportion to its probability."""
    grid = posterior.hypotheses
    by_place = np.moveaxis(posterior.probability, -1, 0)
    below = np.cumsum(by_place.ravel())
    chosen = np.searchsorted(below, (np.arange(count) + 0.5) / count * below[-1])
    place, shared, lapse, width = np.unravel_index(np.minimum(chosen, below.size - 1), by_place.shape)
    within_m = grid.step_m * (chance.random(count) - 0.5)
    return FadingDraws(grid.d50_m[place] + within_m, grid.width_m[width], grid.lapse[lapse], grid.shared[shared],
                       chance.standard_normal((count, places)))


def _faded(draws: FadingDraws, presses: Sequence[Press], lattice: Lattice, numbers: npt.NDArray[np.int_],
           chance: np.random.Generator) -> FadingDraws:
    """Add the fading that explains the presses, first the presses at the places."""
    at_places: dict[int, list[Press]] = {}
    for press in presses:
        if not lattice.is_between(press.distance_m):
            at_places.setdefault(lattice.place_of(press.distance_m), []).append(press)
    for number, beside in at_places.items():
        if numbers[0] <= number <= numbers[-1]:
            draws.fading[:, number - numbers[0]] = _known_fading(draws, beside, chance)
    are_between = [lattice.is_between(press.distance_m) for press in presses]
    if not any(are_between):
        return draws
    weights = lattice.weights(np.array([press.distance_m for press in presses]), numbers)
    return explaining(draws, presses, are_between, weights, chance)


def _known_fading(draws: FadingDraws, presses: Sequence[Press], chance: np.random.Generator) -> SingleArray:
    """Draw the fading of one place, in sigmas, from its posterior after the presses there."""
    log = np.broadcast_to(-0.5 * _NODES.astype(np.float64) ** 2, (len(draws.d50_m), len(_NODES)))
    moved_m = draws.d50_m[:, None] + draws.fading_m[:, None] * _NODES
    for press in presses:
        works = (1.0 - draws.lapse[:, None]) * falling_single(press.distance_m, moved_m, draws.own_width_m[:, None])
        log = log + np.log(np.maximum(works if press.worked else 1.0 - works, _TINY))
    below = np.cumsum(np.exp(log - np.max(log, axis=1, keepdims=True)), axis=1)
    wanted = chance.random(len(below))[:, None] * below[:, -1:]
    node = np.minimum(np.sum(below < wanted, axis=1), len(_NODES) - 1)
    return np.asarray(_NODES[node] + _HALF_NODE * (2.0 * chance.random(len(node)) - 1.0), np.float32)
