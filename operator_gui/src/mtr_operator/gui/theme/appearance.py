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
        """Apply "light", "dark", "contrast", or what the system prefers."""
        app = QApplication.instance()
        if not isinstance(app, QApplication):
            raise RuntimeError("there is no Qt application yet")
        name = _system_theme(app) if theme == "system" else theme
        self.palette = THEMES[name]
        app.setPalette(_qt_palette(self.palette))
        app.setStyleSheet(style_sheet(name, self.palette))
        self.changed.emit()


def _system_theme(app: QApplication) -> str:
    window = app.style().standardPalette().color(QPalette.ColorRole.Window)
    return "dark" if window.lightness() < _MIDDLE_LIGHTNESS else "light"


def _qt_palette(palette: Palette) -> QPalette:
    colours = QPalette()
    role = QPalette.ColorRole
    for place, colour in ((role.Window, palette.window), (role.WindowText, palette.ink), (role.Base, palette.surface),
                          (role.AlternateBase, palette.window), (role.Text, palette.ink), (role.Button, palette.raised),
                          (role.ButtonText, palette.ink), (role.Highlight, palette.accent),
                          (role.HighlightedText, palette.on_accent), (role.PlaceholderText, palette.ink_soft),
                          (role.ToolTipBase, palette.ink), (role.ToolTipText, palette.surface)):
        colours.setColor(place, QColor(colour))
    return colours
