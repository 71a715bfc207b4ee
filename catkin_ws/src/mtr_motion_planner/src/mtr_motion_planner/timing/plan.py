"""A plan: a sequence of motions with their trajectories; only the first may start in motion, and each ends at rest."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, Tuple

from mtr_core.problems import ProblemError
from mtr_core.se2 import Pose2

from ..inputs import Point
from .motion import PlannedMotion
from .trajectory import Trajectory


class PlanRefused(ProblemError):
    """No plan exists that the robot may follow; the text states the cause."""


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
        """True if the motion is a turn on the spot."""
        return self.trajectory.length_m == 0.0


@dataclass(frozen=True)
class Plan:
    """Parts of a path to the goal, in the goal's frame."""

    goal: Pose2
    parts: Tuple[PlanPart, ...]

    @property
    def duration_s(self) -> float:
        """Duration of the plan."""
        return sum(part.trajectory.duration_s for part in self.parts)

    @property
    def points(self) -> List[Point]:
        """Line of the turn centre over all parts."""
        return [(float(x), float(y)) for part in self.parts for x, y, _ in part.trajectory.poses[::5]] + [
            (self.goal.x, self.goal.y)]

    def length_after(self, index: int) -> float:
        """Return the path length in m of the parts after the given one."""
        return sum(part.trajectory.length_m for part in self.parts[index + 1:])
