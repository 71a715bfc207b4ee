"""The window of the test area: what the robot enforces, and another one to be drawn."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from PyQt5.QtCore import QSize, QTimer
from PyQt5.QtGui import QHideEvent, QShowEvent
from PyQt5.QtWidgets import QDialog, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.geometry.area import area_m2, rectangle_around
from mtr_operator.domain.geometry.pose import Point, Pose
from mtr_operator.domain.robot_status import AreaState
from mtr_operator.station.readiness import RUNNING
from mtr_operator.station.sight.area_sketch import AreaSketch

from ..fitting.place import open_within
from ..fitting.prose import Prose
from ..flow import Flow
from ..pictures.layers.area_layer import AreaLayer, CarOutlineLayer, EchoLayer
from ..pictures.layers.robot_layer import RobotLayer
from ..pictures.layers.surroundings import GridLayer, ScaleLayer
from ..sentences import translated
from ..theme.appearance import Appearance
from ..theme.scale import M
from .area_view import AreaView

_SIZE = QSize(860, 860)
_PERIOD_MS = 200
# Room for a way around a car of 5 m that the robot faces.
RECTANGLE_M = (16.0, 14.0)


class AreaWindow(QDialog):
    """Attributes: view: the picture. enforced, notice: what the robot reports, and what becomes of the sketch.
    rectangle, undo, clear, take, send, withdraw: the buttons."""

    def __init__(self, flow: Flow, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Test area"))
        self._flow = flow
        self._sent: tuple[tuple[Point, ...], int] | None = None
        self.view = AreaView(AreaSketch(), appearance)
        self._area, self._car = AreaLayer(), CarOutlineLayer()
        self._echoes, self._robot = EchoLayer(), RobotLayer()
        self.enforced, self.notice = Prose(), Prose()
        self.rectangle = QPushButton(self.tr("Rectangle around the robot"))
        self.take = QPushButton(self.tr("Edit the robot's area"))
        self.undo, self.clear = QPushButton(self.tr("Undo")), QPushButton(self.tr("Clear"))
        self.send = QPushButton(self.tr("Set area"))
        self.send.setProperty("role", "primary")
        self.withdraw = QPushButton(self.tr("Remove the robot's area"))
        self._timer = QTimer(self)
        self._timer.setInterval(_PERIOD_MS)
        self._lay_out()
        self._connect()
        self.view.show_layers((GridLayer(), self._area, self._car, self._echoes, self._robot, ScaleLayer()))
        self.refresh()
        self.ensurePolished()
        open_within(self, _SIZE)

    @property
    def state(self) -> AreaState | None:
        """What the robot reports now; None of a silent robot and of one of before."""
        model = self._flow.model
        return None if model.robot is None or model.is_stale else model.robot.status.area

    def showEvent(self, event: QShowEvent) -> None:
        """See QWidget."""
        super().showEvent(event)
        self.refresh()
        self._timer.start()

    def hideEvent(self, event: QHideEvent) -> None:
        """See QWidget."""
        self._timer.stop()
        super().hideEvent(event)

    def refresh(self) -> None:
        """Show what is so now."""
        self._show_places(self.state)
        self._show_words()

    def _lay_out(self) -> None:
        close = QPushButton(self.tr("Close"))
        close.clicked.connect(self.accept)
        for button in (self.rectangle, self.take, self.undo, self.clear, self.send, self.withdraw, close):
            # Return belongs to the picture.
            button.setAutoDefault(False)
        drawing, sending = QHBoxLayout(), QHBoxLayout()
        for widget in (self.rectangle, self.take, self.undo, self.clear):
            drawing.addWidget(widget)
        drawing.addStretch(1)
        for widget in (self.send, self.withdraw):
            sending.addWidget(widget)
        sending.addStretch(1)
        sending.addWidget(close)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(M)
        layout.addWidget(self.enforced)
        layout.addWidget(self.view, 1)
        layout.addLayout(drawing)
        layout.addWidget(self.notice)
        layout.addLayout(sending)

    def _connect(self) -> None:
        sketch = self.view.sketch
        self._timer.timeout.connect(self.refresh)
        self.view.sketched.connect(self._show_words)
        self.rectangle.clicked.connect(self._draw_rectangle)
        self.take.clicked.connect(self._take)
        self.undo.clicked.connect(lambda: self._change(sketch.undo))
        self.clear.clicked.connect(lambda: self._change(lambda: sketch.replace(())))
        self.send.clicked.connect(lambda: self._order(sketch.corners))
        self.withdraw.clicked.connect(lambda: self._order(()))

    def _change(self, change: Callable[[], None]) -> None:
        change()
        self.view.show_sketch()
        self.view.setFocus()

    def _draw_rectangle(self) -> None:
        state = self.state
        if state is not None and state.robot is not None:
            corners = rectangle_around(state.robot, *RECTANGLE_M)
            self._change(lambda: self.view.sketch.replace(corners))
            self.view.fit()

    def _take(self) -> None:
        state = self.state
        if state is not None:
            self._change(lambda: self.view.sketch.replace(state.corners))

    def _order(self, corners: tuple[Point, ...]) -> None:
        state = self.state
        if state is not None and state.origin_id and not state.is_fixed:
            self._sent = (corners, state.origin_id)
            self._flow.set_area(corners, state.origin_id)
            self.refresh()

    def _show_places(self, state: AreaState | None) -> None:
        model = self._flow.model
        corners = state.corners if state is not None and state.is_in_force else ()
        car = self._car_outline(state)
        if (corners, car) != (self._area.corners, self._car.corners):
            self._area.corners, self._car.corners = corners, car
            self.view.refresh()
        self._robot.pose = None if state is None else state.robot
        self._robot.is_stale = state is None
        if model.robot is not None:
            self._robot.key = (model.robot.status.key_x, model.robot.status.key_y)
        self._echoes.places = _echoes(model.echoes, state)
        self.view.refresh_brief()

    def _car_outline(self, state: AreaState | None) -> tuple[Point, ...]:
        robot = self._flow.model.robot
        if state is None or state.car is None or robot is None or robot.status.car is None:
            return ()
        size = robot.status.car
        return tuple(map(state.car.apply, size.outline)) or rectangle_around(state.car, size.length, size.width)

    def _show_words(self) -> None:
        state, sketch = self.state, self.view.sketch
        is_measuring = self._flow.model.phase in RUNNING
        can_order = state is not None and bool(state.origin_id) and not state.is_fixed and not is_measuring
        self.enforced.setText(self._enforced_text(state))
        self.notice.setText(self._notice_text(state))
        self.rectangle.setEnabled(state is not None and state.robot is not None)
        self.take.setEnabled(state is not None and state.is_in_force)
        self.undo.setEnabled(sketch.can_undo)
        self.clear.setEnabled(bool(sketch.corners))
        self.send.setEnabled(can_order and not sketch.problem)
        self.withdraw.setEnabled(can_order and state is not None and bool(state.corners))

    def _enforced_text(self, state: AreaState | None) -> str:
        if state is None:
            return self.tr("The robot is silent, or its software is too old to keep a test area.")
        if state.problems:
            return translated(state.problems[0].text)
        if not state.corners:
            return self.tr("The robot has no test area; a simulated robot needs none.")
        text = (self.tr("The robot's launch file sets this test area of {size} m2.") if state.is_fixed
                else self.tr("The robot keeps inside this test area of {size} m2."))
        return text.format(size=f"{area_m2(state.corners):.0f}")

    def _notice_text(self, state: AreaState | None) -> str:
        sketch = self.view.sketch
        if state is not None and self._sent is not None:
            corners, origin_id = self._sent
            if state.corners == corners and (not corners or state.area_origin_id == origin_id):
                self._sent = None
            else:
                return self.tr("Waits until the robot confirms the area.")
        if not sketch.corners:
            return self.tr("Click the corners one after the other, or begin with a rectangle. Drag a corner to move "
                           "it, right-click it to remove it.")
        return translated(sketch.problem) or self.tr("Drawn: {count} corners, {size} m2. Set it, then check that it is "
                                                     "shown in green.").format(
            count=len(sketch.corners), size=f"{area_m2(sketch.corners):.0f}")


def _echoes(points: tuple[Point, ...], state: AreaState | None) -> tuple[Point, ...]:
    pose: Pose | None = None if state is None else state.robot
    return () if pose is None else tuple(map(pose.apply, points))
