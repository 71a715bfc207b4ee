"""What the robot sees: returns of its LiDARs, its path, and what hinders it; and what stands around the Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import numpy as np
from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QColor, QPainter, QPen

from mtr_operator.domain.surroundings import StopZone
from mtr_operator.station.sight.obstacle_map import CELL_M
from mtr_operator.station.sight.view import View

from ...i18n import number
from .layer import Canvas, Layer

_RING_PX, _LABEL_PX = 11.0, 24.0
_STOPPED = (StopZone.BLOCKED, StopZone.BLIND)


class SightLayer(Layer):
    """Attributes: view: None while nothing is known, or what is known is old."""

    is_brief = True

    def __init__(self) -> None:
        self.view: View | None = None

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        view, painter, palette = self.view, canvas.painter, canvas.palette
        if view is None:
            return
        points, path = canvas.many(view.points), canvas.many(view.path)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(_flat(canvas.pen(palette.ink_soft, 3.0)))
        painter.drawPoints(points)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(_flat(canvas.pen(palette.waypoint, 2.0)))
        painter.drawPolyline(path)
        if view.obstacle is not None:
            self._paint_obstacle(canvas, *view.obstacle)

    def _paint_obstacle(self, canvas: Canvas, place: tuple[float, float], distance_m: float) -> None:
        is_stopped = self.view is not None and self.view.zone in _STOPPED
        colour = canvas.palette.danger if is_stopped else canvas.palette.warning
        middle, radius = canvas.at(place), _RING_PX * canvas.unit
        canvas.painter.setPen(canvas.pen(colour, 3.0))
        canvas.painter.setBrush(Qt.BrushStyle.NoBrush)
        canvas.painter.drawEllipse(middle, radius, radius)
        canvas.painter.setFont(canvas.font(14.0, True))
        canvas.label(middle - QPointF(0.0, _LABEL_PX * canvas.unit), f"{number(distance_m, 1)} m", colour)


def _flat(pen: QPen) -> QPen:
    """Round ends and joins of hundreds of pieces take a whole frame."""
    pen.setCapStyle(Qt.PenCapStyle.SquareCap)
    pen.setJoinStyle(Qt.PenJoinStyle.BevelJoin)
    return pen


class ObstaclesLayer(Layer):
    """Attributes: places: middles of the cells in which something stands, (n, 2), m."""

    def __init__(self) -> None:
        self.places: Any = np.empty((0, 2))

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        side = CELL_M * canvas.viewport.px_per_m
        canvas.painter.setPen(Qt.PenStyle.NoPen)
        canvas.painter.setBrush(QColor(canvas.palette.ink_soft))
        for x, y in self.places.tolist():
            middle = canvas.at((x, y))
            canvas.painter.drawRect(QRectF(middle.x() - side / 2.0, middle.y() - side / 2.0, side, side))
