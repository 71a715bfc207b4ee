"""What a picture consists of: layers that paint themselves, on a screen or into a file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import Any, Sequence

import numpy as np
from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QColor, QFont, QPainter, QPen, QPolygonF

from mtr_operator.domain.geometry.pose import Point

from ...theme.palette import Palette
from ..viewport import Viewport


@dataclass(frozen=True)
class Canvas:
    """What a layer paints on. unit: length of one screen pixel in the painter's units, for lines and letters.

    labels: where labels were painted, by all layers.
    """

    painter: QPainter
    viewport: Viewport
    palette: Palette
    unit: float = 1.0
    labels: list[QRectF] = field(default_factory=list)

    def at(self, point: Point) -> QPointF:
        """Place of a point of the Car coordinate system."""
        return QPointF(*self.viewport.to_screen(point))

    def polygon(self, points: Sequence[Point]) -> QPolygonF:
        """Places of points."""
        to_screen = self.viewport.to_screen
        return QPolygonF([QPointF(*to_screen(point)) for point in points])

    def many(self, points: Any) -> QPolygonF:
        """Places of hundreds of points, (n, 2): written into the polygon's own memory, for an object of Python for each
        would take longer than to paint them."""
        x_m, y_m = np.asarray(points, dtype=float).reshape(-1, 2).T
        places: Any = np.column_stack(self.viewport.to_screen((x_m, y_m)))
        polygon = QPolygonF(len(places))
        if len(places):
            memory: Any = polygon.data()
            memory.setsize(places.nbytes)
            np.frombuffer(memory, dtype=float).reshape(-1, 2)[:] = places
        return polygon

    def pen(self, colour: str, width: float = 1.0, style: Qt.PenStyle = Qt.PenStyle.SolidLine,
            alpha: float = 1.0) -> QPen:
        """Pen of a width in pixels."""
        shade = QColor(colour)
        shade.setAlphaF(alpha)
        return QPen(shade, width * self.unit, style, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin)

    def font(self, pixels: float, is_bold: bool = False) -> QFont:
        """Font of a height in pixels."""
        font = QFont(self.painter.font())
        font.setPixelSize(max(1, round(pixels * self.unit)))
        font.setBold(is_bold)
        return font

    def label(self, place: QPointF, text: str, colour: str) -> None:
        """Text centred at a place, legible on whatever is below it. The painter's font is used."""
        box = self.label_box(place, text)
        self.labels.append(box)
        ground = QColor(self.palette.surface)
        ground.setAlphaF(0.85)
        self.painter.setPen(Qt.PenStyle.NoPen)
        self.painter.setBrush(ground)
        self.painter.drawRoundedRect(box, 3 * self.unit, 3 * self.unit)
        self.painter.setPen(QColor(colour))
        self.painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

    def label_box(self, place: QPointF, text: str) -> QRectF:
        """What a label takes up at a place."""
        rect = self.painter.fontMetrics().boundingRect(text)
        box = QRectF(0, 0, rect.width() + 8 * self.unit, rect.height() + 2 * self.unit)
        box.moveCenter(place)
        return box

    def has_room(self, box: QRectF) -> bool:
        """The picture has it whole, and no label is there."""
        whole = QRectF(0.0, 0.0, self.viewport.width, self.viewport.height)
        return whole.contains(box) and not any(box.intersects(other) for other in self.labels)


class Layer(ABC):
    """One kind of thing in a picture.

    Attributes:
        is_moving: it changes with every frame; the others are painted once and kept.
        is_brief: it changes some times a second; it is kept over the others until then.
        is_visible: it is painted.
    """

    is_moving = is_brief = False
    is_visible = True

    @abstractmethod
    def paint(self, canvas: Canvas) -> None:
        """Paint it; the painter's state need not be restored."""

    def paint_added(self, canvas: Canvas) -> None:
        """Paint what has been added since, over what is there already; a layer that cannot tell paints everything."""
        self.paint(canvas)

    def extent(self, viewport: Viewport) -> QRectF:
        """Where it paints on the screen; of a layer that moves, so that the rest need not be painted anew."""
        return QRectF(0.0, 0.0, viewport.width, viewport.height)

    def points(self) -> Sequence[Point]:
        """Places that should be seen when everything is to be seen."""
        return ()


def paint_all(layers: Sequence[Layer], canvas: Canvas) -> None:
    """Paint visible layers over each other."""
    for layer in layers:
        if layer.is_visible:
            canvas.painter.save()
            layer.paint(canvas)
            canvas.painter.restore()
