"""Windows are built outside the filter of keys, and the filter is back before anything can be pressed."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import Qt
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.robot_status import MotionSource
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.history.history_screen import HistoryScreen
from mtr_operator.gui.stopping import Stopping

# Building it within the filter takes 10,000.
MAX_EVENTS = 500


def moving(operator, opener):
    """Let the robot drive without a test."""
    opener.spoil_with(motion_source=MotionSource.PLANNER, speed_mps=0.5)
    operator.wait(lambda: operator.application.stopping.may_move)
    opener.sent.clear()


def stops_by_key(operator, opener):
    QTest.keyClick(QApplication.focusWidget() or operator.window, Qt.Key_Escape)
    return bool(opener.sent) and opener.sent[-1].stop


def fail(stopping):
    with stopping.building():
        raise LookupError("a widget that cannot be made")


def nested(stopping):
    with stopping.building(), stopping.building():
        pass


@pytest.mark.parametrize("build", ["window", "settings", "history", "nested", "failed"])
def test_key_stops_the_robot_after_something_was_built(operator, opener, build):
    stopping = operator.application.stopping
    moving(operator, opener)
    if build == "window":
        operator.window.show_settings()
    elif build == "settings":
        assert operator.window.settings["autolock"].start.text()
    elif build == "history":
        assert operator.window.history.search is not None
    elif build == "nested":
        nested(stopping)
    else:
        with pytest.raises(LookupError):
            fail(stopping)
    assert stops_by_key(operator, opener)


def test_key_stops_the_robot_in_a_window_of_another_language(operator, opener):
    former = operator.window
    operator.application.flow.use_language("cs")
    operator.wait(lambda: operator.window is not former)
    moving(operator, opener)
    assert stops_by_key(operator, opener)


def test_filter_that_was_removed_is_not_installed_by_building(operator, opener):
    stopping = operator.application.stopping
    stopping.remove()
    nested(stopping)
    moving(operator, opener)
    assert not stops_by_key(operator, opener)


@pytest.mark.parametrize("opened", ["show_settings", "_show_calibration", "_show_bus", "_show_events", "_show_area"])
def test_window_beside_has_its_stop_at_once(operator, opened):
    getattr(operator.window, opened)()
    dialog = next(iter(operator.window._opened.values()))
    assert dialog.findChild(StopButton).isVisible()


def test_main_window_is_built_outside_the_filter(operator, monkeypatch):
    seen, take = [], Stopping.eventFilter
    monkeypatch.setattr(Stopping, "eventFilter",
                        lambda self, watched, event: bool(seen.append(event.type())) or take(self, watched, event))
    former = operator.window
    operator.application._show(operator.application._made_main)
    assert operator.window is not former and len(seen) < MAX_EVENTS


def test_history_is_made_when_it_is_opened_first(operator):
    window = operator.window
    assert not window.findChildren(HistoryScreen)
    operator.click(window.welcome.open)
    assert window.screen is window.history and window.findChildren(HistoryScreen) == [window.history]
