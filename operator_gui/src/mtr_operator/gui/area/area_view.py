"""The picture in which the Operator draws the test area, with mouse or keyboard."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import QPoint, Qt, pyqtSignal
from PyQt5.QtGui import QKeyEvent, QMouseEvent
from PyQt5.QtWidgets import QWidget

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.station.sight.area_sketch import AreaSketch

from ..pictures.layers.area_layer import SketchLayer
from ..pictures.layers.layer import Layer
from ..pictures.picture_view import PictureView
from ..theme.appearance import Appearance

# A corner is picked from so far on the screen.
_REACH_PX = 14.0
# Steps of the cursor, and with Shift.
_STEP_M, _LARGE_STEP_M = 0.1, 1.0
_KEY_REACH_M = 0.5
# Seen at least, to each side of where the robot started.
_ROOM_M = (8.0, 8.0)
_MARGIN_PX = 30.0
_WAYS: dict[int, Point] = {Qt.Key.Key_Up: (1.0, 0.0), Qt.Key.Key_Down: (-1.0, 0.0), Qt.Key.Key_Left: (0.0, 1.0),
                           Qt.Key.Key_Right: (0.0, -1.0)}


class AreaView(PictureView):
    """Attributes: sketch: what is drawn. Signals: sketched: it has changed."""

    sketched = pyqtSignal()

    def __init__(self, sketch: AreaSketch, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(appearance, parent)
        self.sketch = sketch
        self._layer = SketchLayer()
        self._is_panned = False
        self.setAccessibleName(self.tr("Test area from above. Arrows move the cross, Shift by a metre; Space adds a "
                                       "corner, Return picks and drops one, Delete removes one, Ctrl+Z undoes."))
        self.setCursor(Qt.CursorShape.CrossCursor)

    def show_layers(self, layers: Sequence[Layer]) -> None:
        """See PictureView; the sketch is above them."""
        super().show_layers((*layers, self._layer))

    def show_sketch(self) -> None:
        """It has changed."""
        self._layer.corners, self._layer.picked = self.sketch.corners, self.sketch.picked
        self._layer.cursor = self.sketch.cursor if self.hasFocus() else None
        self.update()
        self.sketched.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """A corner under the pointer is picked; elsewhere a drag moves the picture."""
        found = self.sketch.nearest(self._place(event.pos()), _REACH_PX / self.viewport.px_per_m)
        if found is not None and event.button() == Qt.MouseButton.LeftButton:
            self.sketch.pick(found)
        elif found is not None and event.button() == Qt.MouseButton.RightButton:
            self.sketch.remove(found)
        self._is_panned = False
        super().mousePressEvent(event)
        self.show_sketch()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """See QWidget."""
        if self.sketch.picked is None:
            self._is_panned = True
            super().mouseMoveEvent(event)
            return
        self.sketch.move(self._place(event.pos()))
        self.show_sketch()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """A click adds a corner."""
        is_click = event.button() == Qt.MouseButton.LeftButton and self._pressed == event.pos()
        if self.sketch.picked is not None:
            self.sketch.drop()
        elif is_click and not self._is_panned:
            self._add(event.pos())
        super().mouseReleaseEvent(event)
        self.show_sketch()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """See QWidget."""
        key, sketch = event.key(), self.sketch
        if key in _WAYS:
            self._move_cursor(_WAYS[key], event.modifiers())
        elif key == Qt.Key.Key_Space:
            sketch.add(sketch.cursor)
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._pick_or_drop()
        elif key in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            self._remove()
        elif key == Qt.Key.Key_Z and event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            sketch.undo()
        else:
            super().keyPressEvent(event)
            return
        self.show_sketch()

    def _fit(self) -> None:
        """What is drawn is seen as well, and room to draw."""
        points = [point for layer in self.layers for point in layer.points()]
        self.viewport = self.viewport.fitted((*points, *self.sketch.corners, _ROOM_M), _MARGIN_PX)

    def _add(self, pixel: QPoint) -> None:
        self.sketch.cursor = self._place(pixel)
        self.sketch.add(self.sketch.cursor)

    def _move_cursor(self, way: Point, modifiers: Qt.KeyboardModifiers) -> None:
        step = _LARGE_STEP_M if modifiers & Qt.KeyboardModifier.ShiftModifier else _STEP_M
        x, y = self.sketch.cursor
        self.sketch.cursor = (x + step * way[0], y + step * way[1])
        self.sketch.move(self.sketch.cursor)

    def _pick_or_drop(self) -> None:
        sketch = self.sketch
        found = sketch.nearest(sketch.cursor, _KEY_REACH_M)
        if sketch.picked is not None:
            sketch.drop()
        elif found is not None:
            sketch.cursor = sketch.corners[found]
            sketch.pick(found)

    def _remove(self) -> None:
        found = self.sketch.nearest(self.sketch.cursor, _KEY_REACH_M)
        if found is None and self.sketch.corners:
            found = len(self.sketch.corners) - 1
        if found is not None:
            self.sketch.remove(found)
