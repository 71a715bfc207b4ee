"""The motion planner: at each tick from the inputs to a velocity and a status."""
# SPDX-License-Identifier: Apache-2.0
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Optional, Tuple

from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2
from mtr_core.states import Result

from .background_planning import LEAD_S, BackgroundPlanning
from .following.follower import Follower, Wanted
from .following.ramp import Ramp
from .following.tolerance import miss_of, sentence_about, was_displaced
from .following.watch import StallWatch, is_heading_into
from .following.watch import sentence_about as sentence_about_drive
from .inputs import NO_GOAL, Car, Inputs, Order, Point, RobotState, Zone, fault_of
from .parameters import MotionParameters
from .search.options import Goal
from .search.planning import Planning, moves
from .site import Site
from .timing.plan import Moving, Plan

SETTLED = (Result.REACHED, Result.REFUSED)
ROUNDING_MPS = 0.005
STANDING = (Zone.BLOCKED, Zone.BLIND)


@dataclass(frozen=True)
class Path:
    """Line of the turn centre of a new plan, in map or in the Car's frame."""

    in_car_frame: bool
    points: Tuple[Point, ...]


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
    path: Optional[Path] = None


class MotionPlanner:
    """Leads the robot to one goal at a time.

    A new goal id replaces the goal at once; a plan is made when the goal or the Car changes or when the robot is off
    its reference, not at each tick.

    Attributes:
        site: frame of the present plan, None before the first.
        follower: at work, None when there is nothing to follow.
    """

    def __init__(self, parameters: MotionParameters, executor: Executor):
        """executor: makes the plans."""
        self._parameters = parameters
        self._background = BackgroundPlanning(executor)
        self._ramp = Ramp(parameters.limits)
        self._stall = StallWatch()
        self._goal = NO_GOAL
        self.site: Optional[Site] = None
        self.follower: Optional[Follower] = None
        self._followed_in_car = False
        self._begin(Result.IDLE)

    def step(self, inputs: Inputs) -> Output:
        """Velocity and status at a tick."""
        self._path = None
        order = inputs.order
        if order and order.goal.goal_id != self._goal.goal_id:
            self._goal, self.site = order.goal, None
            self._begin(Result.PENDING if order.goal.goal_id else Result.IDLE)
        fault = fault_of(inputs, self._parameters.input_age_limit_s)
        if fault:
            return self._stop_at_once(fault)
        self._ramp.begin(inputs.tick_s, inputs.robot)
        if self._goal.goal_id == 0:
            self._ramp.brake()
            self.follower = None
            self._background.forget()
            return self._output(Result.IDLE)
        self._take_car(inputs.car)
        return self._pursue(inputs)

    def _begin(self, result: Result) -> None:
        """Start anew with the goal; a follower stays until the new plan goes on from its motion."""
        self._result, self._message = result, ""
        self._must_plan = True
        self._background.forget()
        self._corrections = 0
        self._settled_at: Optional[Pose2] = None
        self._stall.reset()

    def _stop_at_once(self, fault: str) -> Output:
        self._ramp.drop()
        self._stall.reset()
        self._background.forget()
        self.follower, self._must_plan = None, True
        if self._goal.goal_id == 0:
            return self._output(Result.IDLE)
        return self._output(self._result if self._result in SETTLED else Result.PENDING, message=fault)

    def _take_car(self, car: Car) -> None:
        """Plan again when the Car is not what the plan was made for; a robot that has arrived stays."""
        if self.site is None or self.site.holds_for(car):
            return
        self.site = None
        if self._result != Result.REACHED:
            self._begin(Result.PENDING)

    def _pursue(self, inputs: Inputs) -> Output:
        if self.site is None and not self._arrange(inputs.car):
            return self._stay()
        base = self.site.frame_from_map(inputs.car) @ inputs.robot.pose
        pose = base @ self._parameters.footprint.slip.base_from_centre
        if self._result in SETTLED:
            if not was_displaced(self._settled_at, pose):
                return self._stay()
            self._begin(Result.PENDING)
        speed = self._speed(inputs.order, inputs.robot)
        if self._must_plan:
            self._plan(pose, inputs, speed)
        if self._background.is_at_work:
            self._take_plan(pose, inputs.tick_s, speed)
        if self.follower is None:
            return self._stay()
        return self._follow(pose, inputs, speed)

    def _arrange(self, car: Car) -> bool:
        try:
            self.site = Site(self._goal, car, self._parameters)
        except RobotError as refusal:
            self._settle(Result.REFUSED, str(refusal), None)
        return self.site is not None

    def _stay(self) -> Output:
        self._ramp.brake()
        return self._output(self._result, message=self._message)

    def _speed(self, order: Order, robot: RobotState) -> float:
        speed = min(order.max_speed_mps, self._parameters.limits.max_linear_mps)
        return min(speed, self._parameters.degenerate_speed_mps) if robot.is_degenerate else speed

    def _plan(self, pose: Pose2, inputs: Inputs, speed: float) -> None:
        """Adopt a plan that is quickly made, or begin to make another; without a reference the robot stops first."""
        planning = Planning(self.site.keep_out, self.site.fence, self._parameters, speed)
        goal = Goal(self.site.goal, self._goal.direction, is_correction=self._corrections > 0)
        # Another frame has other coordinates: what was followed means nothing in it.
        if self._followed_in_car != self.site.in_car_frame or not (self.follower and self.follower.is_near(pose)):
            self.follower = None
        robot, follower = inputs.robot, self.follower
        present = follower.moving() if follower else Moving(pose, robot.speed_mps, robot.yaw_rate_radps)
        try:
            plan = planning.straight(present, goal)
        except RobotError as refusal:
            self._settle(Result.REFUSED, str(refusal), pose)
            return
        if plan:
            self._adopt(plan, speed)
        elif not moves(present):
            self._background.begin(planning, goal, present, inputs.tick_s)
        elif follower:
            # A robot that is, or gets, faster than it now may be does not go on so.
            fastest = max(abs(present.linear_mps), abs(follower.moving(LEAD_S).linear_mps))
            lead_s = LEAD_S if fastest <= speed + ROUNDING_MPS else 0.0
            self._background.begin(planning, goal, follower.moving(lead_s), inputs.tick_s + lead_s)
        self._must_plan = plan is None and not self._background.is_at_work

    def _take_plan(self, pose: Pose2, tick_s: float, speed: float) -> None:
        """Change over to the plan that is due; a robot whose plan is late stops."""
        if not self._background.is_due(tick_s):
            return
        if not self._background.is_done():
            self.follower = None
        elif not self._background.fits(self.follower):
            self._background.forget()
            self._must_plan = True
        else:
            try:
                self._adopt(self._background.take(), speed)
            except RobotError as refusal:
                self._settle(Result.REFUSED, str(refusal), pose)

    def _adopt(self, plan: Plan, speed: float) -> None:
        self._followed_in_car = self.site.in_car_frame
        self.follower = Follower(plan, self._parameters, speed)
        self._path = Path(self.site.in_car_frame, tuple(plan.points))

    def _follow(self, pose: Pose2, inputs: Inputs, speed: float) -> Output:
        robot, follower = inputs.robot, self.follower
        if not follower.set_speed(speed):
            self._must_plan = True
        wanted = follower.step(pose, robot, self._ramp.step_s)
        if wanted.lost:
            # It is planned from where the robot comes to stand.
            self._background.forget()
            self.follower, self._must_plan = None, True
            self._ramp.brake()
            return self._output(Result.PENDING, wanted.remaining_m)
        if wanted.finished:
            if not self._background.is_at_work:
                self._arrive(pose)
            return self._stay()
        if is_heading_into(self.site.keep_out, pose, robot, wanted.velocity, self._parameters):
            self._ramp.brake()
            return self._output(Result.BLOCKED, wanted.remaining_m, "The robot stands before it touches the Car.")
        self._ramp.drive(wanted.velocity)
        return self._under_way(pose, inputs, wanted)

    def _under_way(self, pose: Pose2, inputs: Inputs, wanted: Wanted) -> Output:
        message = sentence_about_drive(inputs.drive) if inputs.drive else ""
        if message and inputs.drive.zone in STANDING:
            self._stall.reset()
            return self._output(Result.BLOCKED, wanted.remaining_m, message)
        if self._stall.stalls(pose, wanted.remaining_m > 0.0, inputs.tick_s):
            return self._output(Result.BLOCKED, wanted.remaining_m, "The robot is told to drive and does not move.")
        return self._output(Result.PENDING, wanted.remaining_m, message)

    def _arrive(self, pose: Pose2) -> None:
        """The plan is done: within tolerance, or one more attempt, or near enough."""
        miss = miss_of(self.site.goal, pose, self._parameters.arrival)
        if miss.is_within:
            self._settle(Result.REACHED, "", pose)
        elif self._corrections < self._parameters.arrival.corrections:
            self._corrections += 1
            # From where the robot is: its reference has arrived.
            self.follower, self._must_plan = None, True
        else:
            result = Result.REACHED if miss.is_near else Result.REFUSED
            self._settle(result, sentence_about(miss, self._corrections), pose)

    def _settle(self, result: Result, message: str, pose: Optional[Pose2]) -> None:
        self._result, self._message, self._settled_at = result, message, pose
        self.follower = None

    def _output(self, result: Result, remaining_m: float = 0.0, message: str = "") -> Output:
        active = self._goal.goal_id != 0 or not self._ramp.is_still
        return Output(self._ramp.linear_mps, self._ramp.angular_radps, active, self._goal.goal_id, result, remaining_m,
                      message, self._path)
