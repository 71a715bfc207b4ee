"""One robot with planner and drive control in the simulated world, with perfect localization."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Tuple

from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_motion_planner.inputs import Car, Goal, Inputs, Order, RobotState
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.planner import MotionPlanner
from mtr_motion_planner.replanning import InlineExecutor
from mtr_simulation.scenario import CarShape, Scenario
from mtr_simulation.sim import Sim

from .limiter import Limiter, Velocity

TICK_S, PLANNER_TICKS = 0.02, 2
LONGEST_S = 90.0


@dataclass(frozen=True)
class Leg:
    """What a motion to one goal came to; poses are the true ones in the Car's frame at each tick."""

    result: Result
    message: str
    time_s: float
    miss: Pose2
    poses: Tuple[Pose2, ...]
    clearance_m: float


class Trial:
    """A Car, a robot that stands at a pose in its frame, and what happens on the way to goals.

    Attributes:
        contacts: bodies that the robot has touched.
    """

    def __init__(self, shape: CarShape, start: Pose2, parameters: MotionParameters):
        scenario = Scenario(car=shape, start_in_car=start, start_offset_m=0.0, start_offset_rad=0.0)
        self._sim = Sim(1, scenario)
        self._sim.scans_wanted = False
        self._world_from_car = scenario.world_from_car
        self._outline = outline_of(shape)
        self._centre = parameters.footprint.slip.base_from_centre
        self._planner, self._limiter = MotionPlanner(parameters, InlineExecutor()), Limiter()
        self._ticks, self._goals = 0, 0
        self._wanted: Velocity = (0.0, 0.0)
        self.contacts: set = set()

    def go(self, goal: Pose2, direction: Direction, speed: float) -> Leg:
        """Drive to a goal in the Car's frame; ends when the planner has settled and the robot has come to rest."""
        self._goals += 1
        order_goal = Goal(self._goals, True, goal, direction)
        begun, poses, least = self._ticks, [], math.inf
        output = None
        while (self._ticks - begun) * TICK_S < LONGEST_S:
            output = self._tick(order_goal, speed) or output
            truth = self._sim.truth()
            poses.append(truth.car_from_base)
            if output and output.result in (Result.REACHED, Result.REFUSED):
                break
        time_s = (self._ticks - begun) * TICK_S
        if self._planner.site:
            least = min(self._planner.site.keep_out.clearance(pose @ self._centre) for pose in poses[::5])
        for _ in range(25):
            self._tick(order_goal, speed)
        miss = goal.inverse() @ self._sim.truth().car_from_base
        return Leg(output.result, output.message, time_s, miss, tuple(poses), least)

    def _tick(self, goal: Goal, speed: float):
        """One step of 20 ms; drive control acts on what the planner said at an earlier tick."""
        now_s = 1.0 + self._ticks * TICK_S
        velocity = self._limiter.follow(self._wanted)
        output = None
        if self._ticks % PLANNER_TICKS == 0:
            truth = self._sim.truth()
            robot = RobotState(now_s, True, truth.world_from_base, truth.linear_mps, truth.angular_radps)
            car = Car(now_s, True, self._world_from_car, self._outline)
            output = self._planner.step(Inputs(now_s, Order(now_s, goal, speed), robot, car))
            self._wanted = (output.linear_mps, output.angular_radps)
        self._sim.command(*velocity)
        self._sim.step()
        self.contacts |= self._sim.contacts()
        self._ticks += 1
        return output


def outline_of(shape: CarShape) -> Tuple[Tuple[float, float], ...]:
    """What the Car locator reports of such a Car: its rectangle."""
    x, y = 0.5 * shape.length_m, 0.5 * shape.width_m
    return (x, y), (-x, y), (-x, -y), (x, -y)
