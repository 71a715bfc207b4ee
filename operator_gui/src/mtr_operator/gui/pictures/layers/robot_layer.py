"""The robot with the Remote key, where it is going, and where it has been."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math
from typing import Iterator, Sequence

from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QColor

from mtr_operator.domain.geometry.pose import Point, Pose

from ..viewport import Viewport
from .layer import Canvas, Layer

# Clearpath's data sheet of the Jackal: 508 mm x 430 mm.
_LENGTH_M, _WIDTH_M = 0.508, 0.430
_KEY_RADIUS_PX = 5.0
# From the middle to a corner; pens and the key's mark lie beyond what they mark.
_REACH_M, _EDGE_PX = math.hypot(_LENGTH_M, _WIDTH_M) / 2.0, 8.0
_SIGMA_ALPHA = 0.2


class WaypointLayer(Layer):
    """Attributes: pose: where the robot is sent, None for nowhere."""

    is_brief = True

    def __init__(self) -> None:
        self.pose: Pose | None = None

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        if self.pose is None:
            return
        painter = canvas.painter
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(canvas.pen(canvas.palette.waypoint, 2.0, Qt.PenStyle.DashLine))
        painter.drawPolygon(canvas.polygon(_outline(self.pose)))
        place = canvas.at((self.pose.x, self.pose.y))
        painter.setPen(canvas.pen(canvas.palette.waypoint, 2.0))
        painter.drawEllipse(place, 5.0 * canvas.unit, 5.0 * canvas.unit)
        painter.drawLine(place, canvas.at(self.pose.apply((_LENGTH_M / 2.0, 0.0))))


class RobotLayer(Layer):
    """Attributes: pose: None while it is not known. key: the key in base_link. sigma_m: of the position.

    is_stale: that was a while ago, and where the robot is now nobody knows; it is painted hollow.
    """

    is_moving = True

    def __init__(self) -> None:
        self.pose: Pose | None = None
        self.key: Point = (0.0, 0.0)
        self.sigma_m = math.nan
        self.is_stale = False

    def points(self) -> Sequence[Point]:
        """See Layer."""
        return () if self.pose is None else ((self.pose.x, self.pose.y),)

    def extent(self, viewport: Viewport) -> QRectF:
        """See Layer: the robot with its key and its haze."""
        if self.pose is None:
            return QRectF()
        far_m = max(_REACH_M + math.hypot(*self.key), 2.0 * self.sigma_m if self.sigma_m == self.sigma_m else 0.0)
        far = far_m * viewport.px_per_m + _EDGE_PX
        return QRectF(-far, -far, 2.0 * far, 2.0 * far).translated(*viewport.to_screen((self.pose.x, self.pose.y)))

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        if self.pose is not None:
            self._paint_robot(canvas, self.pose)

    def _paint_robot(self, canvas: Canvas, pose: Pose) -> None:
        painter, palette = canvas.painter, canvas.palette
        place = canvas.at((pose.x, pose.y))
        if self.sigma_m == self.sigma_m:
            haze = QColor(palette.robot)
            haze.setAlphaF(_SIGMA_ALPHA)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(haze)
            radius = 2.0 * self.sigma_m * canvas.viewport.px_per_m
            painter.drawEllipse(place, radius, radius)
        if self.is_stale:
            painter.setPen(canvas.pen(palette.ink_soft, 1.8, Qt.PenStyle.DashLine))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawPolygon(canvas.polygon(_outline(pose)))
            return
        painter.setPen(canvas.pen(palette.ink, 1.8))
        painter.setBrush(QColor(palette.robot))
        painter.drawPolygon(canvas.polygon(_outline(pose)))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(palette.robot_mark))
        tip, back = 0.42 * _LENGTH_M, -0.1 * _LENGTH_M
        painter.drawPolygon(canvas.polygon([pose.apply((tip, 0.0)), pose.apply((back, 0.14)),
                                            pose.apply((back, -0.14))]))
        key: QPointF = canvas.at(pose.apply(self.key))
        painter.setPen(canvas.pen(palette.surface, 1.5))
        painter.setBrush(QColor(palette.key))
        painter.drawEllipse(key, _KEY_RADIUS_PX * canvas.unit, _KEY_RADIUS_PX * canvas.unit)


class TrailLayer(Layer):
    """Attributes: places: where the robot has been; None is a gap, across which nothing is painted."""

    def __init__(self) -> None:
        self.places: Sequence[Point | None] = ()
        self._painted = 0

    @property
    def has_news(self) -> bool:
        """True when places were added that are not painted yet."""
        return len(self.places) != self._painted

    def paint(self, canvas: Canvas) -> None:
        """See Layer."""
        self._painted = 0
        self.paint_added(canvas)

    def paint_added(self, canvas: Canvas) -> None:
        """See Layer."""
        added = self.places[max(self._painted - 1, 0):]
        self._painted = len(self.places)
        pen = canvas.pen(canvas.palette.trail, 1.5)
        # Round joins of thousands of pieces take a whole frame.
        pen.setJoinStyle(Qt.PenJoinStyle.BevelJoin)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        canvas.painter.setPen(pen)
        for piece in pieces(added):
            canvas.painter.drawPolyline(canvas.many(piece))


def pieces(places: Sequence[Point | None]) -> Iterator[list[Point]]:
    """The pieces between the gaps."""
    for is_gap, group in itertools.groupby(places, lambda place: place is None):
        if not is_gap:
            yield [place for place in group if place is not None]


def _outline(pose: Pose) -> list[Point]:
    half_length, half_width = _LENGTH_M / 2.0, _WIDTH_M / 2.0
    return [pose.apply(corner) for corner in ((half_length, half_width), (half_length, -half_width),
                                              (-half_length, -half_width), (-half_length, half_width))]
