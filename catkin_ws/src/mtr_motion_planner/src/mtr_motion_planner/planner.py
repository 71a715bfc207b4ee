"""The motion planner: computes velocity and status from the inputs at each tick."""
# SPDX-License-Identifier: Apache-2.0
import logging
from concurrent.futures import Executor
from typing import Optional

from mtr_core.errors import RobotError
from mtr_core.problems import NO_PROBLEM, Problem, problem_in
from mtr_core.requests import NO_GOAL
from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_description.mounts import Footprint

from . import problems
from .following.follower import Follower, FollowerOutput
from .following.ground_behind import GroundBehind
from .following.pose_speed import PoseSpeed
from .following.ramp import Ramp
from .following.tolerance import miss_of, problem_of_miss, was_displaced
from .following.tracking import Velocity
from .following.watch import StallWatch, is_heading_into, problem_of_drive
from .geometry.growth import own_sigma_of
from .geometry.robot_outline import RobotOutline
from .inputs import Inputs, InputsUnusable, Situation, Zone, situation_of
from .outputs import PlannerOutput
from .parameters import MotionParameters
from .replanning import Replanning
from .search.options import Target
from .site import Site
from .timing.plan import Moving

SETTLED = (Result.REACHED, Result.REFUSED)
STANDING = (Zone.BLOCKED, Zone.BLIND)


