"""A picture with its tools: zoom, everything, ruler."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import Qt
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from ..i18n import number
from ..theme.appearance import Appearance
from ..theme.scale import S
from .legend import LegendStrip
from .picture_view import ZOOM_STEP, PictureView


class PicturePanel(QWidget):
    """Attributes: legend: what its markers mean. view: the picture. ruler: button that turns dragging into measuring.

    length: what was measured.
    """

    def __init__(self, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.legend = LegendStrip(appearance)
        self.view = PictureView(appearance)
        self.ruler = self._tool(self.tr("Ruler"), self.tr("Ruler: drag from one place to another (R)"))
        self.ruler.setCheckable(True)
        self.ruler.setShortcut(Qt.Key.Key_R)
        self.ruler.toggled.connect(self.view.measure)
        self.length = QLabel()
        self.length.setProperty("role", "soft")
        self.view.measured.connect(self._show_length)
        row = QHBoxLayout()
        row.setSpacing(S)
        for text, hint, act in (("+", self.tr("Zoom in"), lambda: self.view.zoom(ZOOM_STEP)),
                                ("\N{MINUS SIGN}", self.tr("Zoom out"), lambda: self.view.zoom(1.0 / ZOOM_STEP)),
                                (self.tr("Show all"), self.tr("Show all"), self.view.fit)):
            button = self._tool(text, hint)
            button.clicked.connect(lambda _checked, act=act: act())
            row.addWidget(button)
        row.addWidget(self.ruler)
        row.addWidget(self.length)
        row.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(S)
        layout.addWidget(self.legend)
        layout.addWidget(self.view, 1)
        layout.addLayout(row)

    @staticmethod
    def _tool(text: str, hint: str) -> QPushButton:
        button = QPushButton(text)
        button.setProperty("role", "tool")
        button.setAccessibleName(hint)
        button.setToolTip(hint)
        return button

    def _show_length(self) -> None:
        length_m = self.view.ruler.length_m
        self.length.setText("" if length_m is None else f"{number(length_m, 2)} m")
