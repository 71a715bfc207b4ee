"""The window of the test area: drawn by mouse and keyboard, sent, and shown as the robot reports it."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest
from fit_checks import assert_fits, visible
from PyQt5.QtCore import QPoint, QSize, Qt
from PyQt5.QtTest import QTest

from mtr_operator.domain.geometry.area import check_corners
from mtr_operator.domain.robot_status import AreaState, Problem
from mtr_operator.gui.area.area_window import AreaWindow
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.station.checks.finding import Check, State

NO_AREA = Problem("dispatcher.no_area", (), "No test area is set.")
NEEDED = AreaState(required=True, origin_id=9, problems=(NO_AREA,))


@pytest.fixture
def window(operator):
    operator.click(operator.window.welcome.border)
    [found] = [each for each in operator.window.findChildren(AreaWindow) if each.isVisible()]
    operator.wait(lambda: found.state is not None)
    found.refresh()
    return found


def pixel(window, point):
    return QPoint(*map(round, window.view.viewport.to_screen(point)))


def click(window, point, button=Qt.LeftButton):
    QTest.mouseClick(window.view, button, Qt.NoModifier, pixel(window, point))


def test_rectangle_is_set_and_shown_when_the_robot_reports_it(operator, window, opener):
    assert not window.send.isEnabled() and not window.withdraw.isEnabled()
    operator.click(window.rectangle)
    drawn = window.view.sketch.corners
    operator.click(window.send)
    operator.wait(lambda: window.state.corners == drawn)
    window.refresh()
    assert window._area.corners == drawn and "224 m2" in window.enforced.text()
    assert [desired.area.corners for desired in opener.sent if desired.area][-1] == drawn
    assert not any(desired.waypoint or desired.map_car_id for desired in opener.sent)
    operator.click(window.withdraw)
    operator.wait(lambda: window.state.corners == ())


def test_area_is_drawn_by_clicks_moved_by_a_drag_and_taken_back(window, operator):
    for corner in ((4, 4), (4, -4), (-4, -4), (-4, 4)):
        click(window, corner)
    sketch = window.view.sketch
    assert len(sketch.corners) == 4 and sketch.corners[0] == pytest.approx((4, 4), abs=0.05)
    QTest.mousePress(window.view, Qt.LeftButton, Qt.NoModifier, pixel(window, (4, 4)))
    QTest.mouseMove(window.view, pixel(window, (6, 5)))
    window.view.mouseMoveEvent(moved(window, (6, 5)))
    QTest.mouseRelease(window.view, Qt.LeftButton, Qt.NoModifier, pixel(window, (6, 5)))
    assert sketch.corners[0] == pytest.approx((6, 5), abs=0.05) and len(sketch.corners) == 4
    operator.click(window.undo)
    assert sketch.corners[0] == pytest.approx((4, 4), abs=0.05)
    click(window, (-4, 4), Qt.RightButton)
    assert len(sketch.corners) == 3
    operator.click(window.clear)
    assert sketch.corners == () and not window.clear.isEnabled()


def moved(window, point):
    from PyQt5.QtCore import QEvent, QPointF
    from PyQt5.QtGui import QMouseEvent
    return QMouseEvent(QEvent.MouseMove, QPointF(pixel(window, point)), Qt.LeftButton, Qt.LeftButton, Qt.NoModifier)


def test_area_is_drawn_by_the_keyboard_alone(window):
    view, sketch = window.view, window.view.sketch
    view.setFocus()

    def go(key, times, modifier=Qt.ShiftModifier):
        for _ in range(times):
            QTest.keyClick(view, key, modifier)
    for key, times in ((Qt.Key_Up, 3), (Qt.Key_Left, 3), (Qt.Key_Down, 3)):
        go(key, times)
        QTest.keyClick(view, Qt.Key_Space)
    assert sketch.corners == pytest.approx([(3, 0), (3, 3), (0, 3)])
    QTest.keyClick(view, Qt.Key_Return)
    go(Qt.Key_Right, 2, Qt.NoModifier)
    QTest.keyClick(view, Qt.Key_Return)
    assert sketch.corners[2] == pytest.approx((0.0, 2.8)) and sketch.picked is None
    QTest.keyClick(view, Qt.Key_Z, Qt.ControlModifier)
    assert sketch.corners[2] == pytest.approx((0, 3))
    QTest.keyClick(view, Qt.Key_Delete)
    assert len(sketch.corners) == 2
    assert window.isVisible()


def test_area_that_crosses_itself_cannot_be_set(window):
    window.view.sketch.replace(((4.0, 4.0), (-4.0, -4.0), (4.0, -4.0), (-4.0, 4.0)))
    window.view.show_sketch()
    assert not window.send.isEnabled() and window.notice.text() == "The border of the test area crosses itself."


def test_robot_that_needs_an_area_says_so_and_its_check_is_bad(window, operator, opener):
    opener.spoil_with(area=NEEDED)
    operator.wait(lambda: window.state == NEEDED)
    window.refresh()
    assert window.enforced.text() == "No test area is set."
    [item] = [item for item in operator.model.checklist if item.check is Check.TEST_AREA]
    assert item.state is State.BAD and item.said == "No test area is set."


def test_area_of_the_launch_file_and_of_another_origin_cannot_be_mistaken(window, operator, opener):
    window.view.sketch.replace(((4.0, 4.0), (-4.0, 4.0), (-4.0, -4.0)))
    fixed = AreaState(True, True, 0, 9, window.view.sketch.corners, 9)
    opener.spoil_with(area=fixed)
    operator.wait(lambda: window.state == fixed)
    window.refresh()
    assert window._area.corners and not window.send.isEnabled() and not window.withdraw.isEnabled()
    other = replace(fixed, is_fixed=False, origin_id=10, problems=(NO_AREA,))
    opener.spoil_with(area=other)
    operator.wait(lambda: window.state == other)
    window.refresh()
    assert window._area.corners == () and window.send.isEnabled()


def test_silent_robot_enforces_nothing_that_the_window_knows_of(window, operator, opener):
    opener.is_silent = True
    operator.wait(lambda: window.state is None)
    window.refresh()
    assert not window.send.isEnabled() and not window.rectangle.isEnabled() and window._robot.is_stale


def test_border_is_in_the_picture_of_a_test_and_in_its_record(operator, opener):
    operator.click(operator.window.welcome.border)
    [window] = [each for each in operator.window.findChildren(AreaWindow) if each.isVisible()]
    operator.wait(lambda: window.state is not None and window.state.robot is not None)
    operator.click(window.rectangle)
    check_corners(window.view.sketch.corners)
    operator.click(window.send)
    operator.wait(lambda: window.state.corners == window.view.sketch.corners)
    window.close()
    measurement = operator.begin()
    operator.wait(lambda: measurement.picture.border.corners)
    protocol = operator.finish()
    assert protocol is operator.window.protocol
    assert "drawn" in operator.model.current_test.progress.session["test area"]


def test_window_fits_and_has_its_stop_in_sight(application, show, main, monkeypatch):
    window = show(lambda: AreaWindow(application.flow, application.appearance, main))
    assert visible(window, StopButton) and not window.isModal()
    assert_fits(window, monkeypatch, QSize(980, 760))
