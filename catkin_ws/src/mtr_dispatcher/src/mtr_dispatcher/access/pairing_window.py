"""Limits of pairing in time and tries. No sockets and no clock inside."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.errors import check_range

MIN_SECONDS, MAX_SECONDS, DEFAULT_SECONDS = 10.0, 600.0, 120.0
MAX_TRIES = 3
# Pause after the first try; it doubles with each further one.
FIRST_PAUSE_S = 2.0


@dataclass(frozen=True)
class PairingLimits:
    """Limits chosen by the person at the robot. seconds: time for which the window is open."""

    seconds: float = DEFAULT_SECONDS
    tries: int = MAX_TRIES

    def __post_init__(self) -> None:
        check_range("seconds", self.seconds, MIN_SECONDS, MAX_SECONDS, "s")


class PairingWindow:
    """Open from its construction on; times are of the steady clock.

    Attributes:
        tries: started tries. A try counts from its start, because a peer that breaks off has used its guess.
        strange: connections that did not use the pairing protocol.
        paired: a try succeeded.
    """

    def __init__(self, limits: PairingLimits, now_s: float):
        self._limits, self._end_s, self._next_s = limits, now_s + limits.seconds, now_s
        self.tries = self.strange = 0
        self.paired = False

    def left_s(self, now_s: float) -> float:
        """Return how long the window stays open in s; 0 if a laptop is paired, or time or tries are used up."""
        if self.paired or self.tries >= self._limits.tries:
            return 0.0
        return max(self._end_s - now_s, 0.0)

    def pause_s(self, now_s: float) -> float:
        """Return how long the next try has to wait, in s."""
        return max(self._next_s - now_s, 0.0)

    def begin_try(self, now_s: float) -> None:
        """Count a try before its peer gets an answer that depends on the code."""
        self.tries += 1
        self._next_s = now_s + FIRST_PAUSE_S * 2.0 ** (self.tries - 1)

    def why_closed(self) -> str:
        """Return a sentence for the person at the robot."""
        if self.paired:
            return ""
        if self.tries >= self._limits.tries:
            return f"Pairing has ended: {self.tries} tries were wrong. Begin anew with a new code."
        return f"Pairing has ended: nobody was paired within {self._limits.seconds:g} s."
