"""A test goes on with the robot and the car profile with which it was begun, and its record names what it had."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import CAR_PROFILE, CONTINUED, ROBOT
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, RobotChoice
from mtr_operator.station.test import Test, go_on
from mtr_operator.storage.means import Means

BEGUN = Means("192.168.0.10", "golf")


def progress(**session):
    return Progress("key_press", {}, {ROBOT: BEGUN.robot, CAR_PROFILE: BEGUN.car_profile, **session},
                    results=[KeyPressResult(1, 0.0, "ok", 5.0, None, 0.03, 1, 1.0, "")])


def test_same_means_go_on_and_the_record_says_so():
    goes_on = progress()
    BEGUN.go_on(goes_on)
    assert goes_on.session.pop(CONTINUED)
    assert goes_on.session == progress().session


@pytest.mark.parametrize(("now", "sentence"), [
    (Means(BEGUN.robot, "passat"), "begun with the car profile golf, and now it is passat"),
    (Means(BEGUN.robot, "substitute"), "begun at a real Car"),
    (Means("substitute", "golf"), "begun with a real robot"),
    (Means(SIMULATED, "golf"), "begun with a real robot"),
])
def test_other_means_are_refused_and_the_record_stays(now, sentence):
    refused = progress()
    with pytest.raises(ProgressFileError, match=sentence):
        now.go_on(refused)
    assert refused == progress()


@pytest.mark.parametrize(("session", "sentence"), [
    ({CAR_PROFILE: "substitute"}, "with the simulated Car"), ({ROBOT: "substitute"}, "with the simulated robot"),
    ({ROBOT: SIMULATED}, "with the simulated robot"), ({ROBOT: "simulated: radio"}, "with the simulated robot"),
])
def test_what_was_begun_with_a_substitute_does_not_go_on_at_the_real_one(session, sentence):
    with pytest.raises(ProgressFileError, match=sentence):
        BEGUN.go_on(progress(**session))


def test_substitute_of_the_window_and_of_the_command_line_is_the_same():
    goes_on = progress(**{ROBOT: SIMULATED, CAR_PROFILE: "substitute"})
    Means("substitute", "substitute").go_on(goes_on)
    assert goes_on.session[ROBOT] == SIMULATED


def test_record_names_each_real_robot_once():
    goes_on = progress()
    for robot in ("192.168.0.11", "192.168.0.10", "192.168.0.11"):
        Means(robot, "golf").go_on(goes_on)
    assert goes_on.session[ROBOT] == "192.168.0.10, 192.168.0.11"


@pytest.mark.parametrize("stored", [None, ""])
def test_record_that_names_no_profile_or_robot_goes_on(stored):
    old = progress()
    for name in (ROBOT, CAR_PROFILE):
        old.session.pop(name)
        if stored is not None:
            old.session[name] = stored
    Means("192.168.0.11", "passat").go_on(old)
    assert CONTINUED in old.session and not old.session.get(CAR_PROFILE)


def test_profile_by_another_path_to_the_same_file_is_the_same(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    goes_on = progress(**{CAR_PROFILE: "golf.yaml"})
    Means(BEGUN.robot, str(tmp_path / "golf.yaml")).go_on(goes_on)
    with pytest.raises(ProgressFileError, match="car profile"):
        Means(BEGUN.robot, str(tmp_path / "other" / "golf.yaml")).go_on(goes_on)


def test_test_that_has_measured_nothing_takes_what_is_there_now():
    empty = progress()
    empty.results.clear()
    Means("substitute", "passat").go_on(empty)
    assert empty.session == {ROBOT: "substitute", CAR_PROFILE: "passat"}


def test_window_refuses_another_profile_than_the_one_connected_at_the_beginning():
    test = Test(None, None, progress(), None)
    robot = RobotChoice(BEGUN.robot)
    go_on(test, Connection(robot, CanChoice("pcan", profile="golf")))
    # Without an adapter nothing can be measured, and the sentence of that is another one.
    go_on(test, Connection(robot))
    for can in (CanChoice("pcan", profile="passat"), CanChoice(SIMULATED)):
        with pytest.raises(ProgressFileError, match="continue it"):
            go_on(test, Connection(robot, can))
