"""Windows come back into sight when their screen is unplugged, turned or made smaller."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QObject, Qt, QTimer
from PyQt5.QtGui import QGuiApplication, QScreen
from PyQt5.QtWidgets import QApplication, QWidget

from . import place

# The system moves windows itself first, one after the other.
_SETTLE_MS = 200
_OWN_PLACE = (Qt.WindowType.Popup, Qt.WindowType.ToolTip)


class ScreenWatch(QObject):
    """Looks after all windows from install() to remove(); nothing else is disturbed: a test goes on."""

    def __init__(self) -> None:
        super().__init__()
        self._settling = QTimer(self)
        self._settling.setSingleShot(True)
        self._settling.setInterval(_SETTLE_MS)
        self._settling.timeout.connect(self.bring_back)
        self._looks = False

    def install(self) -> None:
        """Begin to look."""
        self._looks = True
        app = _application()
        for signal in (app.screenAdded, app.screenRemoved, app.primaryScreenChanged):
            signal.connect(self._learn)
        app.screenAdded.connect(self._watch)
        for screen in app.screens():
            self._watch(screen)

    def remove(self) -> None:
        """End; safe to call twice."""
        if not self._looks:
            return
        self._looks = False
        app = _application()
        for signal in (app.screenAdded, app.screenRemoved, app.primaryScreenChanged):
            signal.disconnect(self._learn)
        app.screenAdded.disconnect(self._watch)
        for screen in app.screens():
            screen.availableGeometryChanged.disconnect(self._learn)
        self._settling.stop()

    @staticmethod
    def bring_back() -> None:
        """Bring each window that is not wholly on a screen back to one, smaller if need be."""
        for window in QApplication.topLevelWidgets():
            if window.isVisible() and window.windowType() not in _OWN_PLACE and not _is_in_sight(window):
                place.open_within(window, window.size())

    def _watch(self, screen: QScreen) -> None:
        screen.availableGeometryChanged.connect(self._learn)

    def _learn(self) -> None:
        self._settling.start()


def _application() -> QGuiApplication:
    app = QGuiApplication.instance()
    if not isinstance(app, QGuiApplication):
        raise RuntimeError("there is no Qt application yet")
    return app


def _is_in_sight(window: QWidget) -> bool:
    return place.available(window).contains(window.frameGeometry())
