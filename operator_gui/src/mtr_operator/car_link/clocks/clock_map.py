"""Common interface of the maps from the time stamps of CAN frames to the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod

# A map is used after this many Statuses over this time of the robot's clock.
MIN_PAIRS = 20
MIN_SPAN_S = 2.0
# Even the fastest Status has a transmission delay, over Wi-Fi 1 to 5 ms. A map cannot separate it from the clock
# offset.
LEAST_WAY_S = 0.003


class ClockMap(ABC):
    """Maps the clock that stamps the frames ("local") to the robot's; fed in the order of arrival.

    Attributes:
        sigma_s: 1 sigma of a mapped time, NaN while the map is not ready.
    """

    sigma_s: float

    @abstractmethod
    def frame(self, local_s: float) -> None:
        """Add a frame with this local stamp."""

    @abstractmethod
    def status(self, stamp_s: float, arrival_s: float) -> None:
        """Add a Status with its stamp (robot's clock) and its arrival (laptop's clock)."""

    @property
    @abstractmethod
    def is_ready(self) -> bool:
        """True if the map has enough pairs."""

    @property
    def rate(self) -> float:
        """Robot time per local time."""
        return 1.0

    @abstractmethod
    def to_robot(self, local_s: float) -> float:
        """Return the robot's time at a local time; valid only if is_ready."""
