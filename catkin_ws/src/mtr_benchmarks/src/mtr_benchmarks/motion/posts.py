"""Drives between two posts that slow the robot: planner, drive control and physics, at several speed limits."""
# SPDX-License-Identifier: Apache-2.0
import multiprocessing
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Sequence

from mtr_core import names
from mtr_core.executors import InlineExecutor
from mtr_core.requests import Goal, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_motion_planner.inputs import DesiredMotion, EstimatedCar, Inputs, RobotState
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.planner import MotionPlanner
from mtr_simulation.site.scenario import Scenario
from mtr_simulation.site.surroundings import Pole

from ..harness.rows import Requirement, Row
from .options import MotionOptions
from .rig import FOOTPRINT, SLOWED, TICK_S, Rig, Velocity

LIMITS_MPS = (0.1, 0.2, 0.3, 0.5, 0.7)
# Gaps that the robot passes slowly; the posts are on both sides of the path, halfway along it.
POST_OFFSETS_M = (0.65, 0.75)
START, WAY_M, PATIENCE_S = Pose2(0.0, 0.0, 0.0), 4.0, 60.0
PLANNER_TICKS = 2
# Pose at which the Car is out of sight.
FAR_AWAY = Pose2(60.0, 0.0, 0.0)
OUTLINE = ((2.25, 0.9), (-2.25, 0.9), (-2.25, -0.9), (2.25, -0.9))
OVER_LIMIT = Requirement("true speed above the limit on the way past two posts", "m/s", must=0.02)
PASSED = Requirement("ways past two posts: slowed, and driven to the end", "(share)", must=1.0, at_least=True)


class PostsDrive(NamedTuple):
    """One drive: speed limit, and distance of both posts' centres from the path."""

    limit_mps: float
    offset_m: float
    seed: int = 1


class PostsEnd(NamedTuple):
    """Result of a drive. over_mps: largest true speed minus the limit."""

    over_mps: float
    slowed: bool
    arrived: bool


@dataclass(frozen=True)
class PostsFigures:
    """Figures of all drives between posts; the names are those in the file."""

    over_speed_limit_mps: float
    post_ways_driven: float
    over_by_limit_mps: Dict[str, float]

    def rows(self) -> List[Row]:
        """Return the rows: speed above the limit, and share of conclusive drives."""
        return [Row(OVER_LIMIT, self.over_speed_limit_mps), Row(PASSED, self.post_ways_driven)]


def measure(options: MotionOptions) -> PostsFigures:
    """Simulate all drives."""
    drives = [PostsDrive(limit, offset, options.seed) for limit in LIMITS_MPS for offset in POST_OFFSETS_M]
    with multiprocessing.Pool(options.jobs) as pool:
        return figures(drives, pool.map(drive, drives, chunksize=1))


def figures(drives: Sequence[PostsDrive], ends: Sequence[PostsEnd]) -> PostsFigures:
    """Return the figures of these drives."""
    return PostsFigures(max(end.over_mps for end in ends),
                        sum(end.slowed and end.arrived for end in ends) / len(ends),
                        {f"{way.limit_mps:g} m/s, {way.offset_m:g} m": round(end.over_mps, 3)
                         for way, end in zip(drives, ends)})


def drive(way: PostsDrive) -> PostsEnd:
    """Drive between the posts to the goal."""
    posts = tuple(Pole(0.5 * WAY_M, side * way.offset_m) for side in (1.0, -1.0))
    rig = Rig(Scenario(world_from_car=FAR_AWAY, start_in_car=FAR_AWAY.inverse() @ START, start_offset_m=0.0,
                       start_offset_rad=0.0, poles=posts), way.seed)
    parameters = MotionParameters()
    planner = MotionPlanner(parameters, FOOTPRINT, InlineExecutor())
    goal = Goal(Waypoint(1, "benchmark", names.MAP, START @ Pose2(WAY_M, 0.0, 0.0), Direction.FORWARD))
    velocity: Velocity = (0.0, 0.0)
    fastest_mps, slowed, result = 0.0, False, Result.PENDING
    for tick in range(round((PATIENCE_S + WAY_M / way.limit_mps) / TICK_S)):
        if tick % PLANNER_TICKS == 0:
            output = planner.step(_inputs(rig, goal, way.limit_mps))
            velocity, result = (output.linear_mps, output.angular_radps), output.result
        slowed = rig.step(velocity).zone == SLOWED or slowed
        fastest_mps = max(fastest_mps, abs(rig.sim.truth().linear_mps))
        if result in (Result.REACHED, Result.REFUSED):
            break
    return PostsEnd(fastest_mps - way.limit_mps, slowed, result == Result.REACHED)


def _inputs(rig: Rig, goal: Goal, limit_mps: float) -> Inputs:
    truth, now_s = rig.sim.truth(), rig.time_s
    robot = RobotState(now_s, True, truth.world_from_base, truth.linear_mps, truth.angular_radps)
    return Inputs(now_s, DesiredMotion(now_s, goal, limit_mps), robot, EstimatedCar(now_s, True, FAR_AWAY, OUTLINE))
