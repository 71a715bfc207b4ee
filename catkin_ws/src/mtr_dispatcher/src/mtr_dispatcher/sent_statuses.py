"""When the latest Statuses were sent: the age of what a Command answers, whatever was done to the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
from collections import OrderedDict
from typing import NamedTuple, Optional, Tuple

# About 30 s at 10 Hz; a goodbye that answers an older one has expired too.
KEPT = 300
# An application may answer with the stamp of the pose in the Status instead of the time at which it was sent.
MAX_STAMP_DIFFERENCE_S = 1.0


class Sent(NamedTuple):
    """One Status: when it was sent, on the robot's clock and on the steady one."""

    time_s: float
    steady_s: float


class SentStatuses:
    """Remembers the latest ones by their ids."""

    def __init__(self) -> None:
        self._sent: OrderedDict[int, Sent] = OrderedDict()

    def add(self, status_id: int, time_s: float, steady_s: float) -> None:
        """A Status is sent."""
        self._sent[status_id] = Sent(time_s, steady_s)
        while len(self._sent) > KEPT:
            self._sent.popitem(last=False)

    def answered_s(self, answer: Tuple[int, float]) -> Optional[float]:
        """Steady time at which the Status was sent that is answered by id and robot time; None for one never sent.

        The time guards against ids of before a restart.
        """
        status_id, robot_time_s = answer
        sent = self._sent.get(status_id)
        if sent is None or not abs(robot_time_s - sent.time_s) <= MAX_STAMP_DIFFERENCE_S:
            return None
        return sent.steady_s
