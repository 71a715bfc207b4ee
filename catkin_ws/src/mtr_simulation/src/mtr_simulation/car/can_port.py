"""Interface of the simulated Car's CAN adapter, and the fake that keeps the frames in memory."""
# SPDX-License-Identifier: Apache-2.0
from abc import ABC, abstractmethod
from typing import List, NamedTuple

from .frames import Frame


class SentFrame(NamedTuple):
    """One data frame that the host gave to the bus."""

    can_id: int
    data: bytes


class CanPort(ABC):
    """Where the simulated Car's frames go."""

    @abstractmethod
    def poll(self) -> None:
        """Handle what the host asked for; never waits."""

    @abstractmethod
    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Give a frame to the host if it listens; never waits. time_ns is when the frame was on the bus."""


    @abstractmethod
    def taken(self) -> List[SentFrame]:
        """Data frames that the host has sent since the last call, in order; never waits."""


class MemoryCanPort(CanPort):
    """Keeps all frames, for tests and for simulations without an adapter.

    Attributes:
        frames: everything sent, in order.
        from_host: what the host is to have sent; taken() empties it.
    """

    def __init__(self) -> None:
        self.frames: List[Frame] = []
        self.from_host: List[SentFrame] = []

    def poll(self) -> None:
        """Nobody asks."""

    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Keep the frame."""
        self.frames.append(Frame(can_id, data, time_ns))

    def taken(self) -> List[SentFrame]:
        """See CanPort."""
        taken, self.from_host = self.from_host, []
        return taken
