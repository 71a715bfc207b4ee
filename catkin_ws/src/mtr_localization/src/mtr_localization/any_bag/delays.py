"""Delay of a topic's messages from their stamps to the times at which the bag recorded them."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Optional, Tuple

import numpy as np

# Relative tolerance between recorded and stamped duration, within which the recording times are usable.
SAME_SPAN = 0.1


class Delays:
    """Delays of one topic."""

    def __init__(self) -> None:
        self._times_s: List[Tuple[float, float]] = []

    def add(self, received_s: float, stamp_s: float) -> None:
        """Add one more message."""
        self._times_s.append((received_s, stamp_s))

    @property
    def median_s(self) -> Optional[float]:
        """Median delay; None if recording times do not follow the stamps: all equal, or played at another rate."""
        if len(self._times_s) < 2:
            return None
        received_s, stamps_s = np.array(self._times_s).T
        span_s, recorded_s = float(np.ptp(stamps_s)), float(np.ptp(received_s))
        if span_s <= 0.0 or abs(recorded_s - span_s) > SAME_SPAN * span_s:
            return None
        return float(np.median(received_s - stamps_s))
