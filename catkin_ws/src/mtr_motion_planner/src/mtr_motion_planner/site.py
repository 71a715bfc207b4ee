"""The frame of a goal's plan, and the areas that the robot must avoid in it.

A goal relative to the Car is planned in the Car's frame. A small change of the Car's estimated pose then leaves
outline, goal and plan unchanged, and only the robot's pose in the frame changes.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Optional

from shapely.geometry import Polygon

from mtr_core import names
from mtr_core.requests import Waypoint
from mtr_core.se2 import Pose2

from . import problems
from .geometry.fence import Fence, bound_of, corners_of
from .geometry.growth import bounds_of
from .geometry.keep_out import KeepOut
from .geometry.robot_outline import RobotOutline
from .inputs import NO_AREA, DrawnArea, EstimatedCar, RobotState
from .parameters import Margins, MotionParameters
from .timing.plan import PlanRefused

SHIFT_M, SHIFT_RAD = 0.02, math.radians(0.5)
# Beyond drive control's area_gap_m (0.05 m), for errors of following and for a sigma that grows during the drive.
AREA_GAP_M = 0.15
MAP_FROM_MAP = Pose2(0.0, 0.0, 0.0)


class Site:
    """Frame, outline and test area for one goal.

    Attributes:
        in_car_frame: True for the Car's frame, False for map.
        goal: pose of the robot's turn centre in the frame.
        keep_out: the Car's outline in the frame.
        area: the Operator's test area, in map.
        fence: the test area in the frame, or None without a bound.
    """

    def __init__(self, goal: Waypoint, car: EstimatedCar, state: RobotState, robot: RobotOutline,
                 parameters: MotionParameters, *, area: DrawnArea = NO_AREA):
        """Raises OutlineUnusable or PlanRefused if planning is impossible here."""
        self.area = area
        self._car, self._reach_m, self._margins = car, robot.front_m, parameters.margins
        if goal.frame not in (names.CAR, names.MAP):
            raise PlanRefused(problems.GOAL_FRAME(frame=repr(goal.frame)))
        if not goal.pose.is_finite():
            raise PlanRefused(problems.GOAL_NOT_A_NUMBER())
        self.in_car_frame = goal.frame == names.CAR
        if self.in_car_frame and not car.located:
            raise PlanRefused(problems.CAR_NOT_LOCATED())
        self.goal = goal.pose @ parameters.slip.base_from_centre
        frame_from_car = MAP_FROM_MAP if self.in_car_frame else car.pose
        self.keep_out = KeepOut([frame_from_car.apply(x, y) for x, y in car.outline], robot, parameters.margins,
                                frame_from_car, bounds_of(car, state, self._reach_m, self._margins))
        self.fence = self._fence(parameters, frame_from_car, state)

    def _fence(self, parameters: MotionParameters, frame_from_car: Pose2, state: RobotState) -> Optional[Fence]:
        bounds = [*self._parameter_bound(parameters.margins, frame_from_car), *self._drawn_bound(state)]
        return Fence(bounds, self.keep_out.robot, parameters.limits) if bounds else None

    def _parameter_bound(self, margins: Margins, frame_from_car: Pose2) -> List[Polygon]:
        corners = corners_of(margins.geofence_xy)
        in_car = margins.geofence_frame == "car"
        # While the Car is mapped, the pose of its frame is unknown.
        if not corners or (in_car and not self._car.located):
            return []
        frame = frame_from_car if in_car else self.frame_from_map(self._car)
        return [bound_of([frame.apply(x, y) for x, y in corners])]

    def _drawn_bound(self, state: RobotState) -> List[Polygon]:
        """Return an area within drive control's bound, so that drive control does not stop the robot on its path."""
        if not self.area.corners:
            return []
        frame = self.frame_from_map(self._car)
        sigma_m = state.position_sigma_m + state.heading_sigma * self._reach_m
        return [bound_of([frame.apply(x, y) for x, y in self.area.corners], AREA_GAP_M + 2.0 * sigma_m)]

    def frame_from_map(self, car: EstimatedCar) -> Pose2:
        """Return the pose of map in the frame, by the Car's newest pose."""
        return car.pose.inverse() if self.in_car_frame else MAP_FROM_MAP

    def holds_for(self, car: EstimatedCar, state: RobotState) -> bool:
        """Return True if a plan made here is still valid for the Car and the uncertainty of the robot's position."""
        old = self._car
        if old.located != car.located or len(old.outline) != len(car.outline):
            return False
        moved = old.pose.inverse() @ car.pose
        if not self.in_car_frame and (math.hypot(moved.x, moved.y) > SHIFT_M or abs(moved.heading) > SHIFT_RAD):
            return False
        bounds = bounds_of(car, state, self._reach_m, self._margins)
        if bounds.growth.is_more_than(self.keep_out.bounds.growth, SHIFT_M):
            return False
        return all(math.hypot(a[0] - b[0], a[1] - b[1]) <= SHIFT_M for a, b in zip(old.outline, car.outline))

    def is_wider_for(self, car: EstimatedCar, state: RobotState) -> bool:
        """Return True if the pose of Car or robot is more certain now, so that a refused goal may be free."""
        growth = bounds_of(car, state, self._reach_m, self._margins).growth
        return self.keep_out.bounds.growth.is_more_than(growth, SHIFT_M)