class MotionPlanner:
    """Drives the robot to one goal at a time.

    A new goal id replaces the goal at once. A plan is made when the goal or the Car changes, or when the robot is off
    its reference, not at each tick.

    Attributes:
        site: frame of the present plan, None before the first.
    """

    def __init__(self, parameters: MotionParameters, footprint: Footprint, executor: Executor):
        """executor: makes the plans."""
        self._parameters, self._outline = parameters, RobotOutline(footprint, parameters.slip)
        self._replanning = Replanning(parameters, executor)
        self._ramp = Ramp(parameters.limits)
        self._stall = StallWatch()
        self._pose_speed = PoseSpeed(parameters.limits, parameters.pose_margin_m, parameters.creep_mps)
        self._behind = None if parameters.rear_lidar else GroundBehind()
        # Tried once per goal; if it does not help, drive control reports the problem.
        self._may_uncover = True
        self._goal = NO_GOAL
        self._result, self._message = Result.IDLE, NO_PROBLEM
        self._corrections = 0
        self._settled_at: Optional[Pose2] = None
        self._replans = 0
        self.site: Optional[Site] = None

    @property
    def follower(self) -> Optional[Follower]:
        """The follower of the present plan, or None without a plan."""
        return self._replanning.follower

    def step(self, inputs: Inputs) -> PlannerOutput:
        """Return velocity and status at a tick."""
        desired = inputs.desired
        if desired and desired.goal.id != self._goal.id:
            self._goal, self.site, self._may_uncover = desired.goal, None, True
            self._begin(Result.PENDING if desired.goal.waypoint.id else Result.IDLE)
        try:
            now = situation_of(inputs, self._parameters.input_age_limit_s)
        except InputsUnusable as fault:
            return self._stop_at_once(fault.problem)
        self._ramp.begin(now.tick_s, now.robot)
        if self._behind:
            self._behind.observe(now.robot.pose, now.tick_s)
        if not self._goal.waypoint.id:
            self._ramp.brake()
            self._replanning.stop()
            return self._output(Result.IDLE)
        self._take_car(now)
        return self._pursue(now)

    def _begin(self, result: Result) -> None:
        """Restart with the goal; the follower remains until the new plan continues its motion."""
        self._result, self._message = result, NO_PROBLEM
        self._replanning.restart()
        self._corrections = 0
        self._settled_at = None
        self._stall.reset()

    def _begin_again(self) -> None:
        """Replan to an active goal: the robot leaves its ordered path."""
        self._replans += 1
        self._begin(Result.PENDING)

    def _stop_at_once(self, fault: Problem) -> PlannerOutput:
        self._ramp.drop()
        self._stall.reset()
        self._replanning.stop()
        if not self._goal.waypoint.id:
            return self._output(Result.IDLE)
        return self._output(self._result if self._result in SETTLED else Result.PENDING, message=fault)

    def _take_car(self, now: Situation) -> None:
        """Replan when the Car differs from the one in the plan; a robot that has arrived stays."""
        if self.site is None:
            return
        is_retried = self._result == Result.REFUSED and self.site.is_wider_for(now.car, now.robot)
        is_same = self.site.holds_for(now.car, now.robot) and self.site.area == now.area
        if is_same and not is_retried:
            return
        self.site = None
        if self._result != Result.REACHED:
            self._begin_again()

    def _pursue(self, now: Situation) -> PlannerOutput:
        site = self.site or self._arranged(now)
        if site is None:
            return self._stay()
        base = site.frame_from_map(now.car) @ now.robot.pose
        pose = base @ self._parameters.slip.base_from_centre
        if self._result in SETTLED:
            if not was_displaced(self._settled_at, pose):
                return self._stay()
            self._begin_again()
        speed = self._speed(now)
        self._keep_planned(site, pose, now, speed)
        follower = self._replanning.follower
        return self._stay() if follower is None else self._follow(site, follower, pose, now, speed)

    def _arranged(self, now: Situation) -> Optional[Site]:
        try:
            self.site = Site(self._goal.waypoint, now.car, now.robot, self._outline, self._parameters,
                             area=now.area)
        except RobotError as refusal:
            self._settle(Result.REFUSED, problem_in(refusal), None)
        return self.site

    def _stay(self) -> PlannerOutput:
        self._ramp.brake()
        return self._output(self._result, message=self._message)

    def _speed(self, now: Situation) -> float:
        speed = min(now.desired.max_speed_mps, self._parameters.limits.max_linear_mps,
                    self._pose_speed.limit(own_sigma_of(now.robot, self._outline.front_m)))
        return min(speed, self._parameters.degenerate_speed_mps) if now.robot.is_degenerate else speed

    def _keep_planned(self, site: Site, pose: Pose2, now: Situation, speed: float) -> None:
        """Request a plan if one is needed, and switch to the plan that is due."""
        target = Target(site.goal, self._direction(), is_correction=self._corrections > 0)
        robot = Moving(pose, now.robot.speed_mps, now.robot.yaw_rate_radps)
        try:
            if self._replanning.is_needed:
                self._replanning.plan(site, target, robot, now.tick_s, speed,
                                      uncovers=self._has_to_uncover(now.tick_s))
            self._replanning.change_over(site, now.tick_s, speed)
        except RobotError as refusal:
            self._settle(Result.REFUSED, problem_in(refusal), pose)
        # Any defect, perhaps in another process: the robot has no plan, and without this handler the node would end.
        except Exception as defect:
            logging.exception("No plan was made for a defect of the planner.")
            self._settle(Result.REFUSED, problems.PLANNING_DEFECT(what=type(defect).__name__), pose)

    def _has_to_uncover(self, now_s: float) -> bool:
        return self._behind is not None and self._may_uncover and not self._behind.is_seen(now_s)

    def _direction(self) -> Direction:
        number = self._goal.waypoint.direction
        return Direction(number) if number in tuple(Direction) else Direction.ANY

    def _follow(self, site: Site, follower: Follower, pose: Pose2, now: Situation, speed: float) -> PlannerOutput:
        if self._stall.rests(now.tick_s):
            self._ramp.brake()
            return self._output(Result.BLOCKED, follower.remaining_m, problems.STALLED())
        if not follower.set_speed(speed):
            self._replanning.is_needed = True
        wanted = follower.step(pose, now.robot, self._ramp.step_s)
        if wanted.lost:
            self._replans += 1
            self._replanning.stop()
            self._ramp.brake()
            return self._output(Result.PENDING, wanted.remaining_m)
        if wanted.finished:
            if self._replanning.is_uncovering:
                self._may_uncover = False
                self._replanning.stop()
            elif not self._replanning.is_under_way:
                self._arrive(site, pose)
            return self._stay()
        if is_heading_into(site.keep_out, pose, now.robot, wanted.velocity, self._parameters):
            self._ramp.brake()
            return self._output(Result.BLOCKED, wanted.remaining_m, problems.BEFORE_CAR())
        # Any turn would sweep unseen ground.
        self._ramp.drive(Velocity(wanted.velocity.linear_mps) if self._replanning.is_uncovering else wanted.velocity)
        return self._under_way(pose, now, wanted)

    def _under_way(self, pose: Pose2, now: Situation, wanted: FollowerOutput) -> PlannerOutput:
        message = problem_of_drive(now.collision_stop) if now.collision_stop else NO_PROBLEM
        if now.collision_stop and message and now.collision_stop.zone in STANDING:
            self._stall.reset()
            return self._output(Result.BLOCKED, wanted.remaining_m, message)
        if self._stall.stalls(pose, wanted.remaining_m > 0.0, now.tick_s):
            return self._output(Result.BLOCKED, wanted.remaining_m, problems.STALLED())
        return self._output(Result.PENDING, wanted.remaining_m, message)

    def _arrive(self, site: Site, pose: Pose2) -> None:
        """Finish a completed plan: within tolerance, with a further attempt, or near enough."""
        miss = miss_of(site.goal, pose, self._parameters.arrival)
        if miss.is_within:
            self._settle(Result.REACHED, NO_PROBLEM, pose)
        elif self._corrections < self._parameters.arrival.corrections:
            self._corrections += 1
            # The next attempt starts at the robot's pose, because its reference has arrived.
            self._replanning.stop()
        else:
            result = Result.REACHED if miss.is_near else Result.REFUSED
            self._settle(result, problem_of_miss(miss, self._corrections), pose)

    def _settle(self, result: Result, message: Problem, pose: Optional[Pose2]) -> None:
        self._result, self._message, self._settled_at = result, message, pose
        self._replanning.follower = None

    def _output(self, result: Result, remaining_m: float = 0.0, message: Problem = NO_PROBLEM) -> PlannerOutput:
        active = self._goal.waypoint.id != 0 or not self._ramp.is_still
        return PlannerOutput(self._ramp.linear_mps, self._ramp.angular_radps, active, self._goal.id, result,
                             remaining_m, message, self._replanning.take_path(), self._replans)
