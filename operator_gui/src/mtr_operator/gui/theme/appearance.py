"""The theme in use: applied to the whole application, and asked by whatever paints itself."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QObject, pyqtSignal
from PyQt5.QtGui import QColor, QPalette
from PyQt5.QtWidgets import QApplication

from .palette import LIGHT, THEMES, Palette
from .sheet import style_sheet

_MIDDLE_LIGHTNESS = 128


class Appearance(QObject):
    """One per application.

    Attributes:
        palette: colours in use.
    Signals:
        changed: other colours are in use now.
    """

    changed = pyqtSignal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.palette: Palette = LIGHT

    def use(self, theme: str) -> None:
        """Apply "light", "dark", or what the system prefers."""
        app = QApplication.instance()
        name = _system_theme(app) if theme == "system" else theme
        self.palette = THEMES[name]
        app.setPalette(_qt_palette(self.palette))
        app.setStyleSheet(style_sheet(name, self.palette))
        self.changed.emit()


def _system_theme(app: QApplication) -> str:
    window = app.style().standardPalette().color(QPalette.Window)
    return "dark" if window.lightness() < _MIDDLE_LIGHTNESS else "light"


def _qt_palette(palette: Palette) -> QPalette:
    colours = QPalette()
    for role, colour in ((QPalette.Window, palette.window), (QPalette.WindowText, palette.ink),
                         (QPalette.Base, palette.surface), (QPalette.AlternateBase, palette.window),
                         (QPalette.Text, palette.ink), (QPalette.Button, palette.raised),
                         (QPalette.ButtonText, palette.ink), (QPalette.Highlight, palette.accent),
                         (QPalette.HighlightedText, palette.on_accent), (QPalette.PlaceholderText, palette.ink_soft),
                         (QPalette.ToolTipBase, palette.ink), (QPalette.ToolTipText, palette.surface)):
        colours.setColor(role, QColor(colour))
    return colours
