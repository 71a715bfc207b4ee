"""Uses a controller's reports as a heartbeat. No ROS and no files inside."""
# SPDX-License-Identifier: Apache-2.0
import math

from mtr_core.liveness import is_fresh

# Controllers that report while idle do so every 1 to 15 ms; a tick of the manual controller lasts 40 ms.
REGULAR_GAP_S = 0.1
REGULAR_FOR_S = 2.0


class Heartbeat:
    """Watches reports once they have arrived regularly from an idle controller: other controllers report only changes.

    After a loss the controller has to report regularly again. A trembling stick can imitate this once, but not
    repeatedly.
    """

    def __init__(self, lost_after_s: float):
        self._lost_after_s = lost_after_s
        self._beat_s = -math.inf
        self._regular_since_s = math.inf
        self._is_watched = self._is_lost = False

    @property
    def is_watched(self) -> bool:
        """True if a loss would be detected."""
        return self._is_watched

    def update(self, now_s: float, has_reported: bool, is_idle: bool) -> bool:
        """Process one tick; return True while the controller is lost.

        Args:
            has_reported: at least one report has arrived since the previous tick.
            is_idle: neither a button nor a stick has changed since then.
        """
        if has_reported:
            self._beat(now_s, is_idle)
        self._is_lost = self._is_watched and not is_fresh(now_s - self._beat_s, self._lost_after_s)
        return self._is_lost

    def _beat(self, now_s: float, is_idle: bool) -> None:
        if self._is_lost:
            self._is_watched = False
        if self._is_lost or not is_idle or not 0.0 <= now_s - self._beat_s <= REGULAR_GAP_S:
            self._regular_since_s = now_s
        self._beat_s = now_s
        self._is_watched = self._is_watched or now_s - self._regular_since_s >= REGULAR_FOR_S
