"""How far the robot's pose drifted on the way round: the same sides of the Car, seen first and seen last."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, Tuple

import numpy as np

from .profile import BIN_M, Profile

LEAST_COMMON_BINS = 4
# Sides by the axis of the Car's frame along which their distance is told.
SIDES_ALONG_X, SIDES_ALONG_Y = ("front", "rear"), ("left", "right")


def drift_between(first: Dict[str, Profile], last: Dict[str, Profile]) -> Tuple[float, float]:
    """Shift in m along the Car's x and y, the larger of both sides each; 0 where no side was seen twice."""
    along_x, along_y = ([_shift(first[name], last[name]) for name in names] for names in (SIDES_ALONG_X, SIDES_ALONG_Y))
    return max(along_x), max(along_y)


def _shift(first: Profile, last: Profile) -> float:
    levels = dict(_by_bin(first))
    differences = [abs(level - levels[number]) for number, level in _by_bin(last) if number in levels]
    return float(np.median(differences)) if len(differences) >= LEAST_COMMON_BINS else 0.0


def _by_bin(profile: Profile) -> List[Tuple[int, float]]:
    return [(int(np.floor(along / BIN_M)), level) for along, level in zip(profile.along, profile.outward)]
