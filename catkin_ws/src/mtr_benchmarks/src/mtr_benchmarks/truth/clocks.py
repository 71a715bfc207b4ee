"""Clocks of robot, CAN adapter and laptop, and delays of messages between them."""
# SPDX-License-Identifier: Apache-2.0
import random
from dataclasses import dataclass, field
from typing import List, Tuple


@dataclass
class Clock:
    """Clock with true time plus an offset, drift and steps.

    Attributes:
        steps: true time and step in s, positive forwards.
    """

    offset_s: float
    drift_ppm: float = 0.0
    steps: List[Tuple[float, float]] = field(default_factory=list)

    def steady_s(self, time_s: float) -> float:
        """Return the time without steps."""
        return self.offset_s + time_s * (1.0 + 1e-6 * self.drift_ppm)

    def at(self, time_s: float) -> float:
        """Return the displayed time at a true time."""
        return self.steady_s(time_s) + sum(by_s for since_s, by_s in self.steps if since_s <= time_s)


@dataclass
class Way:
    """Delivers messages in order, after a minimum and a random delay.

    Attributes:
        stalls: intervals in which nothing is received.
    """

    chance: random.Random
    least_s: float
    jitter_s: float
    stalls: List[Tuple[float, float]] = field(default_factory=list)
    _last_s: float = 0.0

    def arrival_s(self, time_s: float) -> float:
        """Return the arrival time of a message that is sent now."""
        arrival_s = time_s + self.least_s + self.chance.expovariate(1.0 / self.jitter_s)
        ends = [end_s for begin_s, end_s in self.stalls if begin_s <= arrival_s < end_s]
        self._last_s = max([self._last_s, arrival_s, *ends])
        return self._last_s
