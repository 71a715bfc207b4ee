"""Messages of the bus with their statistics on the laptop's clock; of bounded size."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from dataclasses import dataclass, field
from typing import Mapping

from mtr_operator.domain.ports import BusMessage, BusMessages

from .can_frame import CanFrame

# A whole car has some hundred messages on one bus; further ones are counted, but not stored.
MAX_MESSAGES = 512
# The cycle is the mean of this number of gaps: current, and steady enough to be read.
_GAPS = 20

MessageId = tuple[int, bool]


@dataclass
class _Row:
    count: int = 0
    data: bytes = b""
    arrivals_s: collections.deque[float] = field(default_factory=lambda: collections.deque(maxlen=_GAPS + 1))


class MessageTable:
    """Table of messages, updated with every data frame in the order of arrival. names: of known messages, by identifier
    and is_extended."""

    def __init__(self, names: Mapping[MessageId, str] | None = None):
        self._names = dict(names or {})
        self._rows: dict[MessageId, _Row] = {}
        self._others = 0

    def frame(self, frame: CanFrame) -> None:
        """Add a frame."""
        key = (frame.can_id, frame.is_extended)
        row = self._rows.get(key)
        if row is None:
            if len(self._rows) >= MAX_MESSAGES:
                self._others += 1
                return
            row = self._rows[key] = _Row()
        row.count += 1
        row.data = frame.data
        row.arrivals_s.append(frame.arrival_s)

    def messages(self, now_s: float) -> BusMessages:
        """Return all messages in the order of their identifiers, at a time of the laptop's clock."""
        return BusMessages(tuple(self._message(key, row, now_s) for key, row in sorted(self._rows.items())),
                           self._others)

    def _message(self, key: MessageId, row: _Row, now_s: float) -> BusMessage:
        arrivals_s = row.arrivals_s
        gaps = len(arrivals_s) - 1
        cycle_s = (arrivals_s[-1] - arrivals_s[0]) / gaps if gaps > 0 else None
        # A kernel stamp may be read slightly before its frame counts as read.
        age_s = max(now_s - arrivals_s[-1], 0.0)
        return BusMessage(*key, self._names.get(key, ""), row.count, cycle_s, age_s, row.data)
