"""Layers that lie below and above everything: the grid of metres, and the scale."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from PyQt5.QtCore import QPointF, QRectF, Qt

from .layer import Canvas, Layer

_STEPS_M = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
_CLOSEST_LINES_PX = 40.0
_SCALE_PX = 90.0


def step_for(px_per_m: float, least_px: float) -> float:
    """Smallest round length that is at least so long on the screen."""
    return next((step for step in _STEPS_M if step * px_per_m >= least_px), _STEPS_M[-1])


class GridLayer(Layer):
    """Lines at round distances from the Car's centre."""

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        view, painter = canvas.viewport, canvas.painter
        step = step_for(view.px_per_m, _CLOSEST_LINES_PX * canvas.unit)
        top, left = view.to_car((0.0, 0.0))
        bottom, right = view.to_car((view.width, view.height))
        for index in range(math.ceil(bottom / step), math.floor(top / step) + 1):
            painter.setPen(canvas.pen(canvas.palette.line, 1.6 if index == 0 else 0.8))
            y = view.to_screen((index * step, 0.0))[1]
            painter.drawLine(QPointF(0.0, y), QPointF(view.width, y))
        for index in range(math.ceil(right / step), math.floor(left / step) + 1):
            painter.setPen(canvas.pen(canvas.palette.line, 1.6 if index == 0 else 0.8))
            x = view.to_screen((0.0, index * step))[0]
            painter.drawLine(QPointF(x, 0.0), QPointF(x, view.height))


class ScaleLayer(Layer):
    """A bar of a round length in the lower left corner."""

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        view, painter, unit = canvas.viewport, canvas.painter, canvas.unit
        step = step_for(view.px_per_m, _SCALE_PX * unit)
        length = step * view.px_per_m
        left, bottom = 16.0 * unit, view.height - 16.0 * unit
        painter.setPen(canvas.pen(canvas.palette.ink, 2.5))
        for start, end in (((0, 0), (length, 0)), ((0, -6), (0, 0)), ((length, -6), (length, 0))):
            painter.drawLine(QPointF(left + start[0], bottom + start[1] * unit),
                             QPointF(left + end[0], bottom + end[1] * unit))
        painter.setFont(canvas.font(15.0))
        box = QRectF(left, bottom - 30 * unit, max(length, 80 * unit), 22 * unit)
        painter.drawText(box, Qt.AlignmentFlag.AlignLeft, f"{step:g} m")
