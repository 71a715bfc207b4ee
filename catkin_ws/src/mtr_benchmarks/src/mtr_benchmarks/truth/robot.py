"""Simulated robot: drives to waypoints, presses, and is pushed, lifted, blocked and moved off its line."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import List, NamedTuple, Optional, Set, Tuple

from mtr_operator.domain.requests import DesiredState, Direction, Waypoint
from mtr_operator.domain.robot_status import Interventions, WaypointResult

from .car import Place

KEY_X_M = 0.25
# Time without a Command after which the robot stops.
LINK_LIMIT_S = 1.0


class Pressed(NamedTuple):
    """True data of a press."""

    id: int
    start_s: float
    end_s: float
    locks: bool
    place: Place


class Push(NamedTuple):
    """Manual drive of the robot with this velocity, in the Car coordinate system."""

    begin_s: float
    end_s: float
    x_mps: float
    y_mps: float


@dataclass
class RobotBody:
    """True state of the robot, which is also the basis of its driving.

    Attributes:
        beside: time from which it drives off its line, and by how much.
        heights: time from which its key is at a wrong height, and by how much.
        pushes, blocks: manual drives, and intervals with an obstacle.
        press_delay_s: delay from order to press.
    """

    x: float = 8.0
    y: float = 0.0
    heading: float = math.pi
    speed_mps: float = 0.0
    ordered_height_m: float = 1.0
    desired: Optional[DesiredState] = None
    waypoint: Optional[Waypoint] = None
    result: WaypointResult = WaypointResult.NONE
    heard_s: float = 0.0
    press_delay_s: float = 0.03
    beside: Tuple[float, float] = (math.inf, 0.0)
    heights: Tuple[float, float] = (math.inf, 0.0)
    lifted_by_hand: bool = False
    pushes: List[Push] = field(default_factory=list)
    blocks: List[Tuple[float, float]] = field(default_factory=list)
    presses: List[Pressed] = field(default_factory=list)
    waiting: List[Tuple[float, int, bool, float]] = field(default_factory=list)
    lock_stops: int = 0
    _taken: Set[int] = field(default_factory=set)

    def take(self, desired: DesiredState, now_s: float) -> None:
        """Receive a Command."""
        self.desired, self.heard_s = desired, now_s
        if desired.key_height_m is not None:
            self.ordered_height_m = desired.key_height_m
        waypoint = desired.waypoint
        if waypoint is not None and (self.waypoint is None or waypoint.id != self.waypoint.id):
            self.waypoint, self.result = waypoint, WaypointResult.PENDING
        press = desired.press
        if press is not None and press.id not in self._taken:
            self._taken.add(press.id)
            self.waiting.append((now_s + self.press_delay_s, press.id, press.buttons[0] == 1, press.duration_s))

    def step(self, now_s: float, dt_s: float) -> List[Pressed]:
        """Advance the time; return the presses that began."""
        self._move(now_s, dt_s)
        begun = [Pressed(number, start_s, start_s + hold_s, locks, self.key(now_s))
                 for start_s, number, locks, hold_s in self.waiting if start_s <= now_s]
        if begun:
            self.waiting = [item for item in self.waiting if item[0] > now_s]
            self.presses += begun
        return begun

    def key(self, now_s: float) -> Place:
        """Return the true place of the Remote key."""
        return Place(self.x + KEY_X_M * math.cos(self.heading), self.y + KEY_X_M * math.sin(self.heading),
                     self.height_m(now_s))

    def height_m(self, now_s: float) -> float:
        """Return the height of the key, which is also the reported height."""
        since_s, by_m = self.heights
        return self.ordered_height_m + (by_m if now_s >= since_s else 0.0)

    def interventions(self, now_s: float) -> Interventions:
        """Return the interventions that a robot counts; it does not know that it is off its line."""
        return Interventions(manual_drives=sum(push.begin_s <= now_s for push in self.pushes),
                             manual_lifts=int(self.lifted_by_hand and self.heights[0] <= now_s),
                             blockages=sum(begin_s <= now_s for begin_s, _ in self.blocks),
                             lock_stops=self.lock_stops)

    def _move(self, now_s: float, dt_s: float) -> None:
        self.speed_mps = 0.0
        push = next((push for push in self.pushes if push.begin_s <= now_s < push.end_s), None)
        if push is not None:
            self.x, self.y = self.x + push.x_mps * dt_s, self.y + push.y_mps * dt_s
            self.speed_mps = math.hypot(push.x_mps, push.y_mps)
        elif self._may_drive(now_s) and not any(begin_s <= now_s < end_s for begin_s, end_s in self.blocks):
            self._drive(now_s, dt_s)

    def _may_drive(self, now_s: float) -> bool:
        desired = self.desired
        if desired is None or desired.stop or self.result is not WaypointResult.PENDING:
            return False
        if now_s - self.heard_s <= LINK_LIMIT_S:
            return True
        self.lock_stops += now_s - self.heard_s <= LINK_LIMIT_S + 0.0101
        return False

    def _drive(self, now_s: float, dt_s: float) -> None:
        assert self.waypoint is not None and self.desired is not None
        goal, since_beside_s, aside_m = self.waypoint.pose, *self.beside
        aside_m = aside_m if now_s >= since_beside_s else 0.0
        goal_x, goal_y = goal.x - aside_m * math.sin(goal.heading), goal.y + aside_m * math.cos(goal.heading)
        limit_mps = self.desired.max_speed_mps or 1.0
        dx, dy = goal_x - self.x, goal_y - self.y
        left_m = math.hypot(dx, dy)
        # The path around the Car is skipped, because only its end matters here.
        if self.waypoint.direction is Direction.ANY or left_m <= limit_mps * dt_s:
            self.x, self.y, self.heading, self.result = goal_x, goal_y, goal.heading, WaypointResult.REACHED
            return
        self.x, self.y = self.x + dx / left_m * limit_mps * dt_s, self.y + dy / left_m * limit_mps * dt_s
        self.speed_mps = limit_mps
