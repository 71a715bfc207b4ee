"""What the markers mean, in the upper left corner of a picture."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QColor, QPainter

from mtr_operator.domain.picture import PointSet

from ..i18n import translate
from .layer import Canvas, Layer
from .points_layer import colour_of, draw_marker

_ROW_PX = 24.0
_MARGIN_PX = 12.0
_TEXT_PX = 15.0


class LegendLayer(Layer):
    """Attributes: sets: those with points are listed."""

    def __init__(self, sets: Sequence[PointSet] = ()):
        self.sets = tuple(sets)

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        if not any(points.known for points in self.sets):
            return
        canvas.painter.setFont(canvas.font(_TEXT_PX))
        metrics = canvas.painter.fontMetrics()
        unit = canvas.unit
        texts = legend_texts(self.sets)
        width = max(metrics.horizontalAdvance(text) for text in texts) + 48 * unit
        ground = QColor(canvas.palette.surface)
        ground.setAlphaF(0.88)
        canvas.painter.setPen(canvas.pen(canvas.palette.line))
        canvas.painter.setBrush(ground)
        corner = QPointF(_MARGIN_PX, _MARGIN_PX) * unit
        canvas.painter.drawRoundedRect(QRectF(corner.x(), corner.y(), width, (len(texts) * _ROW_PX + 8) * unit),
                                       4 * unit, 4 * unit)
        paint_legend(canvas, self.sets, corner + QPointF(8, 4) * unit)


def legend_texts(sets: Sequence[PointSet]) -> list[str]:
    """Label and number of points of each set that has some, and the meaning of the bars."""
    texts = [f"{translate('Word', points.label)} ({len(points.known)})" for points in sets if points.known]
    if any(points.bars for points in sets):
        texts.append(translate("Picture", "uncertainty, \N{PLUS-MINUS SIGN}1 sigma"))
    return texts


def paint_legend(canvas: Canvas, sets: Sequence[PointSet], corner: QPointF) -> float:
    """Markers and texts below each other, with the painter's font; how high that is."""
    unit, painter = canvas.unit, canvas.painter
    shown = [points for points in sets if points.known]
    for index, text in enumerate(legend_texts(sets)):
        middle = corner + QPointF(10.0, (index + 0.5) * _ROW_PX) * unit
        if index < len(shown):
            _paint_marker(canvas, painter, shown[index], middle)
        else:
            bar = canvas.pen(canvas.palette.ink_soft, 7.0, alpha=0.5)
            bar.setCapStyle(Qt.FlatCap)
            painter.setPen(bar)
            painter.drawLine(middle - QPointF(8, 0) * unit, middle + QPointF(8, 0) * unit)
        painter.setPen(QColor(canvas.palette.ink))
        painter.drawText(QRectF(middle.x() + 16 * unit, middle.y() - _ROW_PX * unit / 2, 600 * unit, _ROW_PX * unit),
                         Qt.AlignLeft | Qt.AlignVCenter, text)
    return len(legend_texts(sets)) * _ROW_PX * unit


def _paint_marker(canvas: Canvas, painter: QPainter, points: PointSet, middle: QPointF) -> None:
    colour = colour_of(points.look, canvas.palette)
    painter.setPen(canvas.pen(colour, 2.2))
    painter.setBrush(QColor(colour))
    draw_marker(painter, points.look, middle, 5.5 * canvas.unit)
