"""Car locator: at each tick, tasks, poses, scans and maps become an estimate of the Car."""
# SPDX-License-Identifier: Apache-2.0
import math
from concurrent.futures import Executor
from dataclasses import replace
from typing import Optional, Tuple

from mtr_core.executors import InlineExecutor
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.se2 import Pose2
from mtr_core.states import CarState

from . import problems
from .estimate import Estimate, Inputs, LocatorTask, result_at
from .find.errors import NotLocated
from .find.prior import prior_at, prior_from_start
from .located import LocatedCar
from .measure.car_fit import SideSigmas
from .measure.outline import rounded
from .memory.remembered import RememberedCar
from .parameters import LocatorParameters
from .poses import PoseHistory, RobotPose
from .rectangle import Point, Rectangle
from .survey.survey import Survey

# 1 sigma of the Car's pose from the starting place alone.
PRIOR_POSITION_SIGMA_M, PRIOR_HEADING_SIGMA_RAD = 0.5, 0.2
NOWHERE = Rectangle(Pose2(0.0, 0.0, 0.0), 0.0, 0.0)


class CarLocator:
    """Maps the Car on request, and then keeps its frame unless there is evidence against it."""

    def __init__(self, parameters: LocatorParameters, remembered: Optional[RememberedCar] = None,
                 fits: Optional[Executor] = None):
        """Create a locator. remembered: Car of a previous process to resume with; fits: executor of the fits."""
        self._parameters, self._fits = parameters, fits or InlineExecutor()
        self._poses: Optional[PoseHistory] = None
        self._survey: Optional[Survey] = None
        self._located: Optional[LocatedCar] = None
        self._state = CarState.UNKNOWN
        self._was_mapping = False
        # A survey that was ordered while the position is lost waits for a pose in its own map.
        self._awaits_pose = False
        self._map_car_id = 0
        self._next_waypoint_id = 1
        self._revision = 0
        self._message = NO_PROBLEM
        self._goes_on = remembered is not None
        if remembered:
            self._go_on(remembered)

    def _go_on(self, car: RememberedCar) -> None:
        self._located = LocatedCar(car.fit, car.map_revision, car.revision, self._parameters.refinement)
        self._state, self._map_car_id, self._revision = CarState.LOCATED, car.map_car_id, car.revision
        self._message = self._located.message

    def wants_scans(self, inputs: Inputs) -> bool:
        """Return True while scans are collected or will be soon."""
        task = inputs.task
        if task is not None and task.mapping:
            return self._state == CarState.COLLECTING or self._is_new(task)
        return (self._located is not None and self._poses is not None
                and self._located.wants_scans(inputs, self._poses))

    def add_pose(self, robot: RobotPose) -> None:
        """Add a valid pose of the robot."""
        if not robot.pose.is_finite():
            return
        if self._poses is None:
            self._poses = PoseHistory(robot)
        else:
            self._poses.add(robot)

    def step(self, inputs: Inputs) -> Estimate:
        """Return the estimate at a tick."""
        if self._goes_on:
            # The time is an id that no waypoint of a previous process has had.
            self._next_waypoint_id, self._goes_on = max(1, round(inputs.now_s)), False
        if self._poses is not None:
            try:
                self._work(inputs, self._poses)
            except NotLocated as reason:
                self._fail(reason.problem)
        self._was_mapping = inputs.task is not None and inputs.task.mapping
        return self._estimate()

    def _work(self, inputs: Inputs, poses: PoseHistory) -> None:
        task = inputs.task
        survey = self._survey_for(task, inputs.now_s, poses) if task and task.mapping else None
        if survey and not self._awaits_pose:
            self._collect(survey, inputs, poses)
        elif self._survey and self._state == CarState.COLLECTING:
            # The robot stopped because its position was lost together with the map.
            self._survey.judge(inputs.surfaces)
        elif self._located:
            self._located.step(inputs, poses, self._next_waypoint_id)
            if self._located.waypoint:
                self._next_waypoint_id = self._located.waypoint.id + 1
            self._revision, self._message = self._located.revision, self._located.message

    def _survey_for(self, task: LocatorTask, now_s: float, poses: PoseHistory) -> Optional[Survey]:
        """Return the survey of the task, a new one if necessary; None if it has ended."""
        if self._is_new(task):
            self._awaits_pose = not poses.is_fresh(now_s)
            # The start time is an id that no survey has had, not even before a restart of this node.
            self._survey = self._survey_at(poses.newest.pose, round(now_s * 1000.0))
            self._located = None
            self._state, self._map_car_id = CarState.COLLECTING, task.map_car_id
        elif self._survey and self._awaits_pose and poses.is_fresh(now_s):
            self._awaits_pose = False
            self._survey = self._survey_at(poses.newest.pose, self._survey.map_id)
        return self._survey if self._state == CarState.COLLECTING else None

    def _survey_at(self, robot: Pose2, map_id: int) -> Survey:
        # If the robot's position is lost, the Car's is lost, too.
        if self._located and not self._awaits_pose:
            prior = prior_at(self._located.fit.rectangle)
        else:
            prior = prior_from_start(robot, self._parameters)
        return Survey(prior, map_id, self._next_waypoint_id, self._parameters, self._fits)

    def _is_new(self, task: LocatorTask) -> bool:
        if self._state == CarState.UNKNOWN or task.map_car_id != self._map_car_id:
            return True
        return self._state == CarState.FAILED and not self._was_mapping

    def _collect(self, survey: Survey, inputs: Inputs, poses: PoseHistory) -> None:
        robot = poses.newest
        survey.collect(inputs.scans, poses)
        survey.advance(inputs.now_s, robot, result_at(survey.waypoint, inputs.task, inputs.motion))
        self._next_waypoint_id = survey.next_waypoint_id
        self._message = survey.progress
        survey.conclude(inputs.now_s, robot, inputs.surfaces)
        if survey.fit:
            self._revision += 1
            self._located = LocatedCar(survey.fit, robot.map_revision, self._revision, self._parameters.refinement)
            self._state, self._message = CarState.LOCATED, self._located.message

    def _fail(self, reason: Problem) -> None:
        sentence = problems.NOT_FOUND if self._state == CarState.COLLECTING else problems.LOST
        self._located, self._state = None, CarState.FAILED
        self._message = sentence(cause=reason)

    def _estimate(self) -> Estimate:
        if self._located:
            return self._found(self._located)
        if self._survey:
            margin_m = self._parameters.seen_margin_m if self._survey.was_seen else self._parameters.prior_margin_m
            return self._rough(self._survey.car, rounded(self._survey.car, margin_m), self._message)
        if self._poses is None:
            return self._rough(NOWHERE, (), problems.POSE_UNKNOWN())
        car = prior_from_start(self._poses.newest.pose, self._parameters).car
        return self._rough(car, rounded(car, self._parameters.prior_margin_m), self._message)

    def _rough(self, car: Rectangle, outline: Tuple[Point, ...], message: Problem) -> Estimate:
        sigma, size_sigma = PRIOR_POSITION_SIGMA_M, 0.5 * self._parameters.sheet.size_tolerance_m
        # Errors of position and half the size.
        side_sigmas = SideSigmas(*4 * (math.hypot(sigma, 0.5 * size_sigma),))
        estimate = Estimate(self._state, car, outline, (sigma, sigma, PRIOR_HEADING_SIGMA_RAD), size_sigma, size_sigma,
                            None, self._map_car_id, message, self._revision, side_sigmas=side_sigmas)
        survey = self._survey if self._state == CarState.COLLECTING else None
        if survey is None:
            return estimate
        return replace(estimate, waypoint=survey.waypoint, phase=survey.phase, map_id=survey.map_id,
                       places=survey.places_ahead)

    def _found(self, located: LocatedCar) -> Estimate:
        fit = located.fit
        return Estimate(self._state, fit.rectangle, fit.outline, fit.sigmas, fit.length_sigma, fit.width_sigma,
                        located.waypoint, self._map_car_id, self._message, located.revision, located.correction,
                        check=located.report, places=located.places_ahead, fit=fit,
                        map_revision=located.map_revision, side_sigmas=fit.side_sigmas)
