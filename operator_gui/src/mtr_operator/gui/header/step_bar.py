"""The steps of a test as a row of arrows: finished, selected, still to come."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QPointF, QSize, Qt
from PyQt5.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PyQt5.QtWidgets import QSizePolicy, QWidget

from ..theme.appearance import Appearance
from ..theme.scale import LARGE_PT, M, S

_HEIGHT = 56
_TIP = 20.0
_GAP = 4.0
_TICK = "\N{CHECK MARK} "


class StepBar(QWidget):
    """Shows where the Operator is; takes no input."""

    def __init__(self, titles: list[str], appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._titles = titles
        self._appearance = appearance
        self._selected = 0
        font = self.font()
        font.setPointSizeF(LARGE_PT - 2)
        font.setBold(True)
        self.setFont(font)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        appearance.changed.connect(self.update)
        self._describe()

    @property
    def selected(self) -> int:
        """Index of the present step."""
        return self._selected

    def select(self, index: int) -> None:
        """Make a step the present one; those before it are finished."""
        self._selected = index
        self._describe()
        self.update()

    def sizeHint(self) -> QSize:
        """See QWidget."""
        metrics = self.fontMetrics()
        width = sum(metrics.horizontalAdvance(_TICK + title) + 2 * M + _TIP + _GAP for title in self._titles)
        return QSize(int(width), _HEIGHT)

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(360, _HEIGHT)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        widths = self._widths()
        left = 0.0
        for index, (title, width) in enumerate(zip(self._titles, widths)):
            self._paint_arrow(painter, index, title, (left, width))
            left += width

    def _widths(self) -> list[float]:
        metrics = self.fontMetrics()
        wanted = [metrics.horizontalAdvance(_TICK + title) + 2 * M + _TIP for title in self._titles]
        part = (self.width() - _TIP) / sum(wanted)
        return [width * min(part, 1.25) for width in wanted]

    def _paint_arrow(self, painter: QPainter, index: int, title: str, span: tuple[float, float]) -> None:
        (left, width), height = span, float(self.height() - 2 * S)
        top, right, tail = float(S), left + width - _GAP, _TIP if index else 0.0
        middle, bottom = top + height / 2.0, top + height
        shape = QPolygonF([QPointF(left, top), QPointF(right, top), QPointF(right + _TIP, middle),
                           QPointF(right, bottom), QPointF(left, bottom), QPointF(left + tail, middle)])
        palette = self._appearance.palette
        if index == self._selected:
            fill, ink = palette.accent, palette.on_accent
        elif index < self._selected:
            fill, ink = palette.tint, palette.on_tint
        else:
            fill, ink = palette.raised, palette.ink_soft
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(fill))
        painter.drawPolygon(shape)
        painter.setPen(QPen(QColor(ink)))
        text = (_TICK if index < self._selected else "") + title
        room = int(right - left - tail)
        text = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, room - S)
        painter.drawText(int(left + tail), int(top), room + S, int(height), Qt.AlignmentFlag.AlignCenter, text)

    def _describe(self) -> None:
        self.setAccessibleName(self.tr("Step {number} of {count}: {title}").format(
            number=self._selected + 1, count=len(self._titles), title=self._titles[self._selected]))
