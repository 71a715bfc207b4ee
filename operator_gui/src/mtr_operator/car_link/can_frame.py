"""A received CAN frame."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from .clocks.stamp_kind import StampKind


@dataclass(frozen=True)
class CanFrame:
    """A received frame.

    arrival_s: laptop's monotonic clock. stamp_ms: adapter's clock that restarts each minute. stamp_s: adapter's clock
    that does not restart. A stamp is None if the adapter does not supply it. kind: clock that timed the frame; None
    derives it from the stamps. is_fd: a CAN FD frame. bus: name of the Car's bus, empty for the bus of the state.
    """

    can_id: int
    is_extended: bool
    data: bytes
    arrival_s: float
    stamp_ms: int | None = None
    stamp_s: float | None = None
    kind: StampKind | None = None
    is_fd: bool = False
    bus: str = ""

    @property
    def is_stamped(self) -> bool:
        """True if the adapter stamped the frame."""
        return self.stamp_ms is not None or self.stamp_s is not None

    @property
    def stamps(self) -> StampKind:
        """Clock that timed the frame."""
        return self.kind or (StampKind.ADAPTER if self.is_stamped else StampKind.ARRIVAL)
