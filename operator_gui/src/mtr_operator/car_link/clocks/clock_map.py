"""What both maps from the time stamps of CAN frames to the robot's clock have in common."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod

# A map is used once it rests on this many Statuses over this time of the robot's clock.
MIN_PAIRS = 20
MIN_SPAN_S = 2.0
# Even the fastest Status is late by its way: over Wi-Fi 1 to 5 ms, which no map can tell from the clocks' offset.
LEAST_WAY_S = 0.003


class ClockMap(ABC):
    """Maps the clock that stamps the frames ("local") to the robot's; fed in the order of arrival.

    Attributes:
        sigma_s: 1 sigma of a mapped time, NaN while the map is not ready.
    """

    sigma_s: float

    @abstractmethod
    def frame(self, local_s: float) -> None:
        """A frame with this local stamp arrived."""

    @abstractmethod
    def status(self, stamp_s: float, arrival_s: float) -> None:
        """A Status with this stamp of the robot's clock arrived at arrival_s of the laptop's."""

    @property
    @abstractmethod
    def is_ready(self) -> bool:
        """False until enough pairs are known."""

    @property
    def rate(self) -> float:
        """Robot time per local time."""
        return 1.0

    @abstractmethod
    def to_robot(self, local_s: float) -> float:
        """Robot's time at a local time; only when is_ready."""
