"""Every screen fits every screen: nothing is cut or elided, what has no room scrolls, and Stop is always inside."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import pathlib
import re

import pytest
from PyQt5.QtCore import QCoreApplication, QEvent, QPoint, QRect, QSize
from PyQt5.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QLabel,
    QScrollArea,
    QScrollBar,
    QStyle,
    QStyleOptionComboBox,
    QTableView,
    QWidget,
)

from mtr_operator.domain.identity.identity import TITLES, Identity
from mtr_operator.domain.identity.laboratory import laboratory_from
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarCheck, CarDimensions, Mode, Notification, RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.gui.app import Application
from mtr_operator.gui.fitting import place
from mtr_operator.gui.flow import Step
from mtr_operator.gui.header.step_bar import StepBar
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.header.symbols import BatterySymbol
from mtr_operator.gui.history.comparison_window import ComparisonWindow
from mtr_operator.gui.windows.calibration_window import CalibrationWindow
from mtr_operator.gui.windows.connection_window import ConnectionWindow
from mtr_operator.gui.windows.main_window import MainWindow
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.history.comparison import compare
from mtr_operator.history.entry import TestEntry
from mtr_operator.history.line_pairs import Side
from mtr_operator.station.connection import Connection
from mtr_operator.station.events import ActionBegun, LinesPlanned, RobotSnapshot
from mtr_operator.station.mailbox import Batch
from mtr_operator.station.readiness import Phase
from mtr_operator.station.test import Test

# Free for windows, in pixels of the scale, below a panel of 32 pixels where there is one.
SCREENS = {"1366x768": QSize(1366, 736), "1024x700": QSize(1024, 700), "1280x720 at 1.5": QSize(853, 480),
           "3840x2160 at 2": QSize(1920, 1080)}
# What the main window would like.
WANTED = QSize(1360, 860)
# A row ends at these; the second one has no width.
_BREAKS = re.compile("[ \n\N{ZERO WIDTH SPACE}]+")
HELD = "The robot is held by an obstacle; it stands until the Operator looks at the cause and has it go on."
CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)


@pytest.fixture(params=["en", "cs"])
def application(request, qapp, opener, tmp_path):
    """The application, not connected, in a language."""
    made = Application(tmp_path / "settings.json", opener)
    made.open()
    made.language.use(request.param)
    made.bridge._heartbeat.stop()
    store = made.flow.store
    store.settings = dataclasses.replace(store.settings, result_folder=tmp_path / "a folder of results",
                                         progress_folder=tmp_path / "a folder of progress", language=request.param)
    yield made
    # Its translator would outlive it.
    made.language.use("en")
    made.close()
    delete(made.window)


def delete(window):
    """Delete a window now; what waits for that slows the next ones down."""
    window.hide()
    window.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.DeferredDelete)


@pytest.fixture
def show(application):
    """show(make) opens the window that make() makes; it is deleted after the test."""
    made = []

    def begin(make):
        made.append(make())
        made[-1].show()
        QApplication.processEvents()
        return made[-1]
    yield begin
    application.flow.model.lay_aside()
    for window in reversed(made):
        delete(window)


def visible(window, kind):
    return [each for each in window.findChildren(kind) if each.isVisible()]


def cut_off(widget, window):
    """What does not show the whole widget: a parent that is too small; scroll areas show it when they are scrolled."""
    part = widget
    while part is not window:
        parent = part.parentWidget()
        if isinstance(parent.parentWidget(), QScrollArea) and parent is parent.parentWidget().viewport():
            # Sideways nothing is scrolled.
            wide = QRect(0, part.y(), parent.width(), part.height())
            if not wide.contains(part.geometry()):
                return f"{type(parent.parentWidget()).__name__} {parent.width()} < {part.width()}"
        elif not parent.rect().contains(part.geometry()):
            return f"{type(parent).__name__} {parent.rect()} of {part.geometry()}"
        part = parent
    return ""


def room_of(widget):
    """What the text needs, and what there is."""
    if isinstance(widget, QLabel) and widget.wordWrap():
        words = max((widget.fontMetrics().horizontalAdvance(word) for word in _BREAKS.split(widget.text())), default=0)
        needs = QSize(words, widget.heightForWidth(widget.width()))
        return needs, QSize(widget.contentsRect().width(), widget.height())
    return widget.minimumSizeHint(), widget.size()


def faults(window):
    """A sentence for each text that cannot be read as a whole."""
    found = []
    texts = [each for kind in (QLabel, QAbstractButton) for each in visible(window, kind)
             if each.text() and not isinstance(each.parent(), (QScrollBar, QTableView))]
    for widget in texts:
        needs, has = room_of(widget)
        if needs.width() > has.width() or needs.height() > has.height():
            found.append(f"{widget.text()!r} needs {needs}, has {has}")
    for box in visible(window, QComboBox):
        option = QStyleOptionComboBox()
        box.initStyleOption(option)
        field = box.style().subControlRect(QStyle.CC_ComboBox, option, QStyle.SC_ComboBoxEditField, box)
        if box.fontMetrics().horizontalAdvance(box.currentText()) > field.width():
            found.append(f"{box.currentText()!r} is cut in its box")
    found += [f"{widget.text()!r} is cut by {by}" for widget in texts if (by := cut_off(widget, window))]
    return found


def faults_of_tables(window):
    """The same of tables."""
    found = []
    for table in visible(window, QTableView):
        widths = [table.columnWidth(column) for column in range(table.model().columnCount() if table.model() else 0)]
        if sum(widths) > table.viewport().width() and not table.horizontalScrollBar().isVisible():
            found.append("columns of a table are out of sight")
        found += [f"column {column} of a table is elided" for column, width in enumerate(widths)
                  if table.sizeHintForColumn(column) > width]
    return found


def faults_of_symbols(window):
    """The same of what paints its own text."""
    steps = [bar for bar in visible(window, StepBar) if bar.minimumSizeHint().width() > bar.width()]
    batteries = [symbol for symbol in visible(window, BatterySymbol) if symbol.sizeHint().width() > symbol.width()]
    return [f"{type(symbol).__name__} is cut" for symbol in (*steps, *batteries)]


def assert_fits(window, monkeypatch, wanted=None):
    """It opens inside every screen, nothing is cut, and every Stop is inside it, and in nothing that scrolls."""
    found = []
    for name, size in SCREENS.items():
        monkeypatch.setattr(place, "available", lambda _window, size=size: QRect(QPoint(0, 0), size))
        place.open_within(window, wanted or window.sizeHint())
        for _ in range(3):
            QApplication.processEvents()
        if not QRect(QPoint(0, 0), size).contains(window.geometry()):
            found.append(f"{name}: the window is {window.geometry()}")
        found += [f"{name}: {fault}" for fault in (
            *faults(window), *faults_of_tables(window), *faults_of_symbols(window), *lost_stops(window))]
    assert not found, "\n".join(found)


def lost_stops(window):
    """A sentence for each Stop that is not wholly inside the window, or scrolls."""
    found = []
    for stop in visible(window, StopButton):
        if not window.rect().contains(QRect(stop.mapTo(window, QPoint(0, 0)), stop.size())):
            found.append("Stop is not inside the window")
        part = stop
        while part is not window:
            part = part.parentWidget()
            if isinstance(part, QScrollArea):
                found.append("Stop scrolls")
    return found


def status(**changes):
    told = {"mode": Mode.FOLLOWING_WAYPOINT, "car": CAR, "car_check": CarCheck(), "battery_percent": 100,
            "pose_valid": True, "position_sigma_m": 0.02, "key_height_m": 1.0, **changes}
    return RobotStatus(1, 1, 0.1, **told)


def tell(application, *events, **changes):
    """The robot says this."""
    model = application.flow.model
    model.apply(Batch(events, RobotSnapshot(status(**changes), LockState.LOCKED, ""), ()))
    application.flow.bridge.changed.emit()
    QApplication.processEvents()


@pytest.fixture
def main(application, show):
    """The main window with a robot that says the longest status word."""
    window = show(lambda: MainWindow(application.flow, application.appearance, application.stopping))
    tell(application, notifications=(Notification("peripherals", 2, "The lift is slow."),))
    return window


def test_connection_window_fits__B6(application, show, monkeypatch):
    window = show(lambda: ConnectionWindow(application.flow, Connection()))
    assert_fits(window, monkeypatch)
    window.can.interface.setCurrentIndex(1)
    window._show_refusal("robot", "No answer from the subscriber port 3334 of 192.168.0.10; is the robot on?")
    assert_fits(window, monkeypatch)


def test_calibration_fits_and_has_its_stop_in_sight__B6(application, main, show, monkeypatch):
    window = show(lambda: CalibrationWindow(application.flow, main))
    assert visible(window, StopButton)
    assert_fits(window, monkeypatch, window.wanted_size())


def test_settings_fit_and_have_their_stop_in_sight__B6(application, main, show, monkeypatch):
    window = show(lambda: SettingsWindow(application.flow, application.appearance, main))
    assert visible(window, StopButton)
    assert_fits(window, monkeypatch)


def test_main_window_fits_with_stop_in_sight__A2(main, monkeypatch):
    assert main.header.stop.isVisible()
    assert_fits(main, monkeypatch, WANTED)


@pytest.mark.parametrize("name", ["type", *SCENARIOS])
def test_choices_and_parameters_fit__B5(application, main, monkeypatch, name):
    application.flow.show(Step.TYPE)
    if name != "type":
        main.types.chosen.emit(name)
    assert_fits(main, monkeypatch, WANTED)


def test_identity_fits_with_what_is_missing(application, main, monkeypatch):
    main.types.chosen.emit("key_press")
    form = main.settings["key_press"].identity
    form.propose(application.flow.store)
    form._laboratory = laboratory_from({"required": list(TITLES)})
    form.more.setChecked(True)
    form.fields["key_battery_v"].show_text("75")
    form.fields["equipment"].show_text("multimeter; 77; soon")
    form.photos.show_paths((pathlib.Path("/photos/a_photo_of_the_car_from_the_front_left.jpg"),))
    assert form.fault.isVisible() and form.fields["equipment"].note.isVisible()
    assert_fits(main, monkeypatch, WANTED)
    form.more.setChecked(False)
    assert_fits(main, monkeypatch, WANTED)


ENTRIES = [TestEntry(f"/tests/{number}.json", "", str(number), 9, f"2026-11-{number:02d}T15:36:43+01:00", "key_press",
                     "Golf VIII Variant WVWZZZ1KZAW000001", "K-0042-A", "Nov\u00e1kov\u00e1", "Hall 2, row 4", 8, 8, 0,
                     True, "inconclusive", "x") for number in range(1, 25)]


def test_history_fits(application, main, monkeypatch):
    monkeypatch.setattr(main.history, "read", lambda _: None)
    main.welcome.history.emit()
    path = f"/home/operator{8 * '/a_folder_of_tests'}/broken.json"
    broken = TestEntry(path, f"The test cannot be continued from {path}. It is damaged: parts of it are missing or of "
                       "the wrong kind.")
    main.history._learn_all([*ENTRIES, broken])
    main.history.table.selectRow(0)
    assert main.screen is main.history and len(main.history.shown) == 24
    assert_fits(main, monkeypatch, WANTED)


def test_comparison_fits_and_has_its_stop_in_sight(application, main, show, monkeypatch):
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type(method="adaptive")
    sides = [Side(scenario, parameters, Progress(
        scenario.name, parameters.to_mapping(), {"started": f"2026-11-2{day}T15:36:43+01:00"}, CAR,
        [KeyPressResult(number, 45.0 * (number - 1), LineStatus.OK, far_m, None, 0.01, 9, 1.0, "", method="adaptive",
                        reach="measured", d50_m=far_m, d50_sigma_m=0.1, d50_low_m=far_m - 0.2, d50_high_m=far_m + 0.2)
         for number in range(1, 9)], identity=Identity("WVWZZZ1KZAW000001", f"Golf {day}")))
        for day, far_m in ((1, 4.0), (2, 6.0))]
    window = show(lambda: ComparisonWindow(compare(*sides), application.appearance, main))
    assert visible(window, StopButton) and window.table.model().rowCount() == 8
    assert_fits(window, monkeypatch, QSize(1300, 760))


def take_up(application, tmp_path, phase):
    """A test of axes is at hand."""
    scenario = SCENARIOS["autolock"]
    parameters = scenario.parameters_type()
    application.flow.model.take_up(
        Test(scenario, parameters, Progress(scenario.name, parameters, car=CAR), tmp_path / "progress.json"))
    application.flow.model.phase = phase


@pytest.mark.parametrize("phase", [Phase.MEASURING, Phase.PAUSED])
def test_measurement_fits_with_all_its_banners__B5(application, main, monkeypatch, tmp_path, phase):
    take_up(application, tmp_path, phase)
    application.flow.model.trouble = "The robot has been silent for 30 s; check the Wi-Fi and that its software runs."
    application.flow.show(Step.MEASUREMENT)
    main.measurement.say("Saved to /home/operator/Documents/mtr/progress/autolock_2026-11-22_15-36-43.json")
    tell(application, LinesPlanned(2, 28, CAR), ActionBegun("axis 3 (front left): go to the start"), hold_id=3,
         notifications=(Notification("held", 3, HELD), Notification("peripherals", 2, "The lift is slow.")))
    assert main.measurement.go_on.isVisible()
    assert main.header.blocked.isVisible() is (phase is Phase.MEASURING)
    assert_fits(main, monkeypatch, WANTED)


def test_protocol_fits(application, main, monkeypatch, tmp_path):
    take_up(application, tmp_path, Phase.FINISHED)
    application.flow.show(Step.PROTOCOL)
    assert_fits(main, monkeypatch, WANTED)


@pytest.mark.parametrize(("scenario", "columns"), [("key_press", 4), ("autolock", 4)])
def test_protocol_with_results_fits(operator, opener, monkeypatch, scenario, columns):
    opener.passive = scenario == "autolock"
    operator.begin(scenario)
    protocol = operator.finish()
    protocol.table.selectRow(0)
    assert protocol.table.model().columnCount() >= columns and protocol.budget.isVisible()
    assert_fits(operator.window, monkeypatch, WANTED)


def test_text_that_is_cut_is_noticed(show):
    label = QLabel("A sentence that has no room.")
    holder = QWidget()
    holder.resize(40, 20)
    label.setParent(holder)
    assert len(faults(show(lambda: holder))) == 1
