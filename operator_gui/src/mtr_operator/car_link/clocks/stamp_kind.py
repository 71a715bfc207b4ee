"""Clock that timed a frame, and the uncertainty of its stamp."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum


class StampKind(enum.Enum):
    """Kinds of stamps; the value is the word in the record of a test."""

    ADAPTER = "the adapter's clock"
    KERNEL = "the kernel's clock"
    ARRIVAL = "this computer's clock when they are read"

    @property
    def sigma_s(self) -> float:
        """1 sigma of the stamp error, in addition to the uncertainty of the map to the robot's clock."""
        return _SIGMA_S[self]

    @property
    def text(self) -> str:
        """Description in the record of a test."""
        return f"{self.value}, 1 sigma {1000.0 * self.sigma_s:g} ms"


# Adapters stamp in whole milliseconds or finer. The kernel stamps frames at USB polls, once a millisecond. A frame that
# is stamped at reading has waited for the reading thread.
_SIGMA_S = {StampKind.ADAPTER: 0.0005, StampKind.KERNEL: 0.001, StampKind.ARRIVAL: 0.002}
