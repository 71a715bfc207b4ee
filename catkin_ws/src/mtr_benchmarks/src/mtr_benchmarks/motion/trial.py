"""One robot with planner and drive control in the simulated world, with perfect localization."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Optional, Set, Tuple

from mtr_core import names
from mtr_core.executors import InlineExecutor
from mtr_core.requests import Goal, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_description.shipped import shipped_geometry
from mtr_motion_planner.inputs import DesiredMotion, EstimatedCar, Inputs, RobotState
from mtr_motion_planner.outputs import PlannerOutput
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.planner import MotionPlanner
from mtr_simulation.sim import Sim
from mtr_simulation.site.car_shape import CarShape
from mtr_simulation.site.scenario import Scenario

from .limiter import Limiter, Velocity

TICK_S, PLANNER_TICKS = 0.02, 2
MAX_DURATION_S = 90.0
# Ticks in which the robot comes to rest after the planner has settled.
REST_TICKS = 25
# The clearance is computed every this number of ticks.
CLEARANCE_TICKS = 5


@dataclass(frozen=True)
class DrivenLeg:
    """Result of a motion to one goal; poses are the true ones in the Car's frame at each tick."""

    result: Result
    message: str
    time_s: float
    miss: Pose2
    poses: Tuple[Pose2, ...]
    clearance_m: float


class Trial:
    """Drives a robot from a pose in the Car's frame to goals.

    Attributes:
        contacts: bodies that the robot has touched.
    """

    def __init__(self, shape: CarShape, start: Pose2, parameters: MotionParameters):
        scenario = Scenario(car=shape, start_in_car=start, start_offset_m=0.0, start_offset_rad=0.0)
        self._sim = Sim(1, scenario)
        self._sim.scans_wanted = False
        self._world_from_car = scenario.world_from_car
        self._outline = outline_of(shape)
        self._centre = parameters.slip.base_from_centre
        self._planner = MotionPlanner(parameters, shipped_geometry().footprint(), InlineExecutor())
        self._limiter = Limiter()
        self._ticks, self._goals = 0, 0
        self._wanted: Velocity = (0.0, 0.0)
        self.contacts: Set[str] = set()

    def go(self, goal: Pose2, direction: Direction, speed: float) -> DrivenLeg:
        """Drive to a goal in the Car's frame; return when the planner has settled and the robot is at rest."""
        self._goals += 1
        order_goal = Goal(Waypoint(self._goals, "benchmark", names.CAR, goal, direction))
        output, poses, time_s = self._drive(order_goal, speed)
        clearance_m = math.inf
        if self._planner.site:
            keep_out = self._planner.site.keep_out
            clearance_m = min(keep_out.clearance(pose @ self._centre) for pose in poses[::CLEARANCE_TICKS])
        for _ in range(REST_TICKS):
            self._tick(order_goal, speed)
        miss = goal.inverse() @ self._sim.truth().car_from_base
        return DrivenLeg(output.result, output.message.text, time_s, miss, tuple(poses), clearance_m)

    def _drive(self, goal: Goal, speed: float) -> Tuple[PlannerOutput, List[Pose2], float]:
        """Run until the planner has settled; return its last output, the poses on the path, and the duration."""
        begun, poses = self._ticks, []
        output: Optional[PlannerOutput] = None
        while (self._ticks - begun) * TICK_S < MAX_DURATION_S:
            output = self._tick(goal, speed) or output
            poses.append(self._sim.truth().car_from_base)
            if output and output.result in (Result.REACHED, Result.REFUSED):
                break
        assert output
        return output, poses, (self._ticks - begun) * TICK_S

    def _tick(self, goal: Goal, speed: float) -> Optional[PlannerOutput]:
        """Run one step of 20 ms; drive control uses the planner's output of an earlier tick."""
        now_s = 1.0 + self._ticks * TICK_S
        velocity = self._limiter.follow(self._wanted)
        output = None
        if self._ticks % PLANNER_TICKS == 0:
            truth = self._sim.truth()
            robot = RobotState(now_s, True, truth.world_from_base, truth.linear_mps, truth.angular_radps)
            car = EstimatedCar(now_s, True, self._world_from_car, self._outline)
            output = self._planner.step(Inputs(now_s, DesiredMotion(now_s, goal, speed), robot, car))
            self._wanted = (output.linear_mps, output.angular_radps)
        self._sim.command(*velocity)
        self._sim.step()
        self.contacts |= self._sim.contacts()
        self._ticks += 1
        return output


def outline_of(shape: CarShape) -> Tuple[Tuple[float, float], ...]:
    """Return the Car locator's outline of such a Car: its rectangle."""
    x, y = 0.5 * shape.length_m, 0.5 * shape.width_m
    return (x, y), (-x, y), (-x, -y), (x, -y)
