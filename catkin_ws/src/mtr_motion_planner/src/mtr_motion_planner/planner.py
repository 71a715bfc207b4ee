"""The motion planner: at each tick from the inputs to a velocity and a status."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Optional, Tuple

from mtr_core.se2 import Pose2
from mtr_core.states import Result

from .follower import Follower
from .inputs import NO_GOAL, Car, Goal, Inputs, Point, RobotState, fault_of
from .obstacle import CarObstacle, is_material_change
from .parameters import MotionParameters
from .plan import Plan, PlanRefused
from .planning import Planning
from .ramp import Ramp
from .tolerance import miss_of, sentence_about, was_displaced
from .watch import StallWatch, is_heading_into

SETTLED = (Result.REACHED, Result.REFUSED)


@dataclass(frozen=True)
class Output:
    """Velocity and status of one tick; path only when it is new."""

    linear_mps: float
    angular_radps: float
    active: bool
    goal_id: int
    result: Result
    remaining_m: float
    message: str
    path: Optional[Tuple[Point, ...]] = None


class MotionPlanner:
    """Leads the robot to one goal at a time.

    A new goal id replaces the goal at once; a plan is made when the goal or the Car changes, not at each tick.
    """

    def __init__(self, parameters: MotionParameters):
        self._parameters = parameters
        self._ramp = Ramp(parameters)
        self._stall = StallWatch()
        self._goal = NO_GOAL
        self._car: Optional[Car] = None
        self._obstacle: Optional[CarObstacle] = None
        self._restart(Result.IDLE)

    def step(self, inputs: Inputs) -> Output:
        """Velocity and status at a tick."""
        self._path = None
        order = inputs.order
        if order and order.goal.goal_id != self._goal.goal_id:
            self._goal = order.goal
            self._restart(Result.PENDING if order.goal.goal_id else Result.IDLE)
        fault = fault_of(inputs, self._parameters.input_age_limit_s)
        if fault:
            self._ramp.drop()
            self._stall.reset()
            idle = self._goal.goal_id == 0
            return self._output(Result.IDLE if idle else self._pending_or_settled(), 0.0, "" if idle else fault)
        self._ramp.begin(inputs.tick_s, inputs.robot)
        if self._goal.goal_id == 0:
            self._ramp.brake()
            return self._output(Result.IDLE, 0.0, "")
        self._take_car(inputs.car)
        return self._pursue(inputs.robot, order.max_speed_mps, inputs.tick_s)

    def _restart(self, result: Result) -> None:
        self._result, self._message = result, ""
        self._follower: Optional[Follower] = None
        self._braking = False
        self._corrections = 0
        self._settled_at: Optional[Pose2] = None
        self._stall.reset()

    def _pending_or_settled(self) -> Result:
        return self._result if self._result in SETTLED else Result.PENDING

    def _take_car(self, car: Car) -> None:
        if self._car is not None and not is_material_change(self._car, car):
            return
        self._car = car
        self._obstacle = CarObstacle(car, self._parameters) if len(car.outline) >= 3 else None
        self._restart(Result.PENDING)

    def _pursue(self, robot: RobotState, max_speed_mps: float, now_s: float) -> Output:
        if self._result in SETTLED:
            if not was_displaced(self._settled_at, robot.pose):
                self._ramp.brake()
                return self._output(self._result, 0.0, self._message)
            self._restart(Result.PENDING)
        if self._follower is None and not self._prepare(robot):
            self._ramp.brake()
            return self._output(self._result, 0.0, self._message)
        return self._follow(robot, max_speed_mps, now_s)

    def _prepare(self, robot: RobotState) -> bool:
        """Make a plan that goes on from the present motion; False while the robot brakes, or when it must stay."""
        if self._braking and not self._ramp.is_still:
            return False
        try:
            plan = self._make_plan(robot.pose)
        except PlanRefused as refusal:
            self._settle(Result.REFUSED, str(refusal), robot)
            return False
        follower = Follower(plan, self._parameters)
        self._braking = not self._ramp.is_still and not follower.continues(robot, self._ramp.linear_mps)
        if self._braking:
            return False
        self._follower = follower
        self._path = tuple(plan.points)
        return True

    def _make_plan(self, start: Pose2) -> Plan:
        goal = goal_in_map(self._goal, self._car)
        if self._obstacle is None:
            raise PlanRefused("The Car's outline is unknown, so there is no way around it.")
        return Planning(self._obstacle, self._parameters).plan(start, goal, self._goal.direction)

    def _follow(self, robot: RobotState, max_speed_mps: float, now_s: float) -> Output:
        follower = self._follower
        wanted = follower.step(robot, max_speed_mps, self._ramp.linear_mps)
        if wanted is None:
            self._arrive(robot, follower.plan.goal)
            self._ramp.brake()
            return self._output(self._result, 0.0, self._message)
        if is_heading_into(self._obstacle, robot, wanted, self._parameters):
            self._ramp.brake()
            return self._output(Result.BLOCKED, wanted.remaining_m, "The robot stands before it touches the Car.")
        self._ramp.drive(wanted.linear_mps, wanted.angular_radps)
        if self._stall.stalls(robot, self._ramp, now_s):
            return self._output(Result.BLOCKED, wanted.remaining_m, "The robot is told to drive and does not move.")
        return self._output(Result.PENDING, wanted.remaining_m, "")

    def _arrive(self, robot: RobotState, goal: Pose2) -> None:
        """All legs are done: within tolerance, or one more attempt, or near enough."""
        self._follower = None
        miss = miss_of(goal, robot.pose, self._parameters)
        if miss.is_within:
            self._settle(Result.REACHED, "", robot)
        elif self._corrections < self._parameters.corrections:
            self._corrections += 1
        elif miss.is_near:
            self._settle(Result.REACHED, sentence_about(miss, self._corrections), robot)
        else:
            self._settle(Result.REFUSED, sentence_about(miss, self._corrections), robot)

    def _settle(self, result: Result, message: str, robot: RobotState) -> None:
        self._result, self._message, self._settled_at = result, message, robot.pose
        self._braking = False

    def _output(self, result: Result, remaining_m: float, message: str) -> Output:
        active = self._goal.goal_id != 0 or not self._ramp.is_still
        return Output(self._ramp.linear_mps, self._ramp.angular_radps, active, self._goal.goal_id, result, remaining_m,
                      message, self._path)


def goal_in_map(goal: Goal, car: Car) -> Pose2:
    """Goal's pose in map; PlanRefused when it has none."""
    if not goal.pose.is_finite():
        raise PlanRefused("The goal is not a number.")
    if not goal.in_car_frame:
        return goal.pose
    if not car.located:
        raise PlanRefused("The Car has not been located, so a goal relative to it means nothing yet.")
    return car.pose @ goal.pose
