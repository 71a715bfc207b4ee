"""The steps of a test as a row of arrows: finished, selected, still to come."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from PyQt5.QtCore import QPointF, QSize, Qt
from PyQt5.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PyQt5.QtWidgets import QSizePolicy, QWidget

from ..theme.appearance import Appearance
from ..theme.scale import LARGE_PT, S

_HEIGHT = 56
_TIP = 12.0
_MARGIN = 4.0
_MAX_STRETCH = 1.7
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

    def texts(self) -> list[str]:
        """What the arrows say: titles; where these have no room the present title and numbers, or numbers alone."""
        fitting = (texts for texts in self._variants() if self._width_of(texts) <= self.width())
        return next(fitting, self._variants()[-1])

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(self._width_of(self._variants()[0]), _HEIGHT)

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(self._width_of(self._variants()[-1]), _HEIGHT)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        left = 0.0
        for index, (text, width) in enumerate(self._arrows()):
            self._paint_arrow(painter, index, text, (left, width))
            left += width

    def _variants(self) -> tuple[list[str], list[str], list[str]]:
        done = self._selected
        titles = [(_TICK if index < done else "") + title for index, title in enumerate(self._titles)]
        numbers = [_TICK.strip() if index < done else str(index + 1) for index in range(len(self._titles))]
        present = [titles[index] if index == done else text for index, text in enumerate(numbers)]
        return titles, present, numbers

    def _arrow_width(self, text: str) -> float:
        return self.fontMetrics().horizontalAdvance(text) + 2 * _MARGIN + _TIP + _GAP

    def _width_of(self, texts: list[str]) -> int:
        return math.ceil(sum(map(self._arrow_width, texts)) + _TIP)

    def _arrows(self) -> list[tuple[str, float]]:
        """Text and width of each; what is left of the bar is shared, as far as it looks well."""
        texts = self.texts()
        part = min((self.width() - _TIP) / sum(map(self._arrow_width, texts)), _MAX_STRETCH)
        return [(text, self._arrow_width(text) * part) for text in texts]

    def _paint_arrow(self, painter: QPainter, index: int, text: str, span: tuple[float, float]) -> None:
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
        room = int(right - left - tail)
        painter.drawText(int(left + tail), int(top), room + S, int(height), Qt.AlignmentFlag.AlignCenter, text)

    def _describe(self) -> None:
        self.setToolTip("\n".join(self._variants()[0]))
        self.setAccessibleName(self.tr("Step {number} of {count}: {title}").format(
            number=self._selected + 1, count=len(self._titles), title=self._titles[self._selected]))
