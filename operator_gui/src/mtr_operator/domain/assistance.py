"""Who does at the Car what the robot cannot: takes its handle, switches an extender; an output, or a person."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod

# Who does it when the test wants it.
OUTPUT, OPERATOR = "output", "operator"


class HandlePort(ABC):
    """Takes the Car's handle when the test wants it: an output that is switched, or a person who is asked.

    Attributes:
        by: OUTPUT or OPERATOR.
    """

    by: str

    @abstractmethod
    def request(self, distance_m: float) -> None:
        """Have the handle taken, with the key at a distance that a person is told. Does not wait."""

    @abstractmethod
    def is_taken(self) -> bool:
        """True when it has been taken since request()."""

    @abstractmethod
    def release(self) -> None:
        """The handle may be let go, and nobody need take it any more; safe to call twice."""


class ExtenderPort(ABC):
    """Switches the extender, which carries the radio between Car and key over a distance: a relay attack.

    Attributes:
        by: OUTPUT or OPERATOR.
    """

    by: str

    @abstractmethod
    def switch(self, is_on: bool) -> None:
        """Have the extender switched on or off. Does not wait."""

    @abstractmethod
    def is_switched(self) -> bool:
        """True when it has been done since switch()."""

    @abstractmethod
    def release(self) -> None:
        """Nobody need switch it any more; it stays as it is. Safe to call twice."""
