"""The live view of the Car's bus."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from fit_checks import assert_fits, visible
from PyQt5.QtCore import QSize, Qt

from mtr_operator.domain.ports import BusMessage, BusMessages, BusTraffic, LockState
from mtr_operator.gui.bus.bus_window import BusWindow
from mtr_operator.gui.bus.message_model import is_gone
from mtr_operator.gui.bus.time_line_view import curves, highest_m, runs
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.station.bus.bus_view import BusView
from mtr_operator.station.bus.time_line import LockEvent, Moment

LOCKED, UNLOCKED, UNKNOWN = LockState.LOCKED, LockState.UNLOCKED, LockState.UNKNOWN
LOCKS = BusMessage(0x320, False, "LockStatus", 1234, 0.1, 0.04, bytes([1, 2, 0xAB]))
GONE = BusMessage(0x18FEF100, True, "", 7, None, 12.3, bytes(8))
MOMENTS = tuple(Moment(0.1 * index, LOCKED if index < 300 else UNLOCKED, 5.0 - 0.005 * index) for index in range(600))
EVENT = LockEvent(29.9, 0.005, UNLOCKED, 3.505, "passive_entry")
FULL = BusView(BusMessages((LOCKS, GONE), 17), BusTraffic(0.234, 0.1, 0.1), "", MOMENTS, (EVENT,))


@pytest.fixture
def told(monkeypatch, application, show, main):
    """told(view) opens the window on a bus that is like that."""
    def begin(view):
        monkeypatch.setattr(application.flow, "bus_view", lambda: view)
        return show(lambda: BusWindow(application.flow, application.appearance, main))
    return begin


def cells(window, row):
    model = window.table.model()
    return [model.index(row, column).data() for column in range(model.columnCount())]


@pytest.mark.parametrize("application", ["en"], indirect=True)
def test_each_message_has_its_cycle_and_age(told):
    window = told(FULL)
    assert window.summary.text() == "Load 23 %, 2 messages. 17 frames of further messages are not shown."
    assert cells(window, 0) == ["320", "LockStatus", "1234", "100.0", "0.0", "01 02 AB"]
    assert cells(window, 1)[:5] == ["18FEF100", "\N{EN DASH}", "7", "\N{EN DASH}", "12.3"]
    assert window.table.model().index(0, 0).data(Qt.ForegroundRole) is None
    assert window.table.model().index(1, 0).data(Qt.ForegroundRole) is not None


@pytest.mark.parametrize("application", ["en"], indirect=True)
def test_change_of_the_locks_has_the_distance_of_the_key_beside_it(told):
    window = told(FULL)
    assert window.newest.text() == \
        "Now: unlocked, key at 2.00 m. Last change 30.0 s ago: unlocked, key at 3.50 m."
    assert window.time_line.accessibleDescription() == window.newest.text()


@pytest.mark.parametrize("application", ["en"], indirect=True)
@pytest.mark.parametrize(("view", "summary"), [
    (BusView(problem="No CAN adapter is chosen."), "No CAN adapter is chosen."),
    (BusView(), "There is no bus: the Car is a substitute inside the application."),
    (BusView(BusMessages(), BusTraffic(0.0, None, 0.1), "The Car's CAN bus is silent."),
     "The Car's CAN bus is silent. Load 0 %, 0 messages.")])
def test_no_bus_and_a_silent_one_say_so(told, view, summary):
    window = told(view)
    assert window.summary.text() == summary
    assert window.newest.text() == "Nothing is known of the locks yet."


def test_bus_view_fits_and_has_its_stop_in_sight(told, monkeypatch):
    window = told(FULL)
    assert visible(window, StopButton) and not window.isModal()
    assert_fits(window, monkeypatch, QSize(980, 760))


def test_chosen_row_stays_while_the_bus_goes_on(told, monkeypatch, application):
    window = told(FULL)
    window.table.selectRow(1)
    window.refresh()
    assert [index.row() for index in window.table.selectionModel().selectedRows()] == [1]


def test_padlock_opens_the_view_and_closing_ends_the_looking(operator):
    header = operator.window.header
    operator.click(header.locks)
    [window] = [each for each in operator.window.findChildren(BusWindow) if each.isVisible()]
    operator.wait(lambda: "Now: locked" in window.newest.text())
    assert window._timer.isActive()
    window.hide()
    assert not window._timer.isActive()
    window.close()


def test_band_has_one_stretch_for_each_state():
    moments = [Moment(0.0, UNKNOWN, None), Moment(1.0, LOCKED, 2.0), Moment(2.0, LOCKED, 1.0),
               Moment(3.0, UNLOCKED, 1.0)]
    assert list(runs(moments)) == [(UNKNOWN, 0.0, 1.0), (LOCKED, 1.0, 3.0), (UNLOCKED, 3.0, 3.0)]
    assert list(runs([])) == []


def test_curve_has_gaps_where_nobody_saw_the_key():
    moments = [Moment(0.0, LOCKED, 3.0), Moment(0.1, LOCKED, 2.9), Moment(0.2, LOCKED, None), Moment(0.3, LOCKED, 2.7),
               Moment(5.0, LOCKED, 1.0)]
    assert curves(moments) == [[(0.0, 3.0), (0.1, 2.9)], [(0.3, 2.7)], [(5.0, 1.0)]]
    assert highest_m(moments) == 5.0
    assert highest_m([]) == 1.0


@pytest.mark.parametrize(("message", "gone"), [(LOCKS, False), (GONE, True),
                                               (BusMessage(1, False, "", 2, 2.0, 9.0, b""), False),
                                               (BusMessage(1, False, "", 2, 2.0, 11.0, b""), True)])
def test_message_is_gone_after_five_cycles(message, gone):
    assert is_gone(message) is gone
