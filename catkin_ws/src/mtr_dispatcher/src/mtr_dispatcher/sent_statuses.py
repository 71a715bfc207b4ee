"""Send times of the latest Statuses, for the age of the Status that a Command answers, despite clock steps."""
# SPDX-License-Identifier: Apache-2.0
from collections import OrderedDict
from typing import NamedTuple, Optional, Tuple

# About 30 s at 10 Hz; a goodbye that answers an older Status has expired too.
KEPT = 300
# An application may answer with the stamp of the pose in the Status instead of the time at which it was sent.
MAX_STAMP_DIFFERENCE_S = 1.0


class Sent(NamedTuple):
    """Send time of one Status on the robot's clock and on the steady clock, s."""

    time_s: float
    steady_s: float


class SentStatuses:
    """Stores the latest send times by Status id."""

    def __init__(self) -> None:
        self._sent: OrderedDict[int, Sent] = OrderedDict()

    def add(self, status_id: int, time_s: float, steady_s: float) -> None:
        """Store the send time of a Status."""
        self._sent[status_id] = Sent(time_s, steady_s)
        while len(self._sent) > KEPT:
            self._sent.popitem(last=False)

    def answered_s(self, answer: Tuple[int, float]) -> Optional[float]:
        """Return the steady time at which the answered Status was sent, or None for one that was never sent.

        The answer has the id and the robot time of the Status; the time excludes ids from before a restart.
        """
        status_id, robot_time_s = answer
        sent = self._sent.get(status_id)
        if sent is None or not abs(robot_time_s - sent.time_s) <= MAX_STAMP_DIFFERENCE_S:
            return None
        return sent.steady_s
