"""A plan: motions with their trajectories, one after the other, each from and to standstill but the first."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, Tuple

from mtr_core.problems import ProblemError
from mtr_core.se2 import Pose2

from ..inputs import Point
from .motion import PlannedMotion
from .trajectory import Trajectory


class PlanRefused(ProblemError):
    """There is no plan that the robot may follow; the text says why."""


@dataclass(frozen=True)
class Moving:
    """Pose of the turn centre in the frame of the plan, and the robot's velocity."""

    pose: Pose2
    linear_mps: float = 0.0
    angular_radps: float = 0.0


@dataclass(frozen=True)
class PlanPart:
    """One motion and its trajectory."""

    motion: PlannedMotion
    trajectory: Trajectory

    @property
    def is_on_the_spot(self) -> bool:
        """True when its way is an angle."""
        return self.trajectory.length_m == 0.0


@dataclass(frozen=True)
class Plan:
    """Parts that lead to the goal, in the goal's frame."""

    goal: Pose2
    parts: Tuple[PlanPart, ...]

    @property
    def duration_s(self) -> float:
        """Time that it takes."""
        return sum(part.trajectory.duration_s for part in self.parts)

    @property
    def points(self) -> List[Point]:
        """Line of the turn centre over all parts."""
        return [(float(x), float(y)) for part in self.parts for x, y, _ in part.trajectory.poses[::5]] + [
            (self.goal.x, self.goal.y)]

    def length_after(self, index: int) -> float:
        """Way in m of the parts behind the one with the index."""
        return sum(part.trajectory.length_m for part in self.parts[index + 1:])
