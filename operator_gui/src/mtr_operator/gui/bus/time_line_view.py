"""The last minute: a band of the Car's locks, and below it the key's distance from the Car's outline."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
from typing import Iterator, Sequence

from PyQt5.QtCore import QPointF, QRectF, QSize, Qt
from PyQt5.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PyQt5.QtWidgets import QSizePolicy, QWidget

from mtr_operator.domain.ports import LockState
from mtr_operator.station.bus.time_line import SPAN_S, LockEvent, Moment

from ..i18n import number
from ..names import locks_text
from ..theme.appearance import Appearance

_SIZE = QSize(520, 210)
# Heights from the top: the band, the words of the changes, the curve, the times.
_BAND_PX, _WORDS_PX, _FOOT_PX, _RIGHT_PX, _GAP_PX = 26, 26, 34, 14, 8
_TICK_S = 10.0
# Marks nearer to each other than this share one label.
_LABEL_PX = 76
# Between two Statuses that are farther apart nobody saw the key.
_UNSEEN_S = 1.0
_NICE_M = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)


def runs(moments: Sequence[Moment]) -> Iterator[tuple[LockState, float, float]]:
    """State, begin and end in robot time of each stretch of one state of the locks."""
    groups = [(state, next(group).stamp_s) for state, group in itertools.groupby(
        moments, key=lambda moment: moment.lock_state)]
    ends = [begin_s for _, begin_s in groups[1:]] + [moment.stamp_s for moment in moments[-1:]]
    for (state, begin_s), end_s in zip(groups, ends):
        yield state, begin_s, end_s


def curves(moments: Sequence[Moment]) -> list[list[tuple[float, float]]]:
    """Robot time and distance of the key, in pieces where it was seen without a gap."""
    pieces: list[list[tuple[float, float]]] = []
    last_s: float | None = None
    for moment in moments:
        if moment.gap_m is None:
            last_s = None
            continue
        if last_s is None or moment.stamp_s - last_s > _UNSEEN_S:
            pieces.append([])
        pieces[-1].append((moment.stamp_s, moment.gap_m))
        last_s = moment.stamp_s
    return pieces


def highest_m(moments: Sequence[Moment]) -> float:
    """A round distance, above all that are shown."""
    most = max((moment.gap_m for moment in moments if moment.gap_m is not None), default=0.0)
    return next((nice for nice in _NICE_M if nice >= most), most)


class TimeLineView(QWidget):
    """Now is on the right."""

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self._moments: Sequence[Moment] = ()
        self._events: Sequence[LockEvent] = ()
        self._left_px = 0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("The Car's locks and the key's distance over the last minute"))
        appearance.changed.connect(self.update)

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return _SIZE

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(_SIZE.width() // 2, _SIZE.height())

    def show_moments(self, moments: Sequence[Moment], events: Sequence[LockEvent]) -> None:
        """Show these, in the order of time."""
        self._moments, self._events = moments, events
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor(self._appearance.palette.surface))
        top_m = highest_m(self._moments)
        self._left_px = painter.fontMetrics().horizontalAdvance(f"{number(top_m, 1)} m") + 2 * _GAP_PX
        self._paint_grid(painter, top_m)
        if self._moments:
            self._paint_band(painter)
            self._paint_curves(painter, top_m)
            self._paint_events(painter)

    def _x(self, stamp_s: float) -> float:
        part = 1.0 - (self._moments[-1].stamp_s - stamp_s) / SPAN_S
        return self._left_px + part * (self.width() - _RIGHT_PX - self._left_px)

    def _y(self, gap_m: float, top_m: float) -> float:
        high, low = _BAND_PX + _WORDS_PX + _GAP_PX, self.height() - _FOOT_PX
        return low - gap_m / top_m * (low - high)

    def _paint_grid(self, painter: QPainter, top_m: float) -> None:
        palette, right = self._appearance.palette, self.width() - _RIGHT_PX
        for gap_m in (0.0, top_m / 2.0, top_m):
            y = self._y(gap_m, top_m)
            painter.setPen(QPen(QColor(palette.line), 1))
            painter.drawLine(QPointF(self._left_px, y), QPointF(right, y))
            painter.setPen(QColor(palette.ink_soft))
            painter.drawText(QRectF(0, y - 10, self._left_px - _GAP_PX, 20),
                             Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, f"{number(gap_m, 1)} m")
        for index in range(int(SPAN_S / _TICK_S) + 1):
            x = right - index * _TICK_S / SPAN_S * (right - self._left_px)
            text = f"\N{MINUS SIGN}{index * _TICK_S:.0f} s" if index else "0 s"
            width = painter.fontMetrics().horizontalAdvance(text)
            left = min(max(x - width / 2.0, self._left_px), self.width() - width - 2.0)
            painter.drawText(QPointF(left, self.height() - _GAP_PX), text)

    def _paint_band(self, painter: QPainter) -> None:
        palette = self._appearance.palette
        colours = {LockState.LOCKED: palette.first, LockState.UNLOCKED: palette.second}
        for state, begin_s, end_s in runs(self._moments):
            room = QRectF(self._x(begin_s), 0, max(self._x(end_s) - self._x(begin_s), 1.0), _BAND_PX)
            is_known = state in colours
            painter.fillRect(room, QColor(colours.get(state, palette.raised)))
            text = locks_text(state)
            if painter.fontMetrics().horizontalAdvance(text) + _GAP_PX < room.width():
                painter.setPen(QColor(palette.surface if is_known else palette.ink_soft))
                painter.drawText(room, Qt.AlignmentFlag.AlignCenter, text)

    def _paint_curves(self, painter: QPainter, top_m: float) -> None:
        painter.setPen(QPen(QColor(self._appearance.palette.key), 2))
        for piece in curves(self._moments):
            painter.drawPolyline(QPolygonF([QPointF(self._x(stamp_s), self._y(gap_m, top_m))
                                            for stamp_s, gap_m in piece]))

    def _paint_events(self, painter: QPainter) -> None:
        """A line at each change with the key's distance then; of those close together the newest has the words."""
        palette, free_px = self._appearance.palette, float(self.width())
        for event in reversed(self._events):
            x = self._x(event.time_s)
            painter.setPen(QPen(QColor(palette.ink), 1, Qt.PenStyle.DotLine))
            painter.drawLine(QPointF(x, 0), QPointF(x, self.height() - _FOOT_PX))
            text = "" if event.gap_m is None else f"{number(event.gap_m, 2)} m"
            left = x - painter.fontMetrics().horizontalAdvance(text) - _GAP_PX / 2.0
            if not text or x > free_px or left < self._left_px:
                continue
            free_px = x - _LABEL_PX
            painter.setPen(QColor(palette.ink))
            painter.drawText(QPointF(left, _BAND_PX + _WORDS_PX - _GAP_PX), text)
