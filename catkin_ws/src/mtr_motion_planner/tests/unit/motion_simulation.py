"""A minimal robot for tests: it slips like a skid-steered base, lags, and receives commands late."""
# SPDX-License-Identifier: Apache-2.0
import math
from collections import deque
from dataclasses import replace
from typing import List, Optional

from shapely.geometry import Polygon

from mtr_core.executors import InlineExecutor
from mtr_core.requests import NO_GOAL, Goal, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_description.shipped import shipped_geometry
from mtr_motion_planner.geometry.robot_outline import RobotOutline
from mtr_motion_planner.inputs import NO_AREA, CollisionStop, DesiredMotion, EstimatedCar, Inputs, RobotState
from mtr_motion_planner.outputs import PlannerOutput
from mtr_motion_planner.parameters import MotionParameters, Slip
from mtr_motion_planner.planner import MotionPlanner

PARAMETERS = MotionParameters()
EXPECTED_SLIP = PARAMETERS.slip
FOOTPRINT = shipped_geometry().footprint()
ROBOT = RobotOutline(FOOTPRINT, EXPECTED_SLIP)
PERIOD_S, SUBSTEPS = 0.04, 4
LAG_S = 0.03
BASE_ACCELERATION_MPS2, BASE_ANGULAR_RADPS2 = 3.0, 6.0
OUTLINE = ((2.25, 0.6), (1.9, 0.9), (-1.9, 0.9), (-2.25, 0.6), (-2.25, -0.6), (-1.9, -0.9), (1.9, -0.9), (2.25, -0.6))
ORIGIN = Pose2(0.0, 0.0, 0.0)


def car_at(pose: Pose2 = ORIGIN, located: bool = True, outline=OUTLINE) -> EstimatedCar:
    """Return a located Car of ordinary size."""
    return EstimatedCar(0.0, located, pose, outline)


class SimulatedRobot:
    """Robot, planner and Car; `run` steps them until the goal is settled."""

    def __init__(self, pose: Pose2, car: Optional[EstimatedCar] = None, held: bool = False, slip: Slip = EXPECTED_SLIP,
                 parameters: MotionParameters = PARAMETERS):
        self.pose, self.car, self.held, self.slip = pose, car or car_at(), held, slip
        self.speed = self.yaw_rate = 0.0
        self.planner = MotionPlanner(parameters, FOOTPRINT, InlineExecutor())
        self.collision_stop: Optional[CollisionStop] = None
        self.area = NO_AREA
        self.speed_cap, self.is_degenerate = math.inf, False
        self.position_sigma_m = self.heading_sigma = 0.0
        self.ticks = 0
        self.goal = NO_GOAL
        self.max_speed = 0.5
        self.least_clearance, self.fastest_mps = math.inf, 0.0
        self.outputs: List[PlannerOutput] = []
        self.poses: List[Pose2] = []
        self._queue = deque([(0.0, 0.0)], maxlen=2)

    @property
    def now(self) -> float:
        """Time in s."""
        return 1.0 + self.ticks * PERIOD_S

    def go(self, goal_id: int, x: float, y: float, heading_deg: float, direction=Direction.ANY, *,
           in_car=True) -> None:
        """Order a goal."""
        pose = Pose2(x, y, math.radians(heading_deg))
        self.goal = Goal(Waypoint(goal_id, "test", "car" if in_car else "map", pose, direction))

    def inputs(self) -> Inputs:
        """Return the current inputs of the planner."""
        robot = RobotState(self.now, True, self.pose, self.speed, self.yaw_rate, "", self.is_degenerate,
                           self.position_sigma_m, self.heading_sigma)
        return Inputs(self.now, DesiredMotion(self.now, self.goal, self.max_speed), robot,
                      replace(self.car, stamp_s=self.now), self.collision_stop, self.area)

    def tick(self) -> PlannerOutput:
        """Run one period."""
        output = self.planner.step(self.inputs())
        self.outputs.append(output)
        self._move(output)
        self.ticks += 1
        return output

    def run(self, limit_s: float = 120.0) -> PlannerOutput:
        """Step until the goal is reached or refused."""
        for _ in range(int(limit_s / PERIOD_S)):
            output = self.tick()
            if output.result in (Result.REACHED, Result.REFUSED):
                return output
        return output

    def run_for(self, seconds: float) -> PlannerOutput:
        """Step for a while."""
        for _ in range(round(seconds / PERIOD_S)):
            output = self.tick()
        return output

    def planner_says(self, result: Result, word: str) -> bool:
        """Return True if the goal ends with this result and the word in the sentence, also one second later."""
        first, later = self.run(), self.run_for(1.0)
        return all(output.result == result and word in output.message.text for output in (first, later))

    def goal_in_map(self) -> Pose2:
        """Return the goal pose in map."""
        waypoint = self.goal.waypoint
        return self.car.pose @ waypoint.pose if waypoint.frame == "car" else waypoint.pose

    def miss(self) -> Pose2:
        """Return the robot's pose as seen from the goal."""
        return self.goal_in_map().inverse() @ self.pose

    def largest_step(self) -> float:
        """Return the largest change of the commanded speed between two ticks."""
        speeds = [output.linear_mps for output in self.outputs]
        return max(abs(b - a) for a, b in zip(speeds, speeds[1:]))

    def _move(self, output: PlannerOutput) -> None:
        self._queue.append((output.linear_mps, output.angular_radps))
        linear, angular = (0.0, 0.0) if self.held else self._queue[0]
        linear = limited(linear, self.speed_cap)
        dt = PERIOD_S / SUBSTEPS
        for _ in range(SUBSTEPS):
            acceleration = limited((linear - self.speed) / LAG_S, BASE_ACCELERATION_MPS2)
            self.speed += acceleration * dt
            self.yaw_rate += limited((angular - self.yaw_rate) / LAG_S, BASE_ANGULAR_RADPS2) * dt
            side = self.yaw_rate * (self.slip.acceleration_slip_s2 * acceleration - self.slip.turn_centre_x_m
                                    - self.slip.curve_slip_s2 * self.speed * abs(self.yaw_rate))
            self.pose = self.pose @ Pose2(self.speed * dt, side * dt, self.yaw_rate * dt)
        self.poses.append(self.pose)
        self.fastest_mps = max(self.fastest_mps, abs(self.speed))
        self.least_clearance = min(self.least_clearance, self.clearance())

    def clearance(self) -> float:
        """Return the footprint's distance from the Car, computed independently of the planner."""
        if len(self.car.outline) < 3:
            return math.inf
        corners = [self.pose.apply(x, y) for x, y in ((.27, .215), (-.254, .215), (-.254, -.215), (.27, -.215))]
        car = Polygon([self.car.pose.apply(x, y) for x, y in self.car.outline])
        return Polygon(corners).distance(car)


def limited(value: float, limit: float) -> float:
    """Return the value limited to [-limit, limit]."""
    return max(-limit, min(limit, value))
