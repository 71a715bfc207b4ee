"""Probability that some polls one after the other agree, while the noise goes on between them; computed, not sampled.

The noise at the polls is a Markov chain (Ornstein-Uhlenbeck, correlation r from poll to poll), and the number of polls
that agreed so far is its second state. The density of the noise is followed from poll to poll by quadrature: nodes and
weights of Gauss and Legendre on both sides of the threshold, where the chance of agreement jumps.
"""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from typing import NamedTuple, Tuple

import numpy as np
from scipy.special import ndtr

from mtr_core.arrays import FloatArray

# Margins in sigmas for which the table is made; beyond, the probabilities are 0 and 1 but for lapses.
_TABLE_SIGMAS = np.arange(-8.0, 8.01, 0.1)
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(64)  # type: ignore[no-untyped-call]
_OUTERMOST_SIGMAS = 6.5


class Polling(NamedTuple):
    """Polls of a passive entry.

    Attributes:
        polls: that fit into the response time; what is left over is the chance that one more does, as the phase is
            any.
        debounce: polls that have to agree, one after the other.
        correlation: of the noise from one poll to the next.
        lapse: probability that a poll fails for no reason.
    """

    polls: float
    debounce: int
    correlation: float
    lapse: float


def finds_probability(margin_db: FloatArray, sigma_db: float, polling: Polling) -> FloatArray:
    """Enough polls in a row find the key; margin_db is above the threshold at which they do."""
    return np.interp(margin_db / sigma_db, _TABLE_SIGMAS, _table(polling, False))


def loses_probability(margin_db: FloatArray, sigma_db: float, polling: Polling) -> FloatArray:
    """Enough polls in a row do not find it; a lapse is such a poll too."""
    return np.interp(margin_db / sigma_db, _TABLE_SIGMAS, _table(polling, True))


def single_probability(margin_db: FloatArray, sigma_db: float, lapse: float = 0.0) -> FloatArray:
    """One attempt works."""
    return (1.0 - lapse) * ndtr(margin_db / sigma_db)


@functools.lru_cache(maxsize=32)
def _table(polling: Polling, loses: bool) -> FloatArray:
    whole = math.floor(polling.polls + 1e-9)
    rest = polling.polls - whole
    rows = [_by_polls(margin, polling, loses, whole + 1) for margin in _TABLE_SIGMAS]
    return np.array([(1.0 - rest) * row[whole] + rest * row[whole + 1] for row in rows])


def _by_polls(margin_sigmas: float, polling: Polling, loses: bool, polls: int) -> FloatArray:
    """Probability that it has happened after 0, 1, 2, ... polls."""
    nodes, mass = _stationary(-margin_sigmas)
    works = (1.0 - polling.lapse) * (nodes >= -margin_sigmas)
    agrees = 1.0 - works if loses else works
    moves = _transitions(nodes, mass, polling.correlation)
    agreed = np.zeros((polling.debounce, len(nodes)))
    agreed[0] = mass
    done = np.zeros(polls + 1)
    for number in range(polls):
        more = agreed * agrees
        done[number + 1] = done[number] + more[-1].sum()
        disagrees = (agreed - more).sum(axis=0)
        agreed = np.vstack([disagrees, more[:-1]]) @ moves
    return done


def _stationary(threshold: float) -> Tuple[FloatArray, FloatArray]:
    """Nodes on both sides of the threshold, and the mass of the standard normal distribution at each."""
    split = min(max(threshold, -_OUTERMOST_SIGMAS), _OUTERMOST_SIGMAS)
    halves = [(split - _OUTERMOST_SIGMAS) / 2.0, (split + _OUTERMOST_SIGMAS) / 2.0]
    lengths = [(split + _OUTERMOST_SIGMAS) / 2.0, (_OUTERMOST_SIGMAS - split) / 2.0]
    nodes = np.concatenate([middle + length * _POINTS for middle, length in zip(halves, lengths)])
    mass = np.concatenate([length * _WEIGHTS for length in lengths]) * np.exp(-nodes * nodes / 2.0)
    return nodes, mass / mass.sum()


def _transitions(nodes: FloatArray, mass: FloatArray, correlation: float) -> FloatArray:
    """Row by row where the mass of a node goes; density of the pair over the density of its first, by Mehler."""
    rest = 1.0 - correlation * correlation
    exponent = -(correlation * correlation * (nodes[:, None] ** 2 + nodes[None, :] ** 2)
                 - 2.0 * correlation * nodes[:, None] * nodes[None, :]) / (2.0 * rest)
    moves = mass[None, :] * np.exp(exponent - exponent.max(axis=1, keepdims=True))
    return moves / moves.sum(axis=1, keepdims=True)
