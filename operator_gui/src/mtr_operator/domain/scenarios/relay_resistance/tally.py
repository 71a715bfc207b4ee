"""Requests beyond the nominal border with the extender off and on, and what they say of the Car. No robot is here."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Any, Iterable

from scipy.special import betaincinv

# The bound of a probability holds in so many of all tests.
BOUND_LEVEL = 0.95
DIGITS = 6


class Resistance(enum.Enum):
    """What an axis says of the Car. No number of requests shows that it never unlocks: they bound how often."""

    NOT_RESISTANT = "not_resistant"
    BOUNDED = "bounded"


@dataclass(frozen=True)
class Tried:
    """One request: the extender's state, distance of the Remote key in m, and whether the Car unlocked."""

    extender_on: bool
    distance_m: float
    unlocked: bool


def upper_bound(unlocks: int, requests: int) -> float:
    """One-sided 95 % upper bound of the probability that a request unlocks (Clopper and Pearson); 1 without requests.

    0 of n gives 1 - 0.05 ** (1 / n). The requests are taken for independent, with one probability for all.
    """
    if not 0 <= unlocks <= requests:
        raise ValueError(f"{unlocks} of {requests} requests")
    return 1.0 if unlocks == requests else float(betaincinv(unlocks + 1, requests - unlocks, BOUND_LEVEL))


def lower_bound(unlocks: int, requests: int) -> float:
    """One-sided 95 % lower bound of that probability; 0 without an unlock."""
    if not 0 <= unlocks <= requests:
        raise ValueError(f"{unlocks} of {requests} requests")
    return float(betaincinv(unlocks, requests - unlocks + 1, 1.0 - BOUND_LEVEL)) if unlocks else 0.0


@dataclass(frozen=True)
class Tally:
    """All requests with one state of the extender.

    unlocked_m, silent_m: distances of those at which the Car unlocked, and at which it did not.
    """

    unlocked_m: tuple[float, ...]
    silent_m: tuple[float, ...]

    @property
    def requests(self) -> int:
        """How many there were."""
        return len(self.unlocked_m) + len(self.silent_m)

    @property
    def bound(self) -> float | None:
        """See upper_bound; None without a request."""
        return round(upper_bound(len(self.unlocked_m), self.requests), DIGITS) if self.requests else None


def tally_of(tried: Iterable[Tried], extender_on: bool) -> Tally:
    """Those with this state, from near to far."""
    of_state = sorted((each.distance_m, each.unlocked) for each in tried if each.extender_on is extender_on)
    return Tally(tuple(round(distance_m, DIGITS) for distance_m, unlocked in of_state if unlocked),
                 tuple(round(distance_m, DIGITS) for distance_m, unlocked in of_state if not unlocked))


def tally_columns(tried: Iterable[Tried]) -> dict[str, Any]:
    """Columns of a result that follow from the requests."""
    requests = list(tried)
    columns: dict[str, Any] = {}
    for name, is_on in (("off", False), ("on", True)):
        tally = tally_of(requests, is_on)
        columns.update({f"requests_{name}": tally.requests, f"unlocks_{name}": len(tally.unlocked_m),
                        f"bound_{name}": tally.bound, f"unlocked_{name}_m": tally.unlocked_m,
                        f"silent_{name}_m": tally.silent_m})
    return columns


def resistance_of(unlocks_on: int) -> Resistance:
    """One unlock with the extender on is enough."""
    return Resistance.NOT_RESISTANT if unlocks_on else Resistance.BOUNDED
