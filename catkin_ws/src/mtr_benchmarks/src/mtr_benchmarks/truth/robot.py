"""The robot: drives to waypoints, presses, is pushed, lifted, blocked and carried beside its line."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import List, NamedTuple, Optional, Set, Tuple

from mtr_operator.domain.requests import DesiredState, Direction, Waypoint
from mtr_operator.domain.robot_status import Interventions, WaypointResult

from .car import Place

KEY_X_M = 0.25
# Without a Command for so long the robot stands.
LINK_LIMIT_S = 1.0


class Pressed(NamedTuple):
    """A press as it truly was."""

    id: int
    start_s: float
    end_s: float
    locks: bool
    place: Place


class Push(NamedTuple):
    """Somebody drives the robot by hand with this velocity, in the Car coordinate system."""

    begin_s: float
    end_s: float
    x_mps: float
    y_mps: float


@dataclass
class RobotBody:
    """Where the robot truly is, by which it drives.

    beside: since when it drives how far beside its line. heights: since when its key is how much higher.
    pushes, blocks: by hand, and intervals in which an obstacle is in the way. press_delay_s: from order to press.
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
        """A Command arrived."""
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
        """Let time pass; presses that began."""
        self._move(now_s, dt_s)
        begun = [Pressed(number, start_s, start_s + hold_s, locks, self.key(now_s))
                 for start_s, number, locks, hold_s in self.waiting if start_s <= now_s]
        if begun:
            self.waiting = [item for item in self.waiting if item[0] > now_s]
            self.presses += begun
        return begun

    def key(self, now_s: float) -> Place:
        """Where the Remote key truly is."""
        return Place(self.x + KEY_X_M * math.cos(self.heading), self.y + KEY_X_M * math.sin(self.heading),
                     self.height_m(now_s))

    def height_m(self, now_s: float) -> float:
        """Height of the key, true and as the robot tells it."""
        since_s, by_m = self.heights
        return self.ordered_height_m + (by_m if now_s >= since_s else 0.0)

    def interventions(self, now_s: float) -> Interventions:
        """What a robot counts of this; that it is beside its line it does not know."""
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
        # On the way around the Car only where it ends matters here.
        if self.waypoint.direction is Direction.ANY or left_m <= limit_mps * dt_s:
            self.x, self.y, self.heading, self.result = goal_x, goal_y, goal.heading, WaypointResult.REACHED
            return
        self.x, self.y = self.x + dx / left_m * limit_mps * dt_s, self.y + dy / left_m * limit_mps * dt_s
        self.speed_mps = limit_mps
