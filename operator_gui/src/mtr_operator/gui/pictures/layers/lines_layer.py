"""Axes or radials, with their numbers at the far ends."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

from PyQt5.QtCore import QPointF, Qt

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.picture import Stretch

from .layer import Canvas, Layer

_LABEL_GAP_PX = 15.0
_LABEL_WIDTH_PX = 30.0
_LABEL_HEIGHT_PX = 17.0
# No two of many multiples of it are near each other, but for whole numbers.
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0


class LinesLayer(Layer):
    """Attributes: stretches: where the key is carried."""

    def __init__(self, stretches: Sequence[Stretch] = ()):
        self.stretches = tuple(stretches)

    def points(self) -> Sequence[Point]:
        """See Layer."""
        return [stretch.end for stretch in self.stretches]

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        pen = canvas.pen(canvas.palette.trail, 1.2, Qt.PenStyle.DashLine)
        period = sum(pen.dashPattern())
        for index, stretch in enumerate(self.stretches):
            # Dashes of lines beside each other would make stripes across them, if they began at the same place.
            pen.setDashOffset(period * (index * _GOLDEN % 1.0))
            canvas.painter.setPen(pen)
            canvas.painter.drawLine(canvas.at(stretch.start), canvas.at(stretch.end))
        canvas.painter.setFont(canvas.font(14.0))
        written: list[QPointF] = []
        for stretch in self.stretches:
            place = _label_place(canvas, stretch)
            # As many labels as do not touch each other.
            if all(abs(place.x() - other.x()) > _LABEL_WIDTH_PX * canvas.unit
                   or abs(place.y() - other.y()) > _LABEL_HEIGHT_PX * canvas.unit for other in written):
                written.append(place)
                canvas.label(place, stretch.label, canvas.palette.ink)


def _label_place(canvas: Canvas, stretch: Stretch) -> QPointF:
    start, end = canvas.at(stretch.start), canvas.at(stretch.end)
    way = end - start
    length = max(math.hypot(way.x(), way.y()), 1e-9)
    part = _LABEL_GAP_PX * canvas.unit / length
    return QPointF(end.x() + part * way.x(), end.y() + part * way.y())
