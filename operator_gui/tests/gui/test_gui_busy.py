"""While a test is measured: Stop is heard whatever the window computes, and nothing takes the test away."""
# SPDX-License-Identifier: Apache-2.0
import time

import pytest
from PyQt5.QtCore import Qt, QTimer
from PyQt5.QtWidgets import QShortcut

from mtr_operator.domain.robot_status import Notification, Problem
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.flow import Step
from mtr_operator.gui.forms.hold_button import HoldButton
from mtr_operator.station.readiness import Phase

# A picture of many zones takes as long, and more.
SLOW_S = 2.0


@pytest.fixture
def told(operator, monkeypatch):
    """Sentences that the window is to show; no dialog waits for somebody who has read them."""
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.show_message", lambda *_: None)
    found = []
    operator.application.flow.failed.connect(found.append)
    return found


def test_picture_that_takes_seconds_keeps_no_click_waiting(operator, monkeypatch):
    scenario = type(SCENARIOS["key_press"])
    fast = scenario.picture

    def slow(*arguments):
        time.sleep(SLOW_S)
        return fast(*arguments)
    monkeypatch.setattr(scenario, "picture", slow)
    turns = [time.monotonic()]
    timer = QTimer()
    timer.timeout.connect(lambda: turns.append(time.monotonic()))
    timer.start(10)
    screen = operator.begin(angle_between_radials_rad="5")
    operator.wait(lambda: screen.picture.points.sets)
    timer.stop()
    assert operator.model.phase is Phase.MEASURING
    assert max(after - before for before, after in zip(turns, turns[1:])) < 0.75 * SLOW_S
    operator.click(operator.window.header.stop)


def test_picture_of_a_test_shows_all_of_its_lines_in_the_end(operator):
    screen = operator.begin()
    operator.finish()
    operator.wait(lambda: sum(len(points.known) for points in screen.picture.points.sets) >= 4)


def test_test_that_is_measured_is_not_taken_away(operator, told):
    flow = operator.application.flow
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(screen.resume.isEnabled)
    earlier = operator.model.test
    operator.click(screen.leave)
    operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    running = operator.model.test
    flow.open(earlier.path)
    flow.start(earlier.scenario, earlier.parameters)
    flow.measure_again([1])
    operator.window._repeat(None)
    flow.to_welcome()
    assert operator.model.test is running and operator.model.phase is Phase.MEASURING and operator.model.may_move
    assert operator.window.screen is screen and flow.step is Step.MEASUREMENT and running.again == ()
    assert told == ["A test is being measured: stop it first, then open or begin another one."] * 4
    operator.click(operator.window.header.stop)


def test_hold_whose_cause_changes_is_not_released_by_the_button_held_for_the_former(operator, opener, monkeypatch):
    screen = operator.begin()
    opener.spoil_with(hold_id=5, notifications=(Notification("held", 3, "Blocked by an obstacle."),))
    operator.wait(screen.go_on.isVisible)
    monkeypatch.setattr(HoldButton, "HOLD_MS", 1000)
    operator.bot.mousePress(screen.go_on, Qt.LeftButton)
    opener.spoil_with(hold_id=6, notifications=(Notification("held", 3, "The robot was driven by hand."),))
    operator.wait(lambda: operator.model.robot.status.hold_id == 6)
    assert not screen.go_on.isDown()
    operator.bot.wait(1200)
    assert all(desired.resume_hold_id == 0 for desired in opener.sent)
    operator.bot.mouseRelease(screen.go_on, Qt.LeftButton)
    operator.hold(screen.go_on)
    operator.wait(lambda: opener.sent[-1].resume_hold_id == 6)
    operator.click(operator.window.header.stop)


def on_hold(hold_id, code):
    """Changes of a Status of a robot that is on hold for this reason."""
    held = Notification("held", 3, "On hold.", (Problem(code, (), "On hold."),))
    return {"hold_id": hold_id, "notifications": (held,)}


@pytest.mark.parametrize(("code", "resumed"), [("state_machine.held_stop", 7), ("state_machine.held_fault", 0),
                                               ("state_machine.held_link", 0), ("", 0)])
def test_held_resume_ends_the_hold_of_the_operators_stop_and_no_other(operator, opener, code, resumed):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(screen.resume.isEnabled)
    opener.spoil_with(**on_hold(7, code))
    operator.wait(lambda: operator.model.robot.status.hold_id == 7)
    assert all(desired.resume_hold_id == 0 for desired in opener.sent)
    operator.hold(screen.resume)
    operator.wait(lambda: operator.model.phase is Phase.MEASURING and opener.sent[-1].resume_hold_id == resumed
                  and not opener.sent[-1].stop)
    operator.click(operator.window.header.stop)


def test_key_that_is_held_down_skips_one_line(operator):
    screen = operator.begin()
    shortcuts = screen.findChildren(QShortcut)
    assert shortcuts and not any(shortcut.autoRepeat() for shortcut in shortcuts)
    operator.click(operator.window.header.stop)


def test_window_that_hangs_stops_the_robot_and_says_so(operator, monkeypatch):
    monkeypatch.setattr("mtr_operator.station.links.attention.LIMIT_S", 1.0)
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    # No event of Qt is handled meanwhile, no click on Stop either.
    time.sleep(2.0)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert "did not react for 1 s" in screen.trouble.text() and screen.trouble.isVisible()
    operator.wait(screen.resume.isEnabled)
    operator.click(screen.resume)
    operator.wait(screen.taken.isVisible)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert screen.trouble.text() == ""
