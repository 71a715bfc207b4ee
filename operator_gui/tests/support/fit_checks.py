"""What the tests of fitting ask of a window: nothing is cut or elided, what has no room scrolls, Stop is inside."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import re

import pytest
from PyQt5.QtCore import QCoreApplication, QEvent, QPoint, QRect, QSize
from PyQt5.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QLabel,
    QLineEdit,
    QScrollArea,
    QScrollBar,
    QStyle,
    QStyleOptionComboBox,
    QStyleOptionFrame,
    QTableView,
)

from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import CarCheck, CarDimensions, Mode, Notification, RobotStatus
from mtr_operator.gui.app import Application
from mtr_operator.gui.fitting import place
from mtr_operator.gui.header.step_bar import StepBar
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.header.symbols import BatterySymbol
from mtr_operator.gui.windows.main_window import MainWindow
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.mailbox import Batch

# Free for windows, in pixels of the scale, below a panel of 32 pixels where there is one.
SCREENS = {"1366x768": QSize(1366, 736), "1024x700": QSize(1024, 700), "1280x720 at 1.5": QSize(853, 480),
           "3840x2160 at 2": QSize(1920, 1080)}
# What the main window would like.
WANTED = QSize(1360, 860)
# A row ends at these; the second one has no width.
_BREAKS = re.compile("[ \n\N{ZERO WIDTH SPACE}]+")
# Of QLineEdit, left and right of its text, in pixels.
_LINE_MARGIN = 2
CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)


@pytest.fixture(name="application", params=["en", "cs"])
def application_in_a_language(request, qapp, opener, tmp_path):
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


@pytest.fixture(name="show")
def show_for_a_test(application):
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
        # As it is shown, with what keeps a figure and its unit together.
        shown = _BREAKS.split(QLabel.text(widget))
        words = max((widget.fontMetrics().horizontalAdvance(word) for word in shown), default=0)
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
    found += [f"{edit.placeholderText()!r} is cut in its line" for edit in visible(window, QLineEdit)
              if edit.placeholderText() and not edit.text() and is_hint_cut(edit)]
    found += [f"{widget.text()!r} is cut by {by}" for widget in texts if (by := cut_off(widget, window))]
    return found


def is_hint_cut(edit):
    """Whether the text that stands in an empty line has no room."""
    option = QStyleOptionFrame()
    edit.initStyleOption(option)
    room = edit.style().subElementRect(QStyle.SE_LineEditContents, option, edit).width()
    margins = edit.textMargins()
    room -= margins.left() + margins.right() + 2 * _LINE_MARGIN
    return edit.fontMetrics().horizontalAdvance(edit.placeholderText()) > room


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


@pytest.fixture(name="main")
def main_window(application, show):
    """The main window with a robot that says the longest status word."""
    window = show(lambda: MainWindow(application.flow, application.appearance, application.stopping))
    tell(application, notifications=(Notification("peripherals", 2, "The lift is slow."),))
    return window
