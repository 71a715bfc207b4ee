"""What was measured: points with their uncertainty, and the areas that they enclose."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QColor, QPainter

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.diverging import colour_of_error, scale_of
from mtr_operator.domain.results.picture import PointRole, PointSet

from ...figure_text import sign_text
from ...theme.palette import Palette
from .layer import Canvas, Layer

_RADIUS_PX = 5.5
_LABEL_GAP_PX = 14.0
_AREA_ALPHA = 0.12
_BAR_ALPHA = 0.35
_CAP_PX = 6.0
# Markers of lines; the others are filled.
_DRAWN = (PointRole.FIRST_FAILED, PointRole.SECOND_FAILED, PointRole.FAILED, PointRole.UNKNOWN)


def colour_of(role: PointRole, palette: Palette) -> str:
    """Colour of a role."""
    return {PointRole.FIRST: palette.first, PointRole.FIRST_FAILED: palette.first,
            PointRole.SECOND: palette.second, PointRole.SECOND_FAILED: palette.second,
            PointRole.FAILED: palette.failed, PointRole.INVALID: palette.invalid,
            PointRole.UNKNOWN: palette.ink_soft}[role]


def draw_marker(painter: QPainter, role: PointRole, place: QPointF, radius: float) -> None:
    """Marker of a role: told apart by shape too. Pen and brush are the painter's."""
    if role is PointRole.UNKNOWN:
        painter.setBrush(Qt.BrushStyle.NoBrush)
    if role in (PointRole.FIRST, PointRole.UNKNOWN):
        painter.drawEllipse(place, radius, radius)
    elif role is PointRole.SECOND:
        painter.drawRect(QRectF(place.x() - 0.9 * radius, place.y() - 0.9 * radius, 1.8 * radius, 1.8 * radius))
    elif role is PointRole.INVALID:
        painter.drawPolygon(place + QPointF(0, -1.2 * radius), place + QPointF(1.2 * radius, 0),
                            place + QPointF(0, 1.2 * radius), place + QPointF(-1.2 * radius, 0))
    else:
        for dx, dy in ((1, 1), (1, -1)):
            painter.drawLine(QPointF(place.x() - dx * radius, place.y() - dy * radius),
                             QPointF(place.x() + dx * radius, place.y() + dy * radius))


def draw_interval(painter: QPainter, start: QPointF, end: QPointF, cap: float) -> None:
    """A line with a cap across each end."""
    way = end - start
    length = max(math.hypot(way.x(), way.y()), 1e-9)
    across = QPointF(-way.y() * cap / length, way.x() * cap / length)
    painter.drawLine(start, end)
    for place in (start, end):
        painter.drawLine(place - across, place + across)


class AreasLayer(Layer):
    """Attributes: sets: those that enclose an area are painted. is_complete: no line is missing, so areas close."""

    def __init__(self, sets: Sequence[PointSet] = (), is_complete: bool = True):
        self.sets = tuple(sets)
        self.is_complete = is_complete

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        for points in self.sets:
            if points.is_outline and len(points.known) > 2:
                _paint_outline(canvas, points, self.is_complete)


class PointsLayer(Layer):
    """Attributes: sets: what there is to show. chosen: points to be marked, e.g. those of a row of the table.

    shows_figures: writes what may be said of each point beside it.
    """

    def __init__(self, sets: Sequence[PointSet] = (), shows_figures: bool = False):
        self.sets = tuple(sets)
        self.chosen: tuple[Point, ...] = ()
        self.shows_figures = shows_figures

    def points(self) -> Sequence[Point]:
        """See Layer."""
        return [point for points in self.sets for point in points.known]

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        for points in self.sets:
            _paint_points(canvas, points)
        for point in self.chosen:
            canvas.painter.setBrush(Qt.BrushStyle.NoBrush)
            canvas.painter.setPen(canvas.pen(canvas.palette.ink, 3.0))
            canvas.painter.drawEllipse(canvas.at(point), 12.0 * canvas.unit, 12.0 * canvas.unit)
        if self.shows_figures:
            self._write_figures(canvas)

    def _write_figures(self, canvas: Canvas) -> None:
        """As many figures as have room beside each other and the lines' numbers."""
        canvas.painter.setFont(canvas.font(14.0, True))
        for points in self.sets:
            for point, figure in zip(points.points, points.figures):
                if point is None or figure is None:
                    continue
                text = sign_text(figure)
                is_beyond = points.intervals or points.brackets
                places = _outward(canvas, points, point, text) if is_beyond else [_inward(canvas, point, text)]
                place = next((each for each in places if canvas.has_room(canvas.label_box(each, text))), None)
                if place is not None:
                    canvas.label(place, text, colour_of(points.role, canvas.palette))


