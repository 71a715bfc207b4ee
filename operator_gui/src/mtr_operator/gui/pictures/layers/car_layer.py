"""The Car from above, in the size that the robot has measured."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QBrush, QColor

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.report.car_shape import (
    HEADLAMP,
    REAR_WINDOW,
    ROUNDING_PART,
    SIDE_WINDOW,
    TAIL,
    WINDSCREEN,
    mirrored,
    scaled,
)

from ...i18n import translate
from .layer import Canvas, Layer

_LAMP, _TAIL_LAMP = "#f7e7a1", "#c0392b"
_MIN_TEXT_PX = 9.0


class CarLayer(Layer):
    """The measured outline where the robot says it, else a rounded rectangle of the measured size.

    Attributes: car: its dimensions. is_measured: False paints its border dashed, for its size is a guess.
    """

    def __init__(self, car: CarDimensions, is_measured: bool):
        self.car = car
        self.is_measured = is_measured

    def points(self) -> Sequence[Point]:
        """See Layer."""
        return ((self.car.length / 2.0, self.car.width / 2.0),)

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        painter, palette, car = canvas.painter, canvas.palette, self.car
        half_length, half_width = car.length / 2.0, car.width / 2.0
        rounding = ROUNDING_PART * car.width * canvas.viewport.px_per_m
        style = Qt.PenStyle.SolidLine if self.is_measured else Qt.PenStyle.DashLine
        painter.setPen(canvas.pen(palette.edge, 1.8, style))
        painter.setBrush(QBrush(QColor(palette.body)))
        if car.outline:
            painter.drawPolygon(canvas.polygon(car.outline))
            self._paint_body(canvas, half_length, half_width)
        else:
            body = QRectF(canvas.at((half_length, half_width)), canvas.at((-half_length, -half_width)))
            painter.drawRoundedRect(body, rounding, rounding)
        painter.setPen(canvas.pen(palette.edge, 0.8))
        for parts, colour in (((WINDSCREEN, REAR_WINDOW, SIDE_WINDOW, mirrored(SIDE_WINDOW)), palette.glass),
                              ((HEADLAMP, mirrored(HEADLAMP)), _LAMP), ((TAIL, mirrored(TAIL)), _TAIL_LAMP)):
            painter.setBrush(QBrush(QColor(colour)))
            for part in parts:
                painter.drawPolygon(canvas.polygon(scaled(part, half_length, half_width)))
        self._write_front(canvas, half_length)

    @staticmethod
    def _paint_body(canvas: Canvas, half_length: float, half_width: float) -> None:
        """The rectangle of the measured size: distances from a side count from here, not from mirrors or bumpers."""
        canvas.painter.setPen(canvas.pen(canvas.palette.edge, 1.0, Qt.PenStyle.DashLine))
        canvas.painter.setBrush(Qt.BrushStyle.NoBrush)
        canvas.painter.drawRect(QRectF(canvas.at((half_length, half_width)), canvas.at((-half_length, -half_width))))
        canvas.painter.setPen(canvas.pen(canvas.palette.edge, 1.8))

    def _write_front(self, canvas: Canvas, half_length: float) -> None:
        size = min(15.0, 0.13 * self.car.width * canvas.viewport.px_per_m / canvas.unit)
        if size < _MIN_TEXT_PX:
            self._point_to_front(canvas, half_length)
            return
        canvas.painter.setPen(QColor(canvas.palette.ink))
        canvas.painter.setFont(canvas.font(size, True))
        middle = canvas.at((0.66 * half_length, 0.0))
        room = QPointF(0.5 * self.car.width * canvas.viewport.px_per_m, 12.0 * canvas.unit)
        box = QRectF(middle - room, middle + room)
        canvas.painter.drawText(box, Qt.AlignmentFlag.AlignCenter, translate("Picture", "FRONT"))

    @staticmethod
    def _point_to_front(canvas: Canvas, half_length: float) -> None:
        """An arrow head before a Car that is too small for letters."""
        bumper, unit = canvas.at((half_length, 0.0)), canvas.unit
        tip, left, right = (QPointF(bumper.x() + x * unit, bumper.y() - y * unit)
                            for x, y in ((0.0, 13.0), (-6.0, 4.0), (6.0, 4.0)))
        canvas.painter.setPen(Qt.PenStyle.NoPen)
        canvas.painter.setBrush(QBrush(QColor(canvas.palette.ink)))
        canvas.painter.drawPolygon(tip, left, right)
