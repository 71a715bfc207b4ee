"""Observations of one run: true and estimated poses, simulated clock, and stops of drive control."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import Dict, List, Optional, Tuple

from mtr_core.se2 import Pose2

# Longest time between an estimated pose and the nearest true pose; the robot drives at most 2 cm in this time.
NEAREST_S = 0.021


@dataclass
class Notes:
    """Observations of one run.

    Attributes:
        truth: true pose of base_link in the true Car's frame, by its stamp in ns.
        believed: stamp in ns and estimated pose of base_link in the Car's frame, from localization and the Car locator,
            once the Car is located.
        clock: monotonic clock and simulated time in s, at the first and at the last message.
        blockages: number of stops for an obstacle or blindness since the robot's start.
        blocked: messages of drive control when it stopped for an obstacle.
    """

    truth: Dict[int, Tuple[float, float, float]] = field(default_factory=dict)
    believed: List[Tuple[int, float, float, float]] = field(default_factory=list)
    clock: List[Tuple[float, float]] = field(default_factory=list)
    blockages: int = 0
    blocked: List[str] = field(default_factory=list)

    @property
    def real_time_factor(self) -> Optional[float]:
        """Simulated time divided by wall time; None without clock messages."""
        if len(self.clock) < 2 or self.clock[-1][0] <= self.clock[0][0]:
            return None
        (wall_s, simulated_s), (wall_end_s, simulated_end_s) = self.clock[0], self.clock[-1]
        return (simulated_end_s - simulated_s) / (wall_end_s - wall_s)


def pose_errors(notes: Notes) -> List[Tuple[float, float]]:
    """Return position error in m and heading error in rad of each estimated pose against the true one at its time."""
    stamps = sorted(notes.truth)
    errors = []
    for stamp_ns, x, y, heading in notes.believed:
        before, after = _around(stamps, stamp_ns)
        if before is None or after is None or (after - before) * 1e-9 > 2.0 * NEAREST_S:
            continue
        true = between(Pose2(*notes.truth[before]), Pose2(*notes.truth[after]),
                       (stamp_ns - before) / (after - before) if after > before else 0.0)
        turn = math.remainder(heading - true.heading, 2.0 * math.pi)
        errors.append((math.hypot(x - true.x, y - true.y), abs(turn)))
    return errors


def between(first: Pose2, second: Pose2, share: float) -> Pose2:
    """Return the interpolated pose at a share of the path from one pose to the other."""
    turn = math.remainder(second.heading - first.heading, 2.0 * math.pi)
    return Pose2(first.x + share * (second.x - first.x), first.y + share * (second.y - first.y),
                 first.heading + share * turn)


def _around(stamps: List[int], stamp_ns: int) -> Tuple[Optional[int], Optional[int]]:
    """Return the last stamp that is not later and the first one that is not earlier."""
    low, high = 0, len(stamps)
    while low < high:
        middle = (low + high) // 2
        low, high = (middle + 1, high) if stamps[middle] < stamp_ns else (low, middle)
    after = stamps[low] if low < len(stamps) else None
    if after == stamp_ns:
        return after, after
    return (stamps[low - 1] if low else None), after
