"""The ruler: a distance between two places that the Operator points at."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.geometry.pose import Point

from ...i18n import number
from .layer import Canvas, Layer


class RulerLayer(Layer):
    """Attributes: start, end: the two places; None while there is nothing to measure."""

    is_moving = True

    def __init__(self) -> None:
        self.start: Point | None = None
        self.end: Point | None = None

    @property
    def length_m(self) -> float | None:
        """Distance of the two places."""
        return None if self.start is None or self.end is None else math.dist(self.start, self.end)

    def clear(self) -> None:
        """Take the ruler away."""
        self.start = self.end = None

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        if self.start is None or self.end is None:
            return
        start, end = canvas.at(self.start), canvas.at(self.end)
        canvas.painter.setPen(canvas.pen(canvas.palette.ink, 2.5))
        canvas.painter.drawLine(start, end)
        canvas.painter.setBrush(canvas.painter.pen().color())
        for place in (start, end):
            canvas.painter.drawEllipse(place, 3.5 * canvas.unit, 3.5 * canvas.unit)
        canvas.painter.setFont(canvas.font(16.0, True))
        canvas.label((start + end) / 2.0, f"{number(math.dist(self.start, self.end), 2)} m", canvas.palette.ink)
