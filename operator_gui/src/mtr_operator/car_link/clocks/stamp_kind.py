"""Which clock says when a frame was on the bus, and how far its stamp is from that instant."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum


class StampKind(enum.Enum):
    """The word is that of the record of a test."""

    ADAPTER = "the adapter's clock"
    KERNEL = "the kernel's clock"
    ARRIVAL = "this computer's clock when they are read"

    @property
    def sigma_s(self) -> float:
        """1 sigma of a stamp against the instant, beside what the map to the robot's clock has."""
        return _SIGMA_S[self]

    @property
    def text(self) -> str:
        """As it stands in the record of a test."""
        return f"{self.value}, 1 sigma {1000.0 * self.sigma_s:g} ms"


# Adapters stamp in whole milliseconds or finer. The kernel stamps what USB brings, which asks once a millisecond. A
# frame that is stamped when it is read has waited for the reading thread.
_SIGMA_S = {StampKind.ADAPTER: 0.0005, StampKind.KERNEL: 0.001, StampKind.ARRIVAL: 0.002}
