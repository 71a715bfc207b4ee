"""Interface of the simulated Car's CAN adapter, and a fake that stores the frames in memory."""
# SPDX-License-Identifier: Apache-2.0
from abc import ABC, abstractmethod
from typing import List, NamedTuple

from .frames import Frame


class SentFrame(NamedTuple):
    """One data frame that the host sent to the bus."""

    can_id: int
    data: bytes


class CanPort(ABC):
    """CAN adapter that receives the simulated Car's frames."""

    @abstractmethod
    def poll(self) -> None:
        """Handle the host's commands; never wait."""

    @abstractmethod
    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Give a frame to the host if it listens; never wait. time_ns is the time of the frame on the bus."""


    @abstractmethod
    def taken(self) -> List[SentFrame]:
        """Return the data frames that the host has sent since the last call, in order; never wait."""


class MemoryCanPort(CanPort):
    """Stores all frames, for tests and for simulations without an adapter.

    Attributes:
        frames: all sent frames, in order.
        from_host: frames that the host sends; taken() empties it.
    """

    def __init__(self) -> None:
        self.frames: List[Frame] = []
        self.from_host: List[SentFrame] = []

    def poll(self) -> None:
        """Do nothing, because no host sends commands."""

    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Store the frame."""
        self.frames.append(Frame(can_id, data, time_ns))

    def taken(self) -> List[SentFrame]:
        """See CanPort."""
        taken, self.from_host = self.from_host, []
        return taken