def _outward(canvas: Canvas, points: PointSet, point: Point, text: str) -> Sequence[QPointF]:
    """Beyond a point and its interval, where the points nearer to the Car stay in sight; beside that, where the line's
    own number is; farther out."""
    ends = (*points.intervals, *points.brackets)
    end = canvas.at(next((end for _, end in ends if _is_behind(point, end)), point))
    inward = _toward(canvas, end, canvas.at((0.0, 0.0)), text) - end
    first = QPointF(end.x() - inward.x(), end.y() - inward.y())
    length, box = max(math.hypot(inward.x(), inward.y()), 1e-9), canvas.label_box(first, text)
    ahead_x, ahead_y = -inward.x() / length, -inward.y() / length
    out = abs(ahead_x) * box.width() + abs(ahead_y) * box.height()
    side = abs(ahead_y) * box.width() + abs(ahead_x) * box.height()
    ways = ((0.0, 0.0), (-ahead_y * side, ahead_x * side), (ahead_y * side, -ahead_x * side),
            (ahead_x * out, ahead_y * out))
    return [QPointF(first.x() + x, first.y() + y) for x, y in ways]


def _is_behind(point: Point, end: Point) -> bool:
    """True for points in the same direction from the Car's centre, within a thousandth of a radian."""
    across, along = point[0] * end[1] - point[1] * end[0], point[0] * end[0] + point[1] * end[1]
    return along > 0.0 and abs(across) < 1e-3 * along


def _inward(canvas: Canvas, point: Point, text: str) -> QPointF:
    """Where a text has room between a point and the Car's centre."""
    return _toward(canvas, canvas.at(point), canvas.at((0.0, 0.0)), text)


def _toward(canvas: Canvas, place: QPointF, goal: QPointF, text: str) -> QPointF:
    way = goal - place
    length = max(math.hypot(way.x(), way.y()), 1e-9)
    box = canvas.painter.fontMetrics().boundingRect(text)
    room = (abs(way.x()) * box.width() + abs(way.y()) * box.height()) / (2.0 * length) + _LABEL_GAP_PX * canvas.unit
    part = room / length
    return QPointF(place.x() + part * way.x(), place.y() + part * way.y())


def _paint_outline(canvas: Canvas, points: PointSet, is_complete: bool) -> None:
    colour = colour_of(points.role, canvas.palette)
    pieces = list(points.pieces()) if is_complete else list(points.pieces())[:-1]
    for start, end, is_known in pieces:
        # A piece that bridges a line without a point is a guess.
        width, style = (2.0, Qt.PenStyle.SolidLine) if is_known else (1.2, Qt.PenStyle.DotLine)
        canvas.painter.setPen(canvas.pen(colour, width, style))
        canvas.painter.drawLine(canvas.at(start), canvas.at(end))
    if is_complete and all(is_known for _, _, is_known in pieces):
        fill = QColor(colour)
        fill.setAlphaF(_AREA_ALPHA)
        canvas.painter.setPen(Qt.PenStyle.NoPen)
        canvas.painter.setBrush(fill)
        canvas.painter.drawPolygon(canvas.polygon(points.known))


def _paint_points(canvas: Canvas, points: PointSet) -> None:
    colour = colour_of(points.role, canvas.palette)
    painter = canvas.painter
    bar = canvas.pen(colour, 6.0, alpha=_BAR_ALPHA)
    bar.setCapStyle(Qt.PenCapStyle.FlatCap)
    painter.setPen(bar)
    for start, end in points.bars:
        painter.drawLine(canvas.at(start), canvas.at(end))
    painter.setPen(canvas.pen(colour, 1.6, Qt.PenStyle.DotLine))
    for start, end in points.brackets:
        painter.drawLine(canvas.at(start), canvas.at(end))
    painter.setPen(canvas.pen(colour, 2.2))
    for start, end in points.intervals:
        draw_interval(painter, canvas.at(start), canvas.at(end), _CAP_PX * canvas.unit)
    is_drawn = points.role in _DRAWN
    painter.setPen(canvas.pen(colour if is_drawn else canvas.palette.surface, 2.2 if is_drawn else 1.0))
    painter.setBrush(QColor(colour))
    if points.errors_m:
        _paint_errors(canvas, points)
        return
    for point in points.known:
        draw_marker(painter, points.role, canvas.at(point), _RADIUS_PX * canvas.unit)


def _paint_errors(canvas: Canvas, points: PointSet) -> None:
    """Ringed, so that a point without an error is seen too."""
    scale_m = scale_of(points.errors_m)
    canvas.painter.setPen(canvas.pen(canvas.palette.ink, 1.0))
    for point, error_m in zip(points.known, points.errors_m):
        canvas.painter.setBrush(QColor(*colour_of_error(error_m, scale_m)))
        draw_marker(canvas.painter, points.role, canvas.at(point), 1.3 * _RADIUS_PX * canvas.unit)
