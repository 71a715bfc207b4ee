"""What the robot is ordered: nothing new before all that was found is on disk."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from .requests import DesiredState
from .results.journal import Journal
from .robot_status import RobotStatus

# Wall time that an answer waits for the disk; most have written by then.
DISK_PATIENCE_S = 0.03


class KeptOrders:
    """Of one run."""

    def __init__(self) -> None:
        self._ordered = DesiredState()

    def newest(self, desired: DesiredState, journal: Journal, status: RobotStatus | None) -> DesiredState:
        """The desired state, or that of before while the journal has not kept all. A stop waits for no disk."""
        if desired.stop or is_kept(journal, status):
            self._ordered = desired
        return self._ordered


def is_kept(journal: Journal, status: RobotStatus | None) -> bool:
    """Whether all that was found is on disk; where the robot's time stands still, it is waited for until it is."""
    return journal.wait(math.inf if status is None or status.waits_for_answer else DISK_PATIENCE_S)
