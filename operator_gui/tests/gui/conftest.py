"""The application on an offscreen screen, with the robot's fake and a Car that reacts to the key's place."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import os
import threading

os.environ["QT_QPA_PLATFORM"] = "offscreen"

import pytest
from earlier_tests import lab  # noqa: F401
from fit_checks import application_in_a_language, main_window, show_for_a_test  # noqa: F401
from PyQt5 import sip
from PyQt5.QtCore import QCoreApplication, QEvent, Qt, QTimer
from PyQt5.QtTest import QTest

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.interfaces.car_bus import BusMonitor
from mtr_operator.domain.ports import CarEvent, CarLink, LockState
from mtr_operator.gui import dialogs
from mtr_operator.gui.app import Application
from mtr_operator.gui.forms.hold_button import HoldButton
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.robot_link.virtual.robot import VirtualRobot, VirtualWorld
from mtr_operator.station.connection import SIMULATED, CanChoice, LinkOpener

TIME_FACTOR = 150.0
WORLD = VirtualWorld()
UNLOCK_M, LOCK_M, PRESS_M = 1.5, 2.2, 5.2
# Ends tests that hang; on a machine with a load of 24 a test of seconds takes minutes.
LIMIT_MS = 150_000


class KeyCar(CarLink, BusMonitor):
    """Unlocks when the key is near, locks when it goes away; obeys buttons within a distance from its centre."""

    def __init__(self, opener):
        self._opener = opener
        self._state = LockState.LOCKED
        self._answered = 0

    def connect(self):
        if self._opener.car_refusal:
            raise ConnectionFailed(self._opener.car_refusal)

    def observe(self, status):
        if not status.pose_valid:
            return []
        key_x = status.x + status.key_x * math.cos(status.heading)
        key_y = status.y + status.key_x * math.sin(status.heading)
        gap_m = math.hypot(max(abs(key_x) - WORLD.car_length_m / 2, 0.0), max(abs(key_y) - WORLD.car_width_m / 2, 0.0))
        wanted = self._state
        if self._opener.passive and gap_m < UNLOCK_M:
            wanted = LockState.UNLOCKED
        elif self._opener.passive and gap_m > LOCK_M:
            wanted = LockState.LOCKED
        if self._opener.handle_taken.is_set():
            # Once: a Car that went on to unlock by itself would unlock after it was locked again, too.
            self._opener.handle_taken.clear()
            wanted = LockState.UNLOCKED
        for press in status.presses:
            if press.start_s > self._answered:
                self._answered = press.start_s
                if math.hypot(key_x, key_y) < PRESS_M:
                    wanted = LockState.UNLOCKED if self._state is LockState.LOCKED else LockState.LOCKED
        if wanted is self._state:
            return []
        self._state = wanted
        return [CarEvent(status.stamp_s, 0.005, wanted)]

    @property
    def lock_state(self):
        return LockState.UNKNOWN if self.problem else self._state

    @property
    def problem(self):
        return self._opener.car_problem

    def close(self):
        pass


class Spoilt(FakeRobotLink):
    """Fake whose Statuses the test may change or lose."""

    def __init__(self, opener, **arguments):
        super().__init__(**arguments)
        self._opener = opener

    def connect(self):
        self._opener.connecting.wait(10.0)
        if self._opener.robot_refusal:
            raise ConnectionFailed(self._opener.robot_refusal)
        super().connect()

    def next_status(self, timeout_s):
        status = super().next_status(timeout_s)
        return None if self._opener.is_silent else self._opener.spoil(status)

    def send(self, desired):
        self._opener.sent.append(desired)
        super().send(desired)


class FakeOpener(LinkOpener):
    """Opens fakes.

    Attributes:
        robot_refusal, car_refusal: why a link cannot be opened. is_silent: the robot says nothing any more.
        car_problem: sentence of the Car's bus. spoil: changes a Status. passive: the Car reacts to the key's vicinity.
        handle_taken: set when a person takes the Car's handle, once; the Car unlocks and clears it.
        sent: desired states. connecting: while it is clear, connecting takes time.
    """

    def __init__(self):
        self.robot_refusal = self.car_refusal = self.car_problem = ""
        self.is_silent = self.passive = False
        self.handle_taken = threading.Event()
        self.spoil = lambda status: status
        self.sent = []
        self.connecting = threading.Event()
        self.connecting.set()
        self._robot = VirtualRobot(1, WORLD)
        self._sessions = 0

    def robot(self, choice):
        self._sessions += 1
        return Spoilt(self, time_factor=TIME_FACTOR, robot=self._robot, session_id=self._sessions)

    def car(self, choice):
        return AbsentCarLink() if choice is None else KeyCar(self)

    def spoil_with(self, **changes):
        """Change each Status from now on."""
        self.spoil = lambda status: dataclasses.replace(status, **changes)


@pytest.fixture(autouse=True)
def short_hold(monkeypatch):
    """Nobody has to hold a button for long."""
    monkeypatch.setattr(HoldButton, "HOLD_MS", 20)


@pytest.fixture(autouse=True)
def busy_machine(monkeypatch):
    """A window of a test shares its processor with other tests: one that hangs is a test of its own."""
    monkeypatch.setattr("mtr_operator.station.links.attention.LIMIT_S", 30.0)


@pytest.fixture(autouse=True)
def no_leftovers(qapp):
    """Widgets that are left over would be styled anew by the style sheet of each later test."""
    yield
    QCoreApplication.sendPostedEvents(None, QEvent.DeferredDelete)


@pytest.fixture(autouse=True)
def unanswered_dialogs_end(monkeypatch):
    """Within a dialog the time limit of a test is not heard; one that nobody answers would hold all tests up."""
    run = dialogs._run

    def run_for_a_while(dialog):
        timer = QTimer(dialog)
        timer.timeout.connect(dialog.reject)
        timer.start(LIMIT_MS)
        return run(dialog)
    monkeypatch.setattr(dialogs, "_run", run_for_a_while)


@pytest.fixture(autouse=True)
def own_cache(monkeypatch, tmp_path):
    """The list of tests is kept with the test."""
    monkeypatch.setattr("mtr_operator.gui.history.history_screen.cache_path", lambda _: tmp_path / "history_cache.json")


@pytest.fixture
def opener():
    """Links of the application."""
    return FakeOpener()


@pytest.fixture
def settings_path(tmp_path):
    """File of the settings."""
    return tmp_path / "settings.json"


@pytest.fixture
def start(qtbot, opener, settings_path, tmp_path):
    """start() opens the application with its connection window; it is closed after the test."""
    started = []

    def begin():
        application = Application(settings_path, opener)
        started.append(application)
        application.open()
        application.language.use("en")
        store = application.flow.store
        if not settings_path.exists():
            store.settings = dataclasses.replace(store.settings, result_folder=tmp_path / "results",
                                                 progress_folder=tmp_path / "progress")
        return application
    yield begin
    for application in started:
        application.language.use("en")
        application.close()
        application.window.deleteLater()


class Operator:
    """Does with the window what a person does.

    Attributes:
        application, bot: as given. folder: where files go.
    """

    def __init__(self, application, bot, folder):
        self.application, self.bot, self.folder = application, bot, folder

    @property
    def window(self):
        return self.application.window

    @property
    def model(self):
        return self.application.flow.model

    def connect(self):
        """Connect with the simulated Car, and wait for the main window."""
        window = self.window
        window.can.interface.setCurrentIndex(window.can.interface.findData(SIMULATED))
        self.click(window.button)
        self.wait(lambda: self.window is not window and self.model.robot is not None)
        # Only then nothing takes the focus from what is held: this screen has no window manager.
        self.wait(lambda: sip.isdeleted(window))
        self.window.activateWindow()
        self.wait(self.window.isActiveWindow)
        return self

    def click(self, button):
        """Click a button once it is enabled, or hold it where the button requires that."""
        # On a busy machine the robot may count as silent for a moment, which disables buttons.
        self.wait(button.isEnabled)
        if isinstance(button, HoldButton):
            self.hold(button)
        else:
            self.bot.mouseClick(button, Qt.LeftButton)

    def hold(self, button):
        """Hold a button until it does what it is for."""
        held = []
        button.held.connect(lambda: held.append(button))
        self.bot.mousePress(button, Qt.LeftButton)
        self.wait(lambda: held)
        QTest.mouseRelease(button, Qt.LeftButton)

    def wait(self, condition):
        """Let time pass until the condition holds."""
        try:
            self.bot.waitUntil(lambda: bool(condition()), timeout=LIMIT_MS)
        except self.bot.TimeoutError as error:
            raise AssertionError(f"{self.model.phase} after {LIMIT_MS} ms: {self.model.trouble}") from error

    def choose(self, scenario):
        """Go to the settings screen of a scenario."""
        self.click(self.window.welcome.new)
        self.click(self.window.types.tiles[scenario])
        return self.window.settings[scenario]

    def begin(self, scenario="key_press", **values):
        """Start a short test."""
        screen = self.choose(scenario)
        short = {"angle_between_radials_rad": "90"} if scenario == "key_press" else \
            {"measurements_distance_m": "10", "maximum_distance_m": "3"}
        for name, text in {**short, **values}.items():
            screen.form.fields[name].edit.setText(text)
        self.wait(screen.start.isEnabled)
        self.click(screen.start)
        return self.window.measurement

    def finish(self):
        """Wait for the protocol."""
        self.wait(lambda: self.window.screen is self.window.protocol and self.window.protocol.is_pictured)
        return self.window.protocol


@pytest.fixture
def operator(start, qtbot, tmp_path):
    """A person at the main window, connected to the fakes."""
    return Operator(start(), qtbot, tmp_path).connect()


@pytest.fixture
def protocol(operator, opener):
    """The protocol screen of a finished Autolock test on 8 axes."""
    opener.passive = True
    operator.begin("autolock")
    return operator.finish()


@pytest.fixture
def newcomer(start, qtbot, tmp_path):
    """A person at the connection window."""
    return Operator(start(), qtbot, tmp_path)


@pytest.fixture
def can_choice():
    """The simulated Car."""
    return CanChoice(SIMULATED)
