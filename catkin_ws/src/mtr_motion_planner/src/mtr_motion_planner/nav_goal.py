"""Goals that a developer sets in rviz; the Operator's always go before them."""
# SPDX-License-Identifier: Apache-2.0
import threading
from dataclasses import replace
from typing import Optional

from mtr_core import names
from mtr_core.requests import RVIZ, Goal, Waypoint
from mtr_core.se2 import Pose2

from .inputs import DesiredMotion


class NavGoals:
    """Takes the newest goal and puts it into an order that has none, while the robot follows waypoints."""

    def __init__(self, speed_mps: float):
        self._speed_mps = speed_mps
        self._lock = threading.Lock()
        self._count = 0
        self._goal: Optional[Goal] = None
        self._refusal = ""

    def take(self, pose: Pose2, in_car_frame: bool) -> None:
        """Store a goal set in rviz; may be called from any thread."""
        with self._lock:
            self._count += 1
            self._goal = Goal(Waypoint(self._count, RVIZ, names.CAR if in_car_frame else names.MAP, pose))

    def joined(self, desired: Optional[DesiredMotion]) -> Optional[DesiredMotion]:
        """Return the order, with the goal from rviz if the order has none; a goal of the Operator discards it."""
        with self._lock:
            if desired is None or self._goal is None:
                return desired
            has_goal = desired.goal.waypoint.id != 0
            if has_goal or not desired.follows_waypoints:
                self._goal = None
                why = "the Operator's goes before it" if has_goal else "the robot is held or not ready for waypoints"
                self._refusal = f"The goal from rviz is dropped: {why}."
                return desired
            return replace(desired, goal=self._goal, max_speed_mps=self._speed_mps)

    def refusal(self) -> str:
        """Return once why the newest goal was dropped; otherwise an empty text."""
        with self._lock:
            said, self._refusal = self._refusal, ""
            return said
