"""What the markers of a picture mean."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import QPointF, QRectF, QSize, Qt
from PyQt5.QtGui import QColor, QPainter, QPaintEvent
from PyQt5.QtWidgets import QSizePolicy, QWidget

from mtr_operator.domain.results.diverging import colour_of_error, scale_of
from mtr_operator.domain.results.picture import PointSet

from ..i18n import translate
from ..names import domain_word
from ..theme.appearance import Appearance
from ..theme.scale import XS, M
from .layers.layer import Canvas
from .layers.points_layer import colour_of, draw_interval, draw_marker
from .viewport import Viewport

ROW_PX = 24.0
_TEXT_LEFT_PX = 26.0
_FONT_PX = 15.0
_CM_PER_M = 100.0


def _meanings(sets: Sequence[PointSet]) -> list[tuple[str, str]]:
    """What else is painted beside the markers, each with its text."""
    return [(kind, text) for kind, text in (
        ("bars", translate("Picture", "place of the key (1 sigma)")),
        ("brackets", translate("Picture", "border somewhere in between")),
        ("intervals", translate("Picture", "95 % interval")),
        ("errors_m", _scale_text(sets))) if any(getattr(points, kind) for points in sets)]


def _scale_text(sets: Sequence[PointSet]) -> str:
    """Which errors the ends of the colours are."""
    scale_m = scale_of([error_m for points in sets for error_m in points.errors_m])
    return translate("Picture", "error from {low} to {high} cm").format(
        low=f"\N{MINUS SIGN}{_CM_PER_M * scale_m:g}", high=f"+{_CM_PER_M * scale_m:g}")


def legend_texts(sets: Sequence[PointSet]) -> list[str]:
    """Label and number of points of each set that has some, and the meaning of bars, brackets and intervals."""
    texts = [f"{domain_word(points.label)} ({len(points.known)})" for points in sets if points.known]
    return texts + [text for _, text in _meanings(sets)]


def paint_entry(canvas: Canvas, sets: Sequence[PointSet], index: int, corner: QPointF) -> None:
    """One row with the painter's font; corner: its upper left."""
    shown = [points for points in sets if points.known]
    unit, painter = canvas.unit, canvas.painter
    middle = QPointF(corner.x() + 10.0 * unit, corner.y() + ROW_PX / 2.0 * unit)
    if index < len(shown):
        colour = colour_of(shown[index].role, canvas.palette)
        painter.setPen(canvas.pen(colour, 2.2))
        painter.setBrush(QColor(colour))
        draw_marker(painter, shown[index].role, middle, 5.5 * unit)
    else:
        _paint_meaning(canvas, _meanings(sets)[index - len(shown)][0], middle)
    painter.setPen(QColor(canvas.palette.ink))
    box = QRectF(corner.x() + _TEXT_LEFT_PX * unit, corner.y(), 600 * unit, ROW_PX * unit)
    painter.drawText(box, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, legend_texts(sets)[index])


def _paint_meaning(canvas: Canvas, kind: str, middle: QPointF) -> None:
    reach, colour = QPointF(8.0 * canvas.unit, 0.0), canvas.palette.ink_soft
    if kind == "errors_m":
        _paint_scale(canvas, middle)
        return
    if kind == "intervals":
        canvas.painter.setPen(canvas.pen(colour, 2.2))
        draw_interval(canvas.painter, middle - reach, middle + reach, 5.0 * canvas.unit)
        return
    pen = canvas.pen(colour, 7.0, alpha=0.5) if kind == "bars" else canvas.pen(colour, 1.6, Qt.PenStyle.DotLine)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    canvas.painter.setPen(pen)
    canvas.painter.drawLine(middle - reach, middle + reach)


def _paint_scale(canvas: Canvas, middle: QPointF) -> None:
    """The colours from end to end."""
    unit, count = canvas.unit, 7
    wide, high = 18.0 * unit / count, 10.0 * unit
    canvas.painter.setPen(Qt.PenStyle.NoPen)
    for index in range(count):
        canvas.painter.setBrush(QColor(*colour_of_error(2.0 * index / (count - 1) - 1.0, 1.0)))
        left = middle.x() + (index - count / 2.0) * wide
        canvas.painter.drawRect(QRectF(left, middle.y() - high / 2.0, wide, high))


class LegendStrip(QWidget):
    """The legend above a picture, in as many rows as it takes."""

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._sets: tuple[PointSet, ...] = ()
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        font = self.font()
        font.setPixelSize(round(_FONT_PX))
        self.setFont(font)
        appearance.changed.connect(self.update)

    def show_sets(self, sets: Sequence[PointSet]) -> None:
        """Explain these."""
        self._sets = tuple(sets)
        self.setAccessibleName(", ".join(legend_texts(self._sets)))
        self.updateGeometry()
        self.update()

    def hasHeightForWidth(self) -> bool:
        """See QWidget."""
        return True

    def heightForWidth(self, width: int) -> int:
        """See QWidget."""
        places = self._places(width)
        return round(places[-1].y() + ROW_PX) + XS if places else 0

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(400, self.heightForWidth(max(self.width(), 400)))

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(self.font())
        canvas = Canvas(painter, Viewport(self.width(), self.height()), self._appearance.palette)
        for index, place in enumerate(self._places(self.width())):
            paint_entry(canvas, self._sets, index, place)

    def _places(self, width: int) -> list[QPointF]:
        places: list[QPointF] = []
        left = top = 0.0
        for text in legend_texts(self._sets):
            wide = _TEXT_LEFT_PX + self.fontMetrics().horizontalAdvance(text) + M
            if left and left + wide > width:
                left, top = 0.0, top + ROW_PX
            places.append(QPointF(left, top))
            left += wide
        return places
