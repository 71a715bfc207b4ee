"""How long and how often somebody may try to be paired. No sockets and no clock inside."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.errors import check_range

MIN_SECONDS, MAX_SECONDS, DEFAULT_SECONDS = 10.0, 600.0, 120.0
MAX_TRIES = 3
# After the first wrong try; it doubles with each.
FIRST_PAUSE_S = 2.0


@dataclass(frozen=True)
class PairingLimits:
    """What the person at the robot has chosen. seconds: how long the window is open."""

    seconds: float = DEFAULT_SECONDS
    tries: int = MAX_TRIES

    def __post_init__(self) -> None:
        check_range("seconds", self.seconds, MIN_SECONDS, MAX_SECONDS, "s")


class PairingWindow:
    """Open from its making; times are of the steady clock.

    Attributes:
        tries: begun ones. A try counts from its beginning: who breaks off has had its guess.
        strange: connections that spoke no pairing.
        paired: one succeeded.
    """

    def __init__(self, limits: PairingLimits, now_s: float):
        self._limits, self._end_s, self._next_s = limits, now_s + limits.seconds, now_s
        self.tries = self.strange = 0
        self.paired = False

    def left_s(self, now_s: float) -> float:
        """How long it stays open, 0 when it is closed: paired, out of time, or out of tries."""
        if self.paired or self.tries >= self._limits.tries:
            return 0.0
        return max(self._end_s - now_s, 0.0)

    def pause_s(self, now_s: float) -> float:
        """How long the next try has to wait."""
        return max(self._next_s - now_s, 0.0)

    def begin_try(self, now_s: float) -> None:
        """Somebody gets an answer that depends on the code."""
        self.tries += 1
        self._next_s = now_s + FIRST_PAUSE_S * 2.0 ** (self.tries - 1)

    def why_closed(self) -> str:
        """A sentence for the person at the robot."""
        if self.paired:
            return ""
        if self.tries >= self._limits.tries:
            return f"Pairing has ended: {self.tries} tries were wrong. Begin anew with a new code."
        return f"Pairing has ended: nobody was paired within {self._limits.seconds:g} s."
