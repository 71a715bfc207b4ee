"""A test from start to protocol, stopped and gone on with, and what its screen shows of it."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import Qt
from stored import presses, stored

from mtr_operator.station.readiness import Phase

LINES = 4


@pytest.mark.parametrize(("scenario", "lines"), [("key_press", 4), ("autolock", 8)])
def test_whole_test_ends_with_the_protocol(operator, opener, scenario, lines):
    opener.passive = scenario == "autolock"
    screen = operator.begin(scenario)
    operator.wait(lambda: "Measuring" in operator.window.header.status.text())
    protocol = operator.finish()
    assert operator.window.header.steps.selected == 3
    assert protocol.table.model().rowCount() == lines
    assert len(stored(operator.model.test.path)) == lines
    assert screen.facts.percent.text() == "100 %" or operator.model.percent == 100
    assert operator.application.flow.store.settings.unfinished is None


def test_screen_tells_progress_robot_and_car(operator):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1 and screen.facts.percent.text() == "25 %")
    assert screen.facts.count.text() == "1 of 4 lines measured"
    assert screen.facts.bar.value() == 25
    assert "left" in screen.facts.left.text()
    assert screen.facts.values["car"].text() == "4.50 m \N{MULTIPLICATION SIGN} 1.80 m"
    assert screen.facts.values["key"].text() == "100 cm"
    assert screen.facts.values["newest"].text().startswith("1 (0°): press ")
    assert screen.facts.action.text()


def test_high_screen_lists_what_is_measured_so_far_the_newest_first(operator, opener):
    opener.passive = True
    operator.window.resize(1360, 1000)
    screen = operator.begin("autolock")
    operator.wait(lambda: operator.model.done >= 2)
    model = screen.so_far.table.model()
    operator.wait(lambda: model.rowCount() >= 2)
    assert screen.so_far.isVisible()
    assert [model.headerData(column, Qt.Horizontal) for column in range(4)] == ["#", "Axis", "Unlock [m]", "Lock [m]"]
    assert model.data(model.index(model.rowCount() - 1, 0)) == "1"
    assert float(model.data(model.index(0, 2))) < float(model.data(model.index(0, 3)))
    operator.window.resize(1360, 800)
    operator.wait(lambda: not screen.so_far.isVisible())


def test_stop_stands_the_robot_still_and_resume_measures_the_rest(operator, opener):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert any(desired.stop for desired in opener.sent)
    assert "Paused" in operator.window.header.status.text()
    measured = stored(operator.model.test.path)
    assert 1 <= len(measured) < LINES
    operator.wait(screen.resume.isEnabled)
    operator.click(screen.resume)
    operator.finish()
    results = stored(operator.model.test.path)
    assert [presses(result) for result in results[:len(measured)]] == [presses(result) for result in measured]
    assert len(results) == LINES


def test_stopped_robot_gets_no_order_to_move(operator, opener):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    del opener.sent[:]
    operator.wait(lambda: len(opener.sent) > 20)
    assert all(desired.waypoint is None for desired in opener.sent[2:])


def test_small_uncertainty_of_the_position_is_not_zero__A8(operator, opener):
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    opener.spoil_with(position_sigma_m=0.003)
    operator.wait(lambda: screen.facts.values["position"].text() == "\N{PLUS-MINUS SIGN}0.3 cm")
    operator.click(operator.window.header.stop)


@pytest.mark.parametrize(("scenario", "are_shown"), [("key_press", True), ("autolock", False)])
def test_lines_are_shown_for_key_press_only(operator, scenario, are_shown):
    screen = operator.begin(scenario)
    operator.wait(lambda: operator.model.total > 0 and screen.picture.lines.stretches)
    assert screen.picture.lines.is_visible is are_shown


def test_waypoint_trail_and_robot_are_in_the_picture(operator):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.wait(lambda: screen.picture.waypoint.pose is not None and screen.picture.robot.pose is not None)
    assert len(screen.picture.trail.places) > 10
    assert screen.picture.robot.key == (0.25, 0.0)


def test_time_left_counts_mapping_and_check__B3(operator):
    operator.begin()
    left = []
    operator.application.flow.bridge.changed.connect(
        lambda: left.append((operator.model.total and operator.model.done, operator.model.left_s)))
    operator.finish()
    prepared = next(index for index, (done, _) in enumerate(left) if done)
    assert left[0][1] is not None and left[0][1] > 17.0 + 45.0
    assert all(seconds is None or seconds > 0.0 for _, seconds in left[:prepared])
