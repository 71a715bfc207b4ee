"""Probability that consecutive polls agree while the noise changes between them; computed, not sampled.

The noise at the polls is a Markov chain (Ornstein-Uhlenbeck, correlation r from poll to poll). The number of polls that
have agreed so far is its second state. The density of the noise is followed from poll to poll by quadrature. It uses
nodes and weights of Gauss and Legendre on both sides of the threshold, where the chance of agreement jumps.
"""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
from typing import NamedTuple, Tuple

import numpy as np
from scipy.special import ndtr

from mtr_core.arrays import FloatArray

# Margins of the table in sigmas; beyond them the probabilities are 0 and 1 except for random misses.
_TABLE_SIGMAS = np.arange(-8.0, 8.01, 0.1)
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(64)  # type: ignore[no-untyped-call]
_OUTERMOST_SIGMAS = 6.5


class Polling(NamedTuple):
    """Polls of a passive entry.

    Attributes:
        polls: number of polls within the response time; the fraction is the chance of one more, for a random phase.
        debounce: number of consecutive polls that must agree.
        correlation: correlation of the noise from one poll to the next.
        lapse: probability of a random miss.
    """

    polls: float
    debounce: int
    correlation: float
    lapse: float


def finds_probability(margin_db: FloatArray, sigma_db: float, polling: Polling) -> FloatArray:
    """Return the probability that enough consecutive polls find the key; margin_db is relative to their threshold."""
    return np.interp(margin_db / sigma_db, _TABLE_SIGMAS, _table(polling, False))


def loses_probability(margin_db: FloatArray, sigma_db: float, polling: Polling) -> FloatArray:
    """Return the probability that enough consecutive polls do not find the key; random misses count."""
    return np.interp(margin_db / sigma_db, _TABLE_SIGMAS, _table(polling, True))


def single_probability(margin_db: FloatArray, sigma_db: float, lapse: float = 0.0) -> FloatArray:
    """Return the probability that one attempt works."""
    return (1.0 - lapse) * ndtr(margin_db / sigma_db)


@functools.lru_cache(maxsize=32)
def _table(polling: Polling, loses: bool) -> FloatArray:
    whole = math.floor(polling.polls + 1e-9)
    rest = polling.polls - whole
    rows = [_by_polls(margin, polling, loses, whole + 1) for margin in _TABLE_SIGMAS]
    return np.array([(1.0 - rest) * row[whole] + rest * row[whole + 1] for row in rows])


def _by_polls(margin_sigmas: float, polling: Polling, loses: bool, polls: int) -> FloatArray:
    """Return the probability that it has happened after 0, 1, 2, ... polls."""
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
    """Return nodes on both sides of the threshold, and the mass of the standard normal distribution at each."""
    split = min(max(threshold, -_OUTERMOST_SIGMAS), _OUTERMOST_SIGMAS)
    halves = [(split - _OUTERMOST_SIGMAS) / 2.0, (split + _OUTERMOST_SIGMAS) / 2.0]
    lengths = [(split + _OUTERMOST_SIGMAS) / 2.0, (_OUTERMOST_SIGMAS - split) / 2.0]
    nodes = np.concatenate([middle + length * _POINTS for middle, length in zip(halves, lengths)])
    mass = np.concatenate([length * _WEIGHTS for length in lengths]) * np.exp(-nodes * nodes / 2.0)
    return nodes, mass / mass.sum()


def _transitions(nodes: FloatArray, mass: FloatArray, correlation: float) -> FloatArray:
    """Return row by row the transitions of a node's mass: density of the pair divided by the density of its first
    (Mehler)."""
    rest = 1.0 - correlation * correlation
    exponent = -(correlation * correlation * (nodes[:, None] ** 2 + nodes[None, :] ** 2)
                 - 2.0 * correlation * nodes[:, None] * nodes[None, :]) / (2.0 * rest)
    moves = mass[None, :] * np.exp(exponent - exponent.max(axis=1, keepdims=True))
    return moves / moves.sum(axis=1, keepdims=True)
