"""How the window is started."""
# SPDX-License-Identifier: Apache-2.0
import configparser
import os
import pathlib
import subprocess
import sys

import pytest
from PyQt5.QtCore import QEvent, QObject
from PyQt5.QtGui import QIcon
from PyQt5.QtWidgets import QApplication, QWidget

from mtr_operator.cli import main
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.app import NAME
from mtr_operator.gui.theme.sheet import ICON
from mtr_operator.gui.windows.calibration_window import CalibrationWindow
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.station.connection import CanChoice


@pytest.fixture
def started(monkeypatch):
    calls = []
    monkeypatch.setattr("mtr_operator.gui.app.run", lambda robot, can: calls.append((robot, can)) or 0)
    return calls


def test_no_command_opens_the_window(started):
    assert main([]) == 0
    assert started == [({}, {})]


def test_window_takes_what_is_given(started):
    assert main(["window", "--robot", "10.0.0.7", "--publisher-port", "5", "--can-interface", "socketcan",
                 "--can-channel", "can0", "--can-bitrate", "250000"]) == 0
    assert started == [({"host": "10.0.0.7", "publisher_port": 5},
                        {"interface": "socketcan", "channel": "can0", "bitrate_bps": 250000})]


def test_given_values_are_filled_in(start):
    application = start()
    application.open({"host": "10.0.0.7"}, {"channel": "/dev/ttyACM3"})
    window = application.window
    assert (window.robot.host.text, window.robot.subscriber_port.text) == ("10.0.0.7", "3334")
    assert window.can.choice == CanChoice("slcan", "/dev/ttyACM3")


class Windows(QObject):
    """Attributes: shown: classes of the windows that were shown."""

    def __init__(self):
        super().__init__()
        self.shown = set()
        QApplication.instance().installEventFilter(self)

    def eventFilter(self, watched, event):
        if event.type() == QEvent.Show and isinstance(watched, QWidget) and watched.isWindow():
            self.shown.add(type(watched))
        return False


def test_no_part_of_a_window_flashes_up_as_a_window_of_its_own(operator):
    windows, window = Windows(), operator.window
    for name in SCENARIOS:
        assert window.settings[name].start.text()
    for open_window in (window.welcome.calibrate.emit, window.show_settings, window.welcome.history.emit):
        open_window()
    assert windows.shown == {CalibrationWindow, SettingsWindow}


@pytest.mark.parametrize("command", [[], ["window"]])
def test_no_display_is_one_sentence_and_exit_code_2__B17(command):
    environment = {name: value for name, value in os.environ.items()
                   if name not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    done = subprocess.run([sys.executable, "-m", "mtr_operator", *command], capture_output=True, text=True, check=False,
                          env={**environment, "PYTHONPATH": os.pathsep.join(sys.path)})
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1), done.stderr
    assert done.stderr.startswith("There is no display for the window")


def test_missing_qt_is_one_sentence():
    # In a process of its own: modules imported a second time would stay in their packages for the tests that follow.
    start = "import sys; sys.modules['PyQt5'] = None; from mtr_operator.cli import main; sys.exit(main([]))"
    ended = subprocess.run([sys.executable, "-c", start], capture_output=True, text=True, timeout=60.0, check=False)
    assert ended.returncode == 2
    assert ended.stderr.startswith("The window needs PyQt5") and ended.stderr.count("\n") == 1


def test_windows_have_an_icon_and_the_menu_an_entry(qapp):
    seen = QIcon(str(ICON)).pixmap(64, 64).toImage()
    assert {seen.pixelColor(*place).name() for place in ((16, 36), (51, 31), (5, 32))} == {
        "#ffffff", "#f5a800", "#0b57a4"}
    entry = configparser.ConfigParser(interpolation=None)
    entry.read(pathlib.Path(__file__).parents[2] / "mtr-operator.desktop", encoding="utf-8")
    assert (entry["Desktop Entry"]["Exec"], entry["Desktop Entry"]["Icon"]) == (NAME, NAME)
