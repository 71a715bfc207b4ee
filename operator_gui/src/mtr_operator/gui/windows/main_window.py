"""The main window: header bar, and below it one screen at a time."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib
from typing import TYPE_CHECKING, Callable

from PyQt5.QtCore import QSize, Qt
from PyQt5.QtGui import QCloseEvent
from PyQt5.QtWidgets import QDialog, QMainWindow, QStackedWidget, QVBoxLayout, QWidget

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.history.line_pairs import Side
from mtr_operator.history.statistics.comparison import Comparison
from mtr_operator.station.readiness import RUNNING
from mtr_operator.station.test import Test

from ..area.area_window import AreaWindow
from ..bus.bus_window import BusWindow
from ..calibration.guide_window import GuideWindow
from ..dialogs import after_delivery, ask_folder, ask_progress_file, confirm, show_message
from ..events.event_window import EventWindow
from ..fitting.place import open_within
from ..flow import Flow, Step
from ..header.header_bar import HeaderBar
from ..history.comparison_window import ComparisonWindow
from ..history.history_screen import HistoryScreen
from ..history.replay_window import ReplayWindow
from ..history.spread_window import SpreadWindow
from ..screens.measurement import MeasurementScreen
from ..screens.measurement_type import MeasurementTypeScreen
from ..screens.protocol import ProtocolScreen
from ..screens.settings import SettingsScreen
from ..screens.welcome import WelcomeScreen
from ..sentences import translated
from ..stopping import Stopping
from ..theme.appearance import Appearance
from .calibration_window import CalibrationWindow
from .settings_window import SettingsWindow

if TYPE_CHECKING:
    from mtr_operator.history.spread import TestSpread
    from mtr_operator.replay.replay import ReplayedTest

_SIZE = QSize(1360, 860)


class _MadeOnDemand(dict[str, SettingsScreen]):
    """Screens by scenario: a form of many fields costs a tenth of a second, and most tests need one."""

    def __init__(self, make: Callable[[str], SettingsScreen]):
        super().__init__()
        self._make = make

    def __missing__(self, name: str) -> SettingsScreen:
        self[name] = self._make(name)
        return self[name]


class MainWindow(QMainWindow):
    """Attributes: header; welcome, types, settings (by scenario, made when asked for), measurement, protocol, history:
    the screens."""

    def __init__(self, flow: Flow, appearance: Appearance, stopping: Stopping):
        super().__init__()
        self.setWindowTitle(self.tr("Mobile testing robot"))
        self._flow = flow
        self._appearance = appearance
        self._stopping = stopping
        self._opened: dict[type[QDialog], QDialog] = {}
        self._is_asked = False
        self.header = HeaderBar(appearance, stopping)
        self.welcome = WelcomeScreen()
        self.types = MeasurementTypeScreen(SCENARIOS)
        self.settings = _MadeOnDemand(self._settings_screen)
        self.measurement = MeasurementScreen(flow.model, appearance)
        self.protocol = ProtocolScreen(flow, appearance)
        self._screens = QStackedWidget()
        page = QWidget()
        page.setObjectName("page")
        # From the window inwards: each change of parent styles all that is inside anew.
        self.setCentralWidget(page)
        layout = QVBoxLayout(page)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.header)
        layout.addWidget(self._screens, 1)
        for screen in (self.welcome, self.types, self.measurement, self.protocol):
            self._screens.addWidget(screen)
        open_within(self, _SIZE)
        self._connect()
        self._show_step(flow.step)

    @property
    def screen(self) -> QWidget:
        """What is shown below the header."""
        return self._screens.currentWidget()

    def show_settings(self) -> None:
        """Open the settings window, or show the one that is open."""
        self._open_beside(SettingsWindow, lambda: SettingsWindow(self._flow, self._appearance, self))

    def _show_calibration(self) -> None:
        self._open_beside(CalibrationWindow, self._make_calibration)

    def _make_calibration(self) -> CalibrationWindow:
        window = CalibrationWindow(self._flow, self)
        window.guide_wanted.connect(self._show_guide)
        return window

    def _show_guide(self) -> None:
        self._open_beside(GuideWindow, lambda: GuideWindow(self._flow, self))

    def _show_area(self) -> None:
        self._open_beside(AreaWindow, lambda: AreaWindow(self._flow, self._appearance, self))

    def _show_bus(self) -> None:
        self._open_beside(BusWindow, lambda: BusWindow(self._flow, self._appearance, self))

    def _show_events(self) -> None:
        self._open_beside(EventWindow, lambda: EventWindow(self._flow, self._appearance, self))

    def _open_beside(self, kind: type[QDialog], make: Callable[[], QDialog]) -> None:
        """Open a window of a kind, or show the one that is open; this one stays alive, and its Stop."""
        dialog = self._opened.get(kind)
        if dialog is None:
            dialog = self._opened[kind] = make()
            dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
            dialog.finished.connect(lambda _: self._forget(kind))
        dialog.show()
        dialog.raise_()
        dialog.activateWindow()

    def _forget(self, kind: type[QDialog]) -> None:
        self._opened.pop(kind, None)

    def _connect(self) -> None:
        flow = self._flow
        flow.bridge.changed.connect(self._show_model)
        flow.step_changed.connect(self._show_step)
        # No lambdas: they would outlive the window, which is made anew in another language.
        flow.failed.connect(self._tell)
        flow.saved.connect(self._say_saved)
        flow.folder_wanted.connect(self._want_progress_folder)
        self.header.settings_wanted.connect(self.show_settings)
        self.header.bus_wanted.connect(self._show_bus)
        self.header.presence.confirmed.connect(flow.confirm_presence)
        self.header.status.events_wanted.connect(self._show_events)
        self.measurement.events_wanted.connect(self._show_events)
        self.welcome.new_test.connect(lambda: flow.show(Step.TYPE))
        self.welcome.history.connect(self._show_history)
        self.welcome.calibrate.connect(self._show_calibration)
        self.welcome.area.connect(self._show_area)
        self.welcome.go_on.connect(flow.open_unfinished)
        self.welcome.dismiss.connect(self._dismiss)
        self.types.back.connect(flow.to_welcome)
        self.types.chosen.connect(self._show_settings)
        self.measurement.resume_wanted.connect(flow.resume)
        self.measurement.skip_wanted.connect(flow.skip_line)
        # The robot drives on, and what a key does is to stop it.
        self.measurement.skip_wanted.connect(self.header.stop.setFocus)
        self.measurement.release_wanted.connect(flow.release_hold)
        self.measurement.prompt_answered.connect(flow.answer_prompt)
        self.measurement.save_wanted.connect(flow.save_progress)
        self.measurement.leave_wanted.connect(flow.to_welcome)
        self.measurement.answered.connect(self.header.stop.setFocus)
        self.protocol.closed.connect(flow.to_welcome)

    @functools.cached_property
    def history(self) -> HistoryScreen:
        """The tests so far; made when it is asked for first."""
        with self._stopping.building():
            screen = HistoryScreen()
            self._screens.addWidget(screen)
        screen.closed.connect(self._flow.to_welcome)
        screen.open_wanted.connect(self._flow.open)
        screen.file_wanted.connect(self._open)
        screen.repeat_wanted.connect(self._repeat)
        screen.compare_wanted.connect(self._show_comparison)
        screen.spread_wanted.connect(self._show_spread)
        screen.replayed.connect(self._show_replayed)
        return screen

    def _settings_screen(self, name: str) -> SettingsScreen:
        with self._stopping.building():
            screen = SettingsScreen(SCENARIOS[name], self._flow.model, self._appearance)
            self._screens.addWidget(screen)
        screen.back.connect(lambda: self._flow.show(Step.TYPE))
        screen.started.connect(lambda parameters, paths, who: self._flow.start(
            SCENARIOS[name], parameters, paths, who, screen.conditions.confirmed))
        return screen

    def _show_model(self) -> None:
        self.header.show_model(self._flow.model)
        if isinstance(self.screen, (MeasurementScreen, ProtocolScreen, SettingsScreen)):
            self.screen.show_model()

    def _show_step(self, step: Step) -> None:
        self.header.steps.select(step.value)
        if step is Step.WELCOME:
            self.welcome.offer_unfinished(self._flow.unfinished.offered)
            self.welcome.take_focus()
        elif step is Step.PROTOCOL:
            self.protocol.show_test()
        self._screens.setCurrentWidget({Step.WELCOME: self.welcome, Step.TYPE: self.types,
                                        Step.MEASUREMENT: self.measurement, Step.PROTOCOL: self.protocol}[step])
        self._show_model()

    def _show_settings(self, name: str) -> None:
        screen = self.settings[name]
        settings = self._flow.store.settings
        screen.form.show_mapping(settings.parameters.get(name, {}))
        screen.given.show_paths(settings.given(name))
        screen.identity.propose(self._flow.store)
        self._screens.setCurrentWidget(screen)
        screen.show_model()

    def _show_history(self) -> None:
        settings = self._flow.store.settings
        self.history.read((settings.progress_folder, settings.result_folder))
        self._screens.setCurrentWidget(self.history)
        self.history.search.setFocus()

    def _repeat(self, side: Side) -> None:
        """Offer a new test with the parameters of one of before."""
        if self._flow.is_measuring():
            return
        self._show_settings(side.scenario.name)
        screen = self.settings[side.scenario.name]
        screen.form.show_mapping(side.parameters.to_mapping())
        screen.identity.propose(self._flow.store, side.progress.identity)

    def _show_comparison(self, comparison: Comparison) -> None:
        _show_beside(ComparisonWindow(comparison, self._appearance, self))

    def _show_spread(self, found: TestSpread) -> None:
        _show_beside(SpreadWindow(found, self._appearance, self))

    def _show_replayed(self, name: str, found: ReplayedTest) -> None:
        _show_beside(ReplayWindow(name, found, self))

    def _open(self) -> None:
        path = ask_progress_file(self, self.tr("Open a test"), self._flow.store.settings.progress_folder)
        if path is not None:
            self._flow.open(path)

    def _dismiss(self) -> None:
        self._flow.unfinished.dismiss()
        self.welcome.offer_unfinished(None)

    def _tell(self, text: str) -> None:
        after_delivery(self, lambda: self._show_notice(text))

    def _want_progress_folder(self, test: Test, text: str) -> None:
        after_delivery(self, lambda: self._ask_progress_folder(test, text))

    def _say_saved(self, path: str) -> None:
        self.measurement.say(self.tr("Saved to {path}").format(path=path))

    def _ask_progress_folder(self, test: Test, text: str) -> None:
        show_message(self, self.windowTitle(),
                     translated(text) + " " + self.tr("Choose another folder; nothing is lost."))
        folder = ask_folder(self, self.tr("Folder for the progress of tests"), pathlib.Path.home())
        if folder is not None:
            self._flow.use_progress_folder(test, folder)

    def _show_notice(self, text: str) -> None:
        show_message(self, self.windowTitle(), translated(text))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop the robot first; then ask whether a test that was running is to be left."""
        was_running = self._flow.model.phase in RUNNING
        if self._flow.model.may_move:
            self._flow.stop()
        event.setAccepted(not self._is_asked and (not was_running or self._is_to_be_left()))

    def _is_to_be_left(self) -> bool:
        question = self.tr("The robot is stopped, and the test paused. Close the application? What is measured is "
                           "kept; the next start offers to go on.")
        self._is_asked = True
        try:
            return confirm(self, self.windowTitle(), question, (self.tr("Close"), self.tr("Stay")))
        finally:
            self._is_asked = False


def _show_beside(window: QDialog) -> None:
    """It lives until it is closed."""
    window.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    window.show()
