"""Location of a signal on the buses of a car: bus, message and name."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .counting import CountRange

MessageKey = tuple[str, int, bool]


@dataclass(frozen=True, eq=False)
class Place:
    """A signal of a message (cantools') of a bus. values: of a counter."""

    bus: str
    message: Any
    signal: str
    values: CountRange | None = None

    @property
    def key(self) -> MessageKey:
        """Key of the frames that carry the signal."""
        return self.bus, self.message.frame_id, self.message.is_extended_frame

    @property
    def declared(self) -> Any:
        """The signal (cantools')."""
        return self.message.get_signal_by_name(self.signal)

    @property
    def counts(self) -> CountRange:
        """Range of a counter."""
        return self.values or CountRange(0, (1 << self.declared.length) - 1, self.declared.length)
