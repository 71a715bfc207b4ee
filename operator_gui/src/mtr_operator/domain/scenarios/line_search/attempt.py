"""Attempts to have the Car react to a key that stands at a place."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

from ...actions.distance import Distance


@dataclass(frozen=True)
class AttemptMade:
    """Where the key was when it was tried, and whether the Car reacted."""

    place: Distance
    worked: bool


@dataclass(frozen=True)
class AttemptsMade:
    """Those on a line.

    Attributes:
        all: in order.
        unconfirmed: those of them that worked against all expectation, and not again: nothing follows from them.
    """

    all: Sequence[AttemptMade] = ()
    unconfirmed: Sequence[AttemptMade] = ()

    @property
    def counted(self) -> list[AttemptMade]:
        """Those that the estimate is made of."""
        return [made for made in self.all if not any(made is other for other in self.unconfirmed)]

    @property
    def unconfirmed_text(self) -> str:
        """Their places as they are recorded, in m."""
        return " ".join(f"{made.place.distance_m:.2f}" for made in self.unconfirmed)
