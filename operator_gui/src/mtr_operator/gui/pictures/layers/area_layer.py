"""Borders of test areas, and corners that are being drawn."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import QPointF, Qt
from PyQt5.QtGui import QColor

from mtr_operator.domain.geometry.pose import Point

from .layer import Canvas, Layer

_FILL_ALPHA = 0.10
_CORNER_PX = 6.0
_CROSS_PX = 9.0


class AreaLayer(Layer):
    """The area that the robot enforces.

    Attributes: corners: none without one.
    """

    def __init__(self) -> None:
        self.corners: tuple[Point, ...] = ()

    def points(self) -> Sequence[Point]:
        """See Layer."""
        return self.corners

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        if not self.corners:
            return
        fill = QColor(canvas.palette.ok)
        fill.setAlphaF(_FILL_ALPHA)
        canvas.painter.setBrush(fill)
        canvas.painter.setPen(canvas.pen(canvas.palette.ok, 2.0))
        canvas.painter.drawPolygon(canvas.polygon(self.corners))


class SketchLayer(Layer):
    """The area that is being drawn, dashed, with its corners.

    Attributes: corners: in their order. picked: index of the one that is moved. cursor: of the keyboard, None while it
    is not used.
    """

    is_moving = True

    def __init__(self) -> None:
        self.corners: tuple[Point, ...] = ()
        self.picked: int | None = None
        self.cursor: Point | None = None

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        painter, palette = canvas.painter, canvas.palette
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(canvas.pen(palette.accent, 2.0, Qt.PenStyle.DashLine))
        if len(self.corners) > 1:
            painter.drawPolygon(canvas.polygon(self.corners))
        for index, corner in enumerate(self.corners):
            is_picked = index == self.picked
            painter.setPen(canvas.pen(palette.accent, 2.0))
            painter.setBrush(QColor(palette.accent if is_picked else palette.surface))
            radius = (_CORNER_PX + 2.0 if is_picked else _CORNER_PX) * canvas.unit
            painter.drawEllipse(canvas.at(corner), radius, radius)
        if self.cursor is not None:
            place, reach = canvas.at(self.cursor), _CROSS_PX * canvas.unit
            painter.setPen(canvas.pen(palette.ink, 2.0))
            painter.drawLine(place - QPointF(reach, 0.0), place + QPointF(reach, 0.0))
            painter.drawLine(place - QPointF(0.0, reach), place + QPointF(0.0, reach))


class EchoLayer(Layer):
    """What the LiDARs see now, as dots.

    Attributes: places: of the echoes.
    """

    is_brief = True

    def __init__(self) -> None:
        self.places: tuple[Point, ...] = ()

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        canvas.painter.setPen(canvas.pen(canvas.palette.edge, 3.0))
        canvas.painter.drawPoints(canvas.many(self.places))


class CarOutlineLayer(Layer):
    """The mapped Car in the start frame.

    Attributes: corners: of its outline, none before it is mapped.
    """

    def __init__(self) -> None:
        self.corners: tuple[Point, ...] = ()

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        if self.corners:
            canvas.painter.setBrush(QColor(canvas.palette.body))
            canvas.painter.setPen(canvas.pen(canvas.palette.edge, 1.5))
            canvas.painter.drawPolygon(canvas.polygon(self.corners))
