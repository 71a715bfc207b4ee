"""Detects exchanged LiDARs by their levers: each moves around base_link at its own distance when the robot turns."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Optional

from mtr_core.se2 import Pose2
from mtr_description.mounts import LidarMounts

from .directions import front_of, rear_of
from .fits import ratio
from .steps import Step

# Minimum lever difference that is distinguishable from a base that does not turn about base_link.
MIN_LEVER_M = 0.05
MIN_TURN_RAD = 0.6


def lever_says_swapped(steps: List[Step], mounts: LidarMounts) -> Optional[bool]:
    """Return True if turns match exchanged LiDARs; None if the levers or the turns are too small."""
    if mounts.rear is None:
        return None
    turns = [(pose.heading, pose.y) for step in steps for pose in (front_of(step), rear_of(step)) if pose]
    if sum(abs(turn) for turn, _ in turns) < 2.0 * MIN_TURN_RAD:
        return None
    expected = aside_when_swapped(mounts)
    found = ratio([turn for turn, _ in turns], [aside for _, aside in turns])
    if found is None or abs(expected) < MIN_LEVER_M or found.sigma > 0.25 * abs(expected):
        return None
    return abs(found.value - expected) < abs(found.value)


def aside_when_swapped(mounts: LidarMounts) -> float:
    """Return the apparent path of base_link to its left for each rad of a turn on the spot, with exchanged LiDARs; in
    m."""
    if mounts.rear is None:
        return 0.0
    seen_from_base = mounts.front @ mounts.rear.inverse()
    small = 1e-3
    seen = seen_from_base @ Pose2(0.0, 0.0, small) @ seen_from_base.inverse()
    return seen.y / math.sin(small)
