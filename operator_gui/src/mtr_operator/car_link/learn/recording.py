"""Frames of the bus while a person locked and unlocked the Car; of bounded size."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Mapping, NamedTuple, Sequence

from mtr_operator.domain.ports import LockState

from ..can_frame import CanFrame
from ..message_table import MessageId

# Four minutes of a full bus of 500 kbit/s.
MAX_FRAMES = 1_000_000


class Sample(NamedTuple):
    """Frame of a message: arrival on the laptop's monotonic clock in s, and its data as a number whose lowest byte is
    the first one; length: in bytes."""

    time_s: float
    value: int
    length: int


class Stay(NamedTuple):
    """Interval on the laptop's monotonic clock in s during which the Car was in one state. asked_s: time of the prompt
    for that state."""

    state: LockState
    asked_s: float
    begin_s: float
    end_s: float


@dataclass(frozen=True)
class Message:
    """All frames of one message in the order of arrival. length: bytes of the longest one."""

    id: MessageId
    length: int
    samples: Sequence[Sample]


class Recording:
    """Recording, thread-safe. Attributes: stays: states of the Car, in the order of time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._samples: dict[MessageId, list[Sample]] = {}
        self._lengths: dict[MessageId, int] = {}
        self._count = 0
        self.stays: list[Stay] = []

    @property
    def count(self) -> int:
        """Number of received frames, including those beyond the limit."""
        return self._count

    @property
    def is_full(self) -> bool:
        """True if frames beyond the limit were dropped."""
        return self._count > MAX_FRAMES

    def frame(self, frame: CanFrame) -> None:
        """Add a data frame."""
        key = (frame.can_id, frame.is_extended)
        with self._lock:
            self._count += 1
            if self.is_full:
                return
            self._lengths[key] = max(self._lengths.get(key, 0), len(frame.data))
            self._samples.setdefault(key, []).append(Sample(
                frame.arrival_s, int.from_bytes(frame.data, "little"), len(frame.data)))

    def messages(self) -> tuple[Message, ...]:
        """Return all messages in the order of their identifiers."""
        with self._lock:
            lengths: Mapping[MessageId, int] = dict(self._lengths)
            return tuple(Message(key, lengths[key], tuple(samples)) for key, samples in sorted(self._samples.items()))
