"""The event list on the screen."""
# SPDX-License-Identifier: Apache-2.0
import datetime

import pytest
from fit_checks import assert_fits, visible
from PyQt5.QtCore import QSize, Qt

from mtr_operator.domain.eventlog import event_list
from mtr_operator.domain.eventlog.entry import ERROR, INFO, WARNING, EventEntry, EventKind
from mtr_operator.domain.robot_status import LogMessage
from mtr_operator.gui.events.event_window import EventWindow
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.station.events import EventLogged
from mtr_operator.station.mailbox import Batch
from mtr_operator.storage.recorded.event_file import read_events
from mtr_operator.storage.recorded.recording import recorded_events, recording_folder

NOON = datetime.datetime(2026, 11, 23, 12, tzinfo=datetime.timezone.utc)
LONG = "The lift did not reach its height within 12.0 s; see whether it is free, and have the robot go on. " * 2


def entry(text, kind=EventKind.ROBOT_LOG, severity=WARNING, source="lift_controller"):
    return EventLogged(EventEntry(NOON, 1.0, kind, severity, source, text))


def tell(flow, *events):
    flow.model.apply(Batch(events, None, ()))
    flow.bridge.changed.emit()


@pytest.fixture(name="window")
def event_window(application, show, main):
    tell(application.flow, entry("First."), entry("The robot has a fault.", EventKind.FAULT, ERROR, "robot"),
         entry("Third.", EventKind.TEST, INFO, "application"))
    return show(lambda: EventWindow(application.flow, application.appearance, main))


def texts(window):
    model = window.table.model()
    return [model.index(row, model.columnCount() - 1).data() for row in range(model.rowCount())]


@pytest.mark.parametrize("application", ["en"], indirect=True)
def test_newest_event_is_first_and_the_list_grows_and_is_filtered(window, application, qtbot):
    assert texts(window) == ["Third.", "The robot has a fault.", "First."]
    window.severity.setCurrentIndex(window.severity.findData(WARNING))
    tell(application.flow, entry("Fourth."), entry("Fifth.", severity=INFO))
    assert texts(window) == ["Fourth.", "The robot has a fault.", "First."]
    assert window.notice.text() == "5 events, 3 of them shown."
    window.kind.setCurrentIndex(window.kind.findData(EventKind.ROBOT_LOG))
    qtbot.keyClicks(window.search, "LIFT fourth")
    assert texts(window) == ["Fourth."]
    assert window.table.model().index(0, 0).data(Qt.ForegroundRole) is not None


@pytest.mark.parametrize("application", ["en"], indirect=True)
def test_each_event_begins_with_a_capital_letter(window, application):
    tell(application.flow, entry("axis 7 (right): measured", EventKind.TEST, INFO, "application"))
    assert texts(window)[0] == "Axis 7 (right): measured"


@pytest.mark.parametrize("application", ["cs"], indirect=True)
def test_events_speak_czech_and_are_searched_so(window):
    assert texts(window)[1] == "Robot má poruchu."
    window.search.setText("poruch")
    assert texts(window) == ["Robot má poruchu."]


def test_old_events_leave_the_window(window, application, monkeypatch):
    monkeypatch.setattr("mtr_operator.gui.events.event_window.MAX_KEPT", 4)
    tell(application.flow, *(entry(f"Number {index}.") for index in range(3)))
    assert texts(window) == ["Number 2.", "Number 1.", "Number 0.", "Third."]


def test_event_list_fits_and_has_its_stop_in_sight(window, application, monkeypatch):
    tell(application.flow, entry(LONG))
    assert visible(window, StopButton) and not window.isModal()
    assert_fits(window, monkeypatch, QSize(1080, 680))


def test_robots_log_locks_and_orders_are_listed_and_kept_with_the_test(operator, opener):
    opener.spoil_with(log=(LogMessage(1, 5.0, 2, "lift", "The lift is slow."),))
    screen = operator.begin()
    operator.click(screen.events)
    window, = (each for each in operator.window.findChildren(EventWindow))
    operator.wait(lambda: "The lift is slow." in texts(window))
    operator.finish()
    operator.wait(lambda: "All lines are measured." in texts(window))
    found = texts(window)
    assert found.count("The lift is slow.") == 1
    assert any(text.startswith("The Car is unlocked now") for text in found)
    assert "The test begins." in found and any(text.startswith("Radial 1 (") for text in found)
    path, = recorded_events(recording_folder(operator.model.test.path))
    kept = [each.text for each in read_events(path)]
    assert kept[0] == "The test begins." and kept[-1] == "All lines are measured."
    window.of.setCurrentIndex(1)
    assert texts(window) == [text[:1].upper() + text[1:] for text in kept[::-1]]
    assert "They are kept in" in window.notice.text()


def test_stop_is_in_the_list_and_the_way_to_it_is_behind_the_status_word(operator):
    operator.begin()
    operator.click(operator.window.header.stop)
    operator.wait(lambda: any(each.kind is EventKind.OPERATOR for each in operator.model.events.entries))
    status = operator.window.header.status
    operator.click(status)
    operator.click(status.events)
    window, = (each for each in operator.window.findChildren(EventWindow))
    assert not status.popup.isVisible() and "Stop." in texts(window)


def test_damaged_list_of_a_test_is_said(operator):
    operator.begin()
    protocol = operator.finish()
    path, = recorded_events(recording_folder(operator.model.test.path))
    path.write_text("nothing of the kind", encoding="utf-8")
    operator.window._show_events()
    window, = (each for each in operator.window.findChildren(EventWindow))
    window.of.setCurrentIndex(1)
    assert protocol is operator.window.screen and texts(window) == []
    assert "is damaged in line 1" in window.notice.text()
    assert event_list.MAX_KEPT >= 10_000
