"""What reports how far a phone that is the Car's key takes itself to be: a port, whatever carries the figures.

A feed is read at each Status, as the Car's bus is: all that has come until then counts as of that Status, so that a
figure is placed on the robot's clock to a tenth of a second, and earlier than it was known it never counts.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from .limits import Limit
from .results.refused import Refused
from .robot_status import RobotStatus

# Ranging may read a little below zero at its anchor; no phone ranges farther.
REPORTED = Limit("reported distance", -10.0, 500.0, "m")


@dataclass(frozen=True)
class Reported:
    """One distance that phone or Car told.

    time_s: robot's clock when it was known. feed_s: by the feed's own clock, of any origin; None where it tells none.
    age_s: how old the feed says that its figure was when it left; 0 where it says nothing.
    """

    time_s: float
    distance_m: float
    feed_s: float | None = None
    age_s: float = 0.0


class DistanceFeed(ABC):
    """Connection to what reports the distance."""

    @property
    @abstractmethod
    def name(self) -> str:
        """What it is, for the record of a test: "TCP 127.0.0.1:7070"."""

    @abstractmethod
    def connect(self) -> None:
        """Connect; errors.ConnectionFailed says in a sentence what is wrong."""

    @abstractmethod
    def observe(self, status: RobotStatus) -> list[Reported]:
        """What has come since the last call, in its order, as of this Status."""

    @property
    @abstractmethod
    def problem(self) -> str:
        """Why nothing can come now; empty while the feed is there, also when it is silent."""

    @property
    def refused(self) -> Refused:
        """Figures that were no distance, since the start."""
        return Refused()

    @abstractmethod
    def close(self) -> None:
        """Disconnect; safe to call twice."""
