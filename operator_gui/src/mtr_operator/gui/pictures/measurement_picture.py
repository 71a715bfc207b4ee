"""The picture of the measurement screen, from the view model."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any, Sequence

from PyQt5.QtCore import QObject

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.geometry.pose import Point, Pose
from mtr_operator.domain.results.picture import Picture, Stretch
from mtr_operator.domain.robot_status import AreaState, CarDimensions
from mtr_operator.station.estimate import USUAL_CAR, plan_of
from mtr_operator.station.sight.view import View
from mtr_operator.station.test import Test
from mtr_operator.station.view_model import ViewModel

from ..threads.task import Task
from .glide import Glide
from .layers.area_layer import AreaLayer
from .layers.car_layer import CarLayer
from .layers.lines_layer import LinesLayer
from .layers.points_layer import AreasLayer, PointsLayer
from .layers.robot_layer import RobotLayer, TrailLayer, WaypointLayer
from .layers.sight_layer import SightLayer
from .layers.surroundings import GridLayer, ScaleLayer
from .picture_panel import PicturePanel

# The still part of the picture is painted anew for a border that has moved farther.
_BORDER_STEP_M = 0.02


class MeasurementPicture(QObject):
    """Paints what stands still only when it has changed, and the robot thirty times a second."""

    def __init__(self, model: ViewModel, panel: PicturePanel):
        # As long as the panel: a thread that ends later tells nobody.
        super().__init__(panel)
        self._model = model
        self._panel = panel
        self._glide = Glide()
        self._shown: tuple[Any, ...] = ()
        # The work on the newest picture, and whether another one is wanted already.
        self._task: Task | None = None
        self._pictured: Test | None = None
        self._is_outdated = False
        self.robot = RobotLayer()
        self.waypoint = WaypointLayer()
        self.trail = TrailLayer()
        self.areas = AreasLayer()
        self.points = PointsLayer()
        self.lines = LinesLayer()
        self.sight = SightLayer()
        self.border = AreaLayer()

    def show_model(self, now_s: float) -> None:
        """Something is another one."""
        model = self._model
        shown = (id(model.test), model.mapped_car, len(model.results), id(model.results))
        if shown != self._shown:
            self._shown = shown
            self._arrange()
        self._show_robot(now_s)
        self._panel.view.move_layer(self.robot)

    def glide(self, now_s: float) -> None:
        """The next frame is due."""
        if self._glide.is_moving(now_s):
            self.robot.pose = self._glide.at(now_s)
            self._panel.view.move_layer(self.robot)

    def _show_robot(self, now_s: float) -> None:
        snapshot = self._model.robot
        if snapshot is None:
            return
        status = snapshot.status
        self._glide.put(Pose(status.x, status.y, status.heading) if status.pose_valid else None, now_s)
        robot = self.robot
        robot.pose, robot.key, robot.sigma_m = self._glide.at(now_s), (status.key_x, status.key_y), \
            status.position_sigma_m
        robot.is_stale = self._model.is_stale
        self._show_sight(None if robot.is_stale or not status.pose_valid else self._model.view)
        self._show_border(status.area)
        self._show_waypoint(None if snapshot.waypoint is None else snapshot.waypoint.pose)
        if self._model.trail is not self.trail.places:
            self.trail.places = self._model.trail
            self._panel.view.refresh()
        if self.trail.has_news:
            self._panel.view.add_news(self.trail)

    def _show_border(self, state: AreaState | None) -> None:
        corners = () if state is None else state.corners_at_car()
        if not _is_near(corners, self.border.corners):
            self.border.corners = corners
            self._panel.view.refresh()

    def _show_sight(self, view: View | None) -> None:
        if view is not self.sight.view:
            self.sight.view = view
            self._panel.view.refresh_brief()

    def _show_waypoint(self, pose: Pose | None) -> None:
        if pose != self.waypoint.pose:
            self.waypoint.pose = pose
            self._panel.view.refresh_brief()

    def _arrange(self) -> None:
        model, test = self._model, self._model.current_test
        mapped = model.mapped_car
        car = mapped or USUAL_CAR
        if test is not self._pictured:
            self._pictured = test
            self.points.sets = self.areas.sets = ()
        self._compute_picture(car)
        self.areas.is_complete = model.done == model.total
        self.lines.is_visible = test.scenario.lines_stay
        self.lines.stretches = self._stretches(car)
        self._panel.view.show_layers([GridLayer(), self.border, self.lines, self.areas,
                                      CarLayer(car, mapped is not None), self.points, self.trail, self.sight,
                                      self.waypoint, self.robot, ScaleLayer()])

    def _compute_picture(self, car: CarDimensions) -> None:
        """In a thread, one after the other: that of many zones takes seconds, and Stop has to be heard meanwhile."""
        self._is_outdated = self._task is not None
        if self._is_outdated:
            return
        test, results = self._model.current_test, self._model.results
        self._task = Task(lambda _: (test, test.scenario.picture(test.parameters, car, results)))
        self._task.done.connect(self._show_picture)
        self._task.refused.connect(lambda *_: self._end_task())
        self._task.start()

    def _show_picture(self, _: Task, found: tuple[Test, Picture]) -> None:
        test, picture = found
        if test is self._pictured:
            self.points.sets = self.areas.sets = picture.point_sets
            self._panel.legend.show_sets(picture.point_sets)
            self._panel.view.refresh()
        self._end_task()

    def _end_task(self) -> None:
        self._task = None
        if self._is_outdated and self._model.test is not None:
            self._compute_picture(self._model.mapped_car or USUAL_CAR)

    def _stretches(self, car: CarDimensions) -> tuple[Stretch, ...]:
        test = self._model.current_test
        try:
            return plan_of(test.scenario, test.parameters, car, True).stretches
        except InvalidParameter:  # the runner says it
            return ()


def _is_near(one: Sequence[Point], other: Sequence[Point]) -> bool:
    """True when nobody would see the difference: the Car's pose in the start frame changes with each Status."""
    return len(one) == len(other) and all(math.dist(a, b) < _BORDER_STEP_M for a, b in zip(one, other))
