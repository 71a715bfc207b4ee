"""Interface of the simulated Car's CAN adapter, and the fake that keeps the frames in memory."""
# SPDX-License-Identifier: Apache-2.0
from abc import ABC, abstractmethod
from typing import List

from .frames import Frame


class CanPort(ABC):
    """Where the simulated Car's frames go."""

    @abstractmethod
    def poll(self) -> None:
        """Handle what the host asked for; never waits."""

    @abstractmethod
    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Give a frame to the host if it listens; never waits. time_ns is when the frame was on the bus."""


class MemoryCanPort(CanPort):
    """Keeps all frames, for tests and for simulations without an adapter.

    Attributes:
        frames: everything sent, in order.
    """

    def __init__(self) -> None:
        self.frames: List[Frame] = []

    def poll(self) -> None:
        """Nobody asks."""

    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Keep the frame."""
        self.frames.append(Frame(can_id, data, time_ns))
