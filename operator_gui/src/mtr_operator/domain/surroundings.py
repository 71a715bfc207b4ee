"""What the robot sees, for pictures and for a look at the plan; no measurement rests on it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass

from .geometry.pose import Point


class StopZone(enum.Enum):
    """What the robot's collision stop does."""

    UNKNOWN = 0
    CLEAR = 1
    SLOWED = 2
    BLOCKED = 3
    BLIND = 4


@dataclass(frozen=True)
class Surroundings:
    """points: returns of the LiDARs in base_link. path: to the waypoint, in the Car coordinate system. All in m.

    obstacle: distance from the robot's footprint, and bearing in base_link, of what hinders it; None when nothing does.
    """

    points: tuple[Point, ...] = ()
    path: tuple[Point, ...] = ()
    zone: StopZone = StopZone.UNKNOWN
    obstacle: tuple[float, float] | None = None
