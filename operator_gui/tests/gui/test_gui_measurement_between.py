"""What may come in between while a test is measured: silence, a hand, a person, a screen."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QPoint, QRect
from PyQt5.QtGui import QGuiApplication
from stored import presses, stored

from mtr_operator.domain.robot_status import Notification
from mtr_operator.gui.fitting import place
from mtr_operator.station.readiness import Phase

LINES = 4


def test_silent_robot_pauses_the_test_and_resume_goes_on(operator, opener):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    opener.is_silent = True
    operator.wait(lambda: "Communication lost" in operator.window.header.status.text())
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert "silent" in screen.trouble.text()
    assert not screen.resume.isEnabled()
    measured = stored(operator.model.test.path)
    assert measured
    opener.is_silent = False
    operator.wait(screen.resume.isEnabled)
    operator.click(screen.resume)
    operator.finish()
    assert [presses(result) for result in stored(operator.model.test.path)[:len(measured)]] == [
        presses(result) for result in measured]


def test_values_of_a_silent_robot_are_grey_with_their_age_and_nothing_is_foretold__B1(operator, opener):
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    facts = screen.facts
    assert not facts.age.isVisible() and not facts.values["speed"].property("stale")
    opener.is_silent = True
    operator.wait(facts.age.isVisible)
    assert facts.age.text().endswith(" s old.")
    assert all(facts.values[name].property("stale") for name in ("locks", "key", "speed", "position"))
    assert "left" not in facts.left.text() and facts.action.text() == "Waits until the robot is heard again."
    opener.is_silent = False
    operator.wait(lambda: not facts.age.isVisible() and not facts.values["speed"].property("stale"))
    operator.click(operator.window.header.stop)


def test_banner_of_a_cause_that_has_gone_is_red_no_more__B2(operator, opener):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    opener.car_problem = "No CAN frame for 0.6 s; check the plug, the bit rate and that the Car is awake."
    operator.wait(lambda: operator.model.phase is Phase.PAUSED and screen.trouble.isVisible())
    assert screen.trouble.property("role") == "banner"
    opener.car_problem = ""
    operator.wait(lambda: screen.trouble.property("role") == "notice")


def test_lost_can_bus_pauses_the_test_and_resume_goes_on(operator, opener):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    opener.car_problem = "No CAN frame for 0.6 s; check the plug, the bit rate and that the Car is awake."
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert "The Car fell silent" in screen.trouble.text()
    assert not screen.resume.isEnabled()
    measured = len(stored(operator.model.test.path))
    opener.car_problem = ""
    operator.wait(screen.resume.isEnabled)
    operator.click(screen.resume)
    operator.finish()
    assert measured >= 1
    assert len(stored(operator.model.test.path)) == LINES


def test_robot_of_a_silent_link_is_painted_as_of_before__B1(operator, opener):
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    assert not screen.picture.robot.is_stale
    opener.is_silent = True
    operator.wait(lambda: screen.picture.robot.is_stale)
    operator.click(operator.window.header.stop)


def test_robot_that_is_held_goes_on_by_a_click(operator, opener):  # A8
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    assert not screen.go_on.isVisible() and not screen.held.isVisible()
    held = "The robot was driven by hand; it stands until the Operator has it go on."
    opener.spoil_with(hold_id=77, notifications=(Notification("held", 3, held),))
    operator.wait(screen.go_on.isVisible)
    assert screen.held.text() == held
    done = operator.model.done
    operator.click(screen.go_on)
    operator.wait(lambda: opener.sent[-1].resume_hold_id == 77)
    assert operator.model.done == done
    opener.spoil_with()
    operator.finish()


def test_person_is_asked_for_the_handle_and_says_that_it_is_taken(operator):
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    assert screen.handle.text().startswith("Take the Car's handle now, with the Remote key at 1.80 m")
    assert screen.taken.hasFocus()
    operator.click(screen.taken)
    operator.wait(lambda: operator.model.prompt is not None and operator.model.prompt.number == 2)
    assert screen.taken.isVisible() and screen.handle.isVisible()


def test_person_is_asked_to_switch_the_extender_and_says_that_it_is_done(operator):
    screen = operator.begin("relay_resistance", handle_timeout_s="3600", switch_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    assert screen.handle.text().startswith("Switch the extender off now") and screen.taken.hasFocus()
    assert screen.taken.text() == "Extender switched"
    operator.click(screen.taken)
    operator.wait(lambda: operator.model.prompt is not None and operator.model.prompt.number == 2)
    operator.wait(lambda: screen.handle.text().startswith("Take the Car's handle now, with the Remote key at 0.60 m"))
    assert screen.taken.text() == "Handle taken"


def test_prompt_goes_when_the_car_unlocks_and_when_the_test_is_stopped(operator, opener):
    screen = operator.begin("handle_request", border_distance_m="1.0", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    opener.handle_taken.set()
    operator.wait(lambda: operator.model.prompt is not None and operator.model.prompt.number == 2)
    operator.wait(screen.taken.isVisible)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: not screen.taken.isVisible() and not screen.handle.isVisible())
    operator.wait(screen.resume.isEnabled)


def test_person_who_does_not_come_pauses_the_test_with_a_sentence(operator):
    screen = operator.begin("handle_request", handle_timeout_s="5")
    operator.wait(screen.resume.isVisible)
    assert screen.trouble.text().startswith("Nobody has taken the Car's handle within 5 s")


def test_robot_that_a_second_window_takes_over_pauses_the_test_and_can_be_taken_back(operator, opener):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    opener.spoil_with(controlled_by_other=True)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert screen.trouble.text() == "Another application has taken over the control of the robot."
    assert not screen.resume.isEnabled()
    opener.spoil = lambda status: status
    operator.wait(screen.resume.isEnabled)
    operator.click(screen.resume)
    operator.finish()
    assert len(operator.model.results) == 4


def test_window_of_a_screen_that_is_unplugged_comes_back_with_its_stop_while_the_test_goes_on(operator, monkeypatch):
    operator.begin(angle_between_radials_rad="30")
    window, app = operator.window, QGuiApplication.instance()
    operator.wait(lambda: operator.model.done >= 1)
    # The external screen was on the right of the laptop's, and larger.
    window.setGeometry(2000, 100, 1900, 1000)
    laptop = QRect(0, 0, 1024, 700)
    monkeypatch.setattr(place, "available", lambda _window: laptop)
    app.screenRemoved.emit(app.primaryScreen())
    operator.wait(lambda: laptop.contains(window.frameGeometry()))
    stop = window.header.stop
    assert laptop.contains(QRect(stop.mapToGlobal(QPoint(0, 0)), stop.size()))
    assert operator.model.phase is Phase.MEASURING
    operator.click(stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)


def test_window_in_sight_stays_where_it_is_when_a_screen_comes_and_goes(operator, monkeypatch):
    window, app = operator.window, QGuiApplication.instance()
    monkeypatch.setattr(place, "available", lambda _window: QRect(0, 0, 1600, 1000))
    window.setGeometry(100, 100, 900, 700)
    before = window.geometry()
    operator.application.screens.bring_back()
    app.primaryScreenChanged.emit(app.primaryScreen())
    assert window.geometry() == before
