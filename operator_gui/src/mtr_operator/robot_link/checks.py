"""Acceptance checks that hold for every robot behind a RobotLink: virtual, simulated or real."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import Iterator

from mtr_operator.domain.ports import RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import RobotStatus

_STATUS_TIMEOUT_S = 2.0


@dataclass(frozen=True)
class HeightCheck:
    """Requested height of the key's lift; times on the robot's clock."""

    height_m: float
    tolerance: float = 0.1
    reach_within_s: float = 15.0
    hold_s: float = 5.0
    wall_limit_s: float = 60.0

    def is_near(self, height_m: float) -> bool:
        """Return True within the tolerance, which is relative to the height."""
        return abs(height_m - self.height_m) <= self.tolerance * self.height_m


def reach_and_hold_height(link: RobotLink, check: HeightCheck) -> str:
    """Move the Remote key to a height and check that it stays there; return the fault, empty without one."""
    desired = DesiredState(key_height_m=check.height_m)
    first_s = reached_s = math.nan
    for status in _answered(link, desired, check.wall_limit_s):
        now_s = status.stamp_s
        if math.isnan(first_s):
            first_s = now_s
        near = check.is_near(status.key_height_m)
        if math.isnan(reached_s):
            if near:
                reached_s = now_s
            elif now_s - first_s > check.reach_within_s:
                return (f"{check.height_m:g} m not reached in {check.reach_within_s:g} s; the key is at "
                        f"{status.key_height_m:.3f} m.")
        elif not near:
            return (f"{check.height_m:g} m was left {now_s - reached_s:.1f} s after it was reached; the key is at "
                    f"{status.key_height_m:.3f} m.")
        elif now_s - reached_s >= check.hold_s:
            return ""
    return f"The robot fell silent, or {check.wall_limit_s:g} s were not enough."


def _answered(link: RobotLink, desired: DesiredState, wall_limit_s: float) -> Iterator[RobotStatus]:
    """Yield the Statuses of the link, each answered with the desired state, until silence or the limit."""
    deadline = time.monotonic() + wall_limit_s
    while time.monotonic() < deadline:
        status = link.next_status(_STATUS_TIMEOUT_S)
        if status is None:
            return
        link.send(desired)
        yield status
