"""A test from start to protocol, stopped and gone on with, and everything that may come in between."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import shutil

import pytest

from mtr_operator.domain.robot_status import Notification
from mtr_operator.station.readiness import Phase

LINES = 4


@pytest.fixture
def notice(monkeypatch):
    """Sentences of message boxes."""
    sentences = []
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.show_message",
                        lambda parent, title, text: sentences.append(text))
    return sentences


def answer_folder(monkeypatch, module, folder):
    monkeypatch.setattr(f"mtr_operator.gui.{module}.ask_folder", lambda parent, title, start: folder)


def stored(path):
    return json.loads(path.read_text(encoding="utf-8"))["results"]


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


def presses(result):
    """What was measured; what all radials say together may move the distance that follows."""
    return result["radial"], result["robot_time_s"], result["worked_at_m"], result["failed_at_m"]


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


def test_save_progress_says_where(operator):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(screen.save)
    operator.wait(lambda: "Saved to" in screen.note.text())
    assert str(operator.folder / "progress") in screen.note.text().replace("\N{ZERO WIDTH SPACE}", "")
    assert stored(operator.model.test.path)


def test_vanished_progress_folder_is_asked_for_again_and_nothing_is_lost(operator, monkeypatch, notice):
    other = operator.folder / "other"
    answer_folder(monkeypatch, "windows.main_window", other)
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    folder = operator.folder / "progress"
    shutil.rmtree(folder)
    folder.write_text("a file where the folder was", encoding="utf-8")
    operator.wait(lambda: other.exists() and list(other.glob("*.json")) and operator.model.phase is Phase.PAUSED)
    assert "cannot be written" in notice[0]
    operator.wait(screen.resume.isEnabled)
    operator.click(screen.resume)
    operator.finish()
    assert len(stored(operator.model.test.path)) == LINES
    assert operator.model.test.path.parent == other


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


def test_small_uncertainty_of_the_position_is_not_zero__A8(operator, opener):
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    opener.spoil_with(position_sigma_m=0.003)
    operator.wait(lambda: screen.facts.values["position"].text() == "\N{PLUS-MINUS SIGN}0.3 cm")
    operator.click(operator.window.header.stop)


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


def test_closing_asks_first_and_the_next_start_offers_to_go_on(operator, start, monkeypatch, qtbot):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.confirm", lambda *_: False)
    assert not operator.window.close()
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.confirm", lambda *_: True)
    assert operator.window.close()
    operator.application.close()
    measured = len(stored(operator.model.test.path))
    assert measured >= 1

    later = type(operator)(start(), qtbot, operator.folder).connect()
    assert later.window.welcome.offer.isVisible()
    later.application.flow.open(later.application.flow.store.settings.unfinished)
    screen = later.window.measurement
    assert later.window.screen is screen
    assert f"{measured} of {LINES}" in screen.facts.count.text()
    later.wait(screen.resume.isEnabled)
    later.click(screen.resume)
    later.finish()
    assert len(stored(later.model.test.path)) == LINES
    later.click(later.window.protocol.done)
    assert not later.window.welcome.offer.isVisible()


def test_offer_can_be_dismissed_until_the_next_start_and_the_file_stays__B13(operator, start, qtbot):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    operator.click(screen.leave)
    assert operator.window.welcome.offer.isVisible()
    assert operator.window.welcome._first.hasFocus() or not operator.window.isActiveWindow()
    path = operator.application.flow.store.settings.unfinished
    operator.window.welcome.dismiss.emit()
    assert not operator.window.welcome.offer.isVisible()
    assert path.exists()
    operator.application.flow.to_welcome()
    assert not operator.window.welcome.offer.isVisible()
    operator.application.close()
    later = type(operator)(start(), qtbot, operator.folder).connect()
    assert later.window.welcome.offer.isVisible()


def test_finished_test_from_a_file_shows_its_protocol(operator, monkeypatch):
    operator.begin()
    operator.finish()
    path = operator.model.test.path
    operator.click(operator.window.protocol.done)
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.ask_progress_file", lambda *_: path)
    operator.click(operator.window.welcome.open)
    operator.click(operator.window.history.file)
    assert operator.window.screen is operator.window.protocol
    assert operator.window.protocol.table.model().rowCount() == LINES


@pytest.mark.parametrize(("spoil", "part"), [
    (lambda text: text[:len(text) // 2], "truncated or not a JSON file"),
    (lambda text: "[]", "not a progress file"),
    (lambda text: text.replace('"version": 1', '"version": 99'), "has version 99"),
    (lambda text: text.replace('"maximum_distance_m": 6.5', '"maximum_distance_m": 650.0'), "allowed is 0.1 to 50 m"),
    (lambda text: text.replace('"status": "ok"', '"status": "good"'), "damaged"),
])
def test_bad_progress_file_is_one_sentence_and_changes_nothing(operator, monkeypatch, notice, spoil, part):
    operator.begin()
    operator.finish()
    path: pathlib.Path = operator.model.test.path
    operator.click(operator.window.protocol.done)
    spoilt = spoil(path.read_text(encoding="utf-8"))
    path.write_text(spoilt, encoding="utf-8")
    path.with_suffix(".journal").unlink()
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.ask_progress_file", lambda *_: path)
    operator.click(operator.window.welcome.open)
    operator.click(operator.window.history.file)
    operator.wait(lambda: notice)
    assert part in notice[0]
    assert operator.window.screen is operator.window.history
    assert operator.model.test is None
    assert path.read_text(encoding="utf-8") == spoilt


def test_truncated_progress_file_is_recovered_from_its_journal_and_said(operator, monkeypatch, notice):  # C1
    operator.begin()
    operator.finish()
    path: pathlib.Path = operator.model.test.path
    operator.click(operator.window.protocol.done)
    path.write_text(path.read_text(encoding="utf-8")[:1000], encoding="utf-8")
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.ask_progress_file", lambda *_: path)
    operator.click(operator.window.welcome.open)
    operator.click(operator.window.history.file)
    operator.wait(lambda: notice)
    assert "was recovered from its journal" in notice[0]
    assert operator.window.protocol.table.model().rowCount() == LINES


def test_test_that_measured_nothing_leaves_no_file(operator, opener):
    opener.car_problem = ""
    operator.begin()
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert not operator.model.results
    assert not list((operator.folder / "progress").glob("*.json"))
    assert operator.application.flow.store.settings.unfinished is None


@pytest.mark.parametrize(("scenario", "are_shown"), [("key_press", True), ("autolock", False)])
def test_lines_are_shown_for_key_press_only(operator, scenario, are_shown):
    screen = operator.begin(scenario)
    operator.wait(lambda: operator.model.total > 0 and screen.picture.lines.stretches)
    assert screen.picture.lines.is_visible is are_shown


def test_waypoint_trail_and_robot_are_in_the_picture(operator):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.wait(lambda: screen.picture.robot.waypoint is not None and screen.picture.robot.pose is not None)
    assert len(screen.picture.trail.places) > 10
    assert screen.picture.robot.key == (0.25, 0.0)


def test_robot_of_a_silent_link_is_painted_as_of_before__B1(operator, opener):
    screen = operator.begin("handle_request", border_distance_m="1.8", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    assert not screen.picture.robot.is_stale
    opener.is_silent = True
    operator.wait(lambda: screen.picture.robot.is_stale)
    operator.click(operator.window.header.stop)


def test_last_result_is_shown_after_going_on_with_a_file(operator, monkeypatch):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 2)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    path, done = operator.model.test.path, operator.model.done
    operator.click(screen.leave)
    operator.application.flow.open(path)
    assert operator.model.newest.number == done
    assert screen.facts.values["newest"].text().startswith(f"{done} (")


def test_time_left_counts_mapping_and_check__B3(operator):
    operator.begin()
    left = []
    operator.application.flow.bridge.changed.connect(
        lambda: left.append((operator.model.total and operator.model.done, operator.model.left_s)))
    operator.finish()
    prepared = next(index for index, (done, _) in enumerate(left) if done)
    assert left[0][1] is not None and left[0][1] > 17.0 + 45.0
    assert all(seconds is None or seconds > 0.0 for _, seconds in left[:prepared])


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
    operator.wait(lambda: operator.model.handle is not None and operator.model.handle.number == 2)
    assert screen.taken.isVisible() and screen.handle.isVisible()


def test_prompt_goes_when_the_car_unlocks_and_when_the_test_is_stopped(operator, opener):
    screen = operator.begin("handle_request", border_distance_m="1.0", handle_timeout_s="3600")
    operator.wait(screen.taken.isVisible)
    opener.passive = True
    operator.wait(lambda: not screen.taken.isVisible())
    opener.passive = False
    operator.wait(screen.taken.isVisible)
    assert operator.model.handle.number == 2
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
