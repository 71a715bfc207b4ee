"""Shows layers, and lets the Operator zoom, pan and measure with mouse or keyboard."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import QPoint, QRectF, QSize, Qt, pyqtSignal
from PyQt5.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QPixmap, QResizeEvent, QWheelEvent
from PyQt5.QtWidgets import QSizePolicy, QWidget

from mtr_operator.domain.geometry.pose import Point

from ..theme.appearance import Appearance
from .layers.layer import Canvas, Layer, paint_all
from .layers.ruler_layer import RulerLayer
from .viewport import Viewport

ZOOM_STEP = 1.25
_WHEEL_STEP_DEG8 = 120.0
_PAN_PX = 60.0
_MARGIN_PX = 44.0


class PictureView(QWidget):
    """Layers that do not move are painted once into a pixmap, and brief ones over it into another.

    Attributes:
        layers: what is painted, the first one lowest. viewport: what is seen.
        ruler: the ruler's layer. is_measuring: a drag measures and does not pan.
        still_paints: how often the first pixmap was painted.
    Signals:
        clicked(x, y): a place of the Car coordinate system. measured: the ruler is another one.
    """

    clicked = pyqtSignal(float, float)
    measured = pyqtSignal()

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._appearance = appearance
        self.layers: tuple[Layer, ...] = ()
        self._still: QPixmap | None = None
        self._brief: QPixmap | None = None
        self._extents: dict[Layer, QRectF] = {}
        self._is_fitted = True
        self._pressed: QPoint | None = None
        self._dragged: QPoint | None = None
        self.viewport = Viewport(400.0, 400.0)
        self.ruler = RulerLayer()
        self.is_measuring = False
        self.still_paints = 0
        # All of it is painted: what lies below need not be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Car and robot from above; plus and minus zoom, arrows move the picture"))
        appearance.changed.connect(self.refresh)

    def sizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(560, 560)

    def minimumSizeHint(self) -> QSize:
        """See QWidget."""
        return QSize(280, 280)

    def show_layers(self, layers: Sequence[Layer]) -> None:
        """Show these, the first one lowest."""
        self.layers = tuple(layers)
        self.refresh()

    def refresh(self) -> None:
        """A layer that does not move has changed."""
        self._still = None
        if self._is_fitted:
            self._fit()
        self.update()

    def refresh_brief(self) -> None:
        """A brief layer has changed."""
        self._brief = None
        self.update()

    def move_layer(self, layer: Layer) -> None:
        """A layer that moves is elsewhere, and nothing else has changed."""
        now = layer.extent(self.viewport)
        self.update(now.united(self._extents.get(layer, now)).toAlignedRect())

    def add_news(self, layer: Layer) -> None:
        """Something was added to a layer that does not move; the rest is not painted anew."""
        self._brief = None
        if self._still is not None:
            painter = QPainter(self._still)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            layer.paint_added(Canvas(painter, self.viewport, self._appearance.palette))
            painter.end()
        self.update()

    def fit(self) -> None:
        """Show everything, and go on doing so."""
        self._is_fitted = True
        self.refresh()

    def zoom(self, factor: float, pixel: Point | None = None) -> None:
        """Zoom around a pixel, by default the middle."""
        self._see(self.viewport.zoomed(factor, pixel or (self.width() / 2.0, self.height() / 2.0)))

    def pan(self, right_px: float, down_px: float) -> None:
        """Move the picture."""
        self._see(self.viewport.panned(right_px, down_px))

    def measure(self, is_measuring: bool) -> None:
        """Let a drag measure; without it the ruler goes away."""
        self.is_measuring = is_measuring
        self.setCursor(Qt.CursorShape.CrossCursor if is_measuring else Qt.CursorShape.ArrowCursor)
        if not is_measuring:
            self.ruler.clear()
            self.measured.emit()
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """See QWidget."""
        if self._still is None:
            self._still, self._brief = self._paint_still(), None
        if self._brief is None:
            self._brief = self._paint_brief(self._still)
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._brief)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        moving = [layer for layer in (*self.layers, self.ruler) if layer.is_moving]
        paint_all(moving, Canvas(painter, self.viewport, self._appearance.palette))
        self._extents = {layer: layer.extent(self.viewport) for layer in moving}
        focus = self._appearance.palette.accent if self.hasFocus() else self._appearance.palette.line
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(focus), 2))
        painter.drawRect(QRectF(self.rect()).adjusted(1, 1, -1, -1))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """See QWidget."""
        self.viewport = self.viewport.resized(event.size().width(), event.size().height())
        self.refresh()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """See QWidget."""
        steps = event.angleDelta().y() / _WHEEL_STEP_DEG8
        self.zoom(ZOOM_STEP ** steps, (event.position().x(), event.position().y()))
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """See QWidget."""
        self._pressed = self._dragged = event.pos()
        if self.is_measuring:
            self.ruler.start = self.ruler.end = self._place(event.pos())
            self.update()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """See QWidget."""
        if self._dragged is None:
            return
        way = event.pos() - self._dragged
        self._dragged = event.pos()
        if self.is_measuring:
            self.ruler.end = self._place(event.pos())
            self.measured.emit()
            self.update()
        else:
            self.pan(way.x(), way.y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """See QWidget."""
        if self._pressed is not None and event.pos() == self._pressed and not self.is_measuring:
            self.clicked.emit(*self._place(event.pos()))
        self._pressed = self._dragged = None

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """See QWidget."""
        key = event.key()
        ways: dict[int, tuple[float, float]] = {
            Qt.Key.Key_Left: (_PAN_PX, 0.0), Qt.Key.Key_Right: (-_PAN_PX, 0.0),
            Qt.Key.Key_Up: (0.0, _PAN_PX), Qt.Key.Key_Down: (0.0, -_PAN_PX)}
        if key in ways:
            self.pan(*ways[key])
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self.zoom(ZOOM_STEP)
        elif key == Qt.Key.Key_Minus:
            self.zoom(1.0 / ZOOM_STEP)
        elif key == Qt.Key.Key_0:
            self.fit()
        else:
            super().keyPressEvent(event)

    def _see(self, viewport: Viewport) -> None:
        self._is_fitted = False
        self.viewport = viewport
        self._still = None
        self.update()

    def _fit(self) -> None:
        points = [point for layer in self.layers if _is_still(layer) for point in layer.points()]
        self.viewport = self.viewport.fitted(points, _MARGIN_PX)

    def _place(self, pixel: QPoint) -> Point:
        return self.viewport.to_car((pixel.x(), pixel.y()))

    def _paint_still(self) -> QPixmap:
        self.still_paints += 1
        ratio = self.devicePixelRatioF()
        pixmap = QPixmap(self.size() * ratio)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(QColor(self._appearance.palette.surface))
        self._paint_into(pixmap, [layer for layer in self.layers if _is_still(layer)])
        return pixmap

    def _paint_brief(self, still: QPixmap) -> QPixmap:
        """Still and brief layers; the still ones themselves where there are no others."""
        brief = [layer for layer in self.layers if layer.is_brief and layer.is_visible]
        if not brief:
            return still
        pixmap = QPixmap(still)
        self._paint_into(pixmap, brief)
        return pixmap

    def _paint_into(self, pixmap: QPixmap, layers: Sequence[Layer]) -> None:
        painter = QPainter(pixmap)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(self.font())
        paint_all(layers, Canvas(painter, self.viewport, self._appearance.palette))
        painter.end()


def _is_still(layer: Layer) -> bool:
    return not layer.is_moving and not layer.is_brief
