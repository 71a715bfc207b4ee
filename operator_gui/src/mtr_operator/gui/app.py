"""The application with its window: makes the parts, connects them, and runs until the window is closed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import pathlib
import signal
from typing import Any, Callable, Mapping, TypeVar

from PyQt5.QtCore import QRect, Qt, QTimer
from PyQt5.QtGui import QGuiApplication, QIcon
from PyQt5.QtWidgets import QApplication, QWidget

from mtr_operator.station.connection import CanChoice, Connection, LinkOpener
from mtr_operator.station.settings_file import SettingsStore, default_path, former_path
from mtr_operator.station.view_model import ViewModel

from .alerts.sounds import Sounds
from .bridge import Bridge
from .defects import Defects
from .fitting.screen_watch import ScreenWatch
from .flow import Flow
from .header.stop_button import add_stop
from .i18n import Language
from .stopping import Stopping
from .theme.appearance import Appearance
from .theme.sheet import ICON
from .threads.waited_thread import WaitedThread
from .windows.connection_window import ConnectionWindow
from .windows.main_window import MainWindow

NAME = "mtr-operator"
_Window = TypeVar("_Window", bound=QWidget)


class Application:
    """Attributes: flow, stopping, appearance, language; window: the one that is shown."""

    def __init__(self, settings_path: pathlib.Path | None = None, opener: LinkOpener | None = None):
        self._store = SettingsStore(settings_path) if settings_path else SettingsStore(default_path(), former_path())
        self.bridge = Bridge(ViewModel())
        self.flow = Flow(self.bridge, self._store, opener or LinkOpener())
        self.stopping = Stopping(self.flow)
        self.stopping.dialog_opens.connect(lambda dialog: add_stop(dialog, self.stopping))
        self.sounds = Sounds(self.flow)
        self.appearance = Appearance()
        self.language = Language()
        self.screens = ScreenWatch()
        self.defects = Defects()
        self.defects.found.connect(self.flow.keep_after_defect)
        self.window: QWidget | None = None

    def open(self, robot: Mapping[str, Any] | None = None, can: Mapping[str, Any] | None = None) -> None:
        """Load the settings and show the connection window; robot, can: what to fill in instead of the last choice."""
        self.defects.install()
        self.stopping.install()
        self.screens.install()
        self._store.load()
        settings = self._store.settings
        self.language.use(settings.language)
        with self.stopping.building():
            self.appearance.use(settings.theme)
        self.bridge.start()
        self.flow.connecting.connected.connect(self._show_main)
        self.flow.language_changed.connect(self._speak)
        filled_in = _filled_in(settings.connection, robot or {}, can or {})
        self._show(lambda: ConnectionWindow(self.flow, filled_in))

    def close(self) -> None:
        """Stop the robot, and disconnect."""
        if self.window is not None:
            self.window.hide()
        self.flow.close()
        self.stopping.remove()
        self.screens.remove()
        WaitedThread.finish_all()
        self.defects.remove()

    def _show_main(self) -> None:
        self._show(self._made_main)

    def _made_main(self) -> MainWindow:
        return MainWindow(self.flow, self.appearance, self.stopping)

    def _speak(self, code: str) -> None:
        """Windows are made anew in another language; later, for the one at hand has asked for it."""
        self.language.use(code)
        QTimer.singleShot(0, self._renew)

    def _renew(self) -> None:
        former = self.window
        if isinstance(former, ConnectionWindow):
            self._show(lambda: ConnectionWindow(self.flow, former.typed), former.geometry())
        elif isinstance(former, MainWindow):
            self._show(self._made_main, former.geometry()).show_settings()

    def _show(self, make: Callable[[], _Window], place: QRect | None = None) -> _Window:
        """Make a window and show it instead of the former one; at its place, None for where it opens by itself."""
        with self.stopping.building():
            window = make()
            if place is not None:
                window.setGeometry(place)
            former, self.window = self.window, window
            window.show()
        if former is not None:
            former.hide()
            former.deleteLater()
        return window


def _filled_in(connection: Connection, robot: Mapping[str, Any], can: Mapping[str, Any]) -> Connection:
    former = connection.can or CanChoice("slcan")
    return Connection(dataclasses.replace(connection.robot, **robot),
                      dataclasses.replace(former, **can) if can else connection.can)


def make_qt() -> QApplication:
    """The Qt application; there is one per process."""
    QGuiApplication.setAttribute(Qt.ApplicationAttribute.AA_EnableHighDpiScaling)
    QGuiApplication.setAttribute(Qt.ApplicationAttribute.AA_UseHighDpiPixmaps)
    app = QApplication([NAME])
    app.setApplicationName(NAME)
    app.setStyle("Fusion")
    app.setWindowIcon(QIcon(str(ICON)))
    # By which a desktop finds the entry of its menu, and so groups the windows.
    app.setDesktopFileName(NAME)
    return app


def run(robot: Mapping[str, Any], can: Mapping[str, Any], car_seed: int = 1) -> int:
    """Run the window until it is closed; the exit code. car_seed: which Car the substitute of the Car is."""
    app = make_qt()
    # Python sees Ctrl-C only when Qt lets it run; the heartbeat does.
    signal.signal(signal.SIGINT, lambda *_: app.quit())
    application = Application(opener=LinkOpener(car_seed=car_seed))
    application.open(robot, can)
    status = app.exec_()
    application.close()
    return status
