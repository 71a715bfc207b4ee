"""A test goes on with the robot and the car profile with which it was begun, and its record names what it had."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import pytest

from mtr_operator import __version__
from mtr_operator.car_link.profile import PROFILE_FOLDER
from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import (
    CAR_PROFILE,
    CAR_PROFILE_FILES,
    CONTINUED,
    ROBOT,
    SOFTWARE,
    now,
    session_record,
)
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, RobotChoice
from mtr_operator.station.test import Test, go_on
from mtr_operator.storage.given_files import load_calibration
from mtr_operator.storage.means import Means
from mtr_operator.storage.recorded.folders import car_folder
from mtr_operator.storage.recorded.kept_car import digest_text, keep_car, kept_profile, profile_content

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


PROFILE, DATABASE = (((PROFILE_FOLDER / f"mtr_demo_car.{kind}").read_text().replace("mtr_demo_car.dbc", "golf.dbc"))
                     for kind in ("yaml", "dbc"))


@pytest.fixture(name="golf")
def golf_fixture(tmp_path):
    """Path of a profile with a database, and a function that says with which means it is measured."""
    path = tmp_path / "golf.yaml"
    path.write_text(PROFILE)
    path.with_name("golf.dbc").write_text(DATABASE)
    return path


def means(path, robot=BEGUN.robot):
    return Means(robot, str(path), digest_text(profile_content(str(path))))


def begun_with(path):
    begun = progress(**session_record(now(), *means(path)))
    begun.calibration = load_calibration()
    return begun


@pytest.mark.parametrize(("name", "content"), [
    ("golf.yaml", PROFILE + "# later\n"), ("golf.dbc", DATABASE + "\n"), ("golf.dbc", "")],
    ids=["profile", "database", "empty database"])
def test_profile_whose_content_has_changed_is_refused_and_the_file_is_named(golf, name, content):
    goes_on = begun_with(golf)
    means(golf).go_on(goes_on)
    golf.with_name(name).write_text(content)
    with pytest.raises(ProgressFileError, match=f"has changed since the test was begun: {name}; restore it"):
        means(golf).go_on(goes_on)


def test_same_content_by_another_path_is_the_same_profile(golf, tmp_path):
    goes_on = begun_with(golf)
    keep_car(tmp_path / "test" / "progress.json", str(golf))
    golf.write_text(PROFILE + "\n")
    means(car_folder(tmp_path / "test" / "progress.json") / "golf.yaml").go_on(goes_on)
    assert CONTINUED in goes_on.session


def test_record_says_with_what_each_part_was_measured(golf, monkeypatch):
    goes_on = begun_with(golf)
    assert goes_on.session[CAR_PROFILE_FILES].count(" ") == 3
    monkeypatch.setattr("mtr_operator.domain.results.session_record.__version__", "99.1")
    means(golf, "192.168.0.11").go_on(goes_on)
    goes_on.results.append(dataclasses.replace(goes_on.results[0], radial=2))
    means(golf).go_on(goes_on)
    second, third = goes_on.session[CONTINUED].split("; ")
    assert " after lines 1: mtr-operator 99.1, another robot, 192.168.0.11, car profile " in second
    assert goes_on.session[CAR_PROFILE_FILES] in second and "calibration record of " in second
    assert " after lines 1 to 2: mtr-operator 99.1, robot 192.168.0.10, " in third
    assert goes_on.session[SOFTWARE] == f"mtr-operator {__version__}, mtr-operator 99.1"
    assert goes_on.session[ROBOT] == "192.168.0.10, 192.168.0.11"


def test_record_names_each_adapter_of_a_test_that_goes_on():
    goes_on = progress()
    for adapter in ("slcan /dev/a, listens", "pcan, listens", "slcan /dev/a, listens"):
        goes_on.session.update(goes_on.with_earlier({"CAN adapter": adapter}))
    assert goes_on.session["CAN adapter"] == "slcan /dev/a, listens; pcan, listens"


def test_profile_is_kept_as_it_was_when_the_test_began(golf, tmp_path):
    path = tmp_path / "test" / "progress.json"
    assert {file.name for file in keep_car(path, str(golf))} == {"golf.yaml", "golf.dbc"}
    golf.write_text(PROFILE + "\n")
    assert keep_car(path, str(golf)) == []
    assert (car_folder(tmp_path / "test" / "progress.json") / "golf.yaml").read_text() == PROFILE
    assert kept_profile(path, str(golf)) == str(car_folder(tmp_path / "test" / "progress.json") / "golf.yaml")
    assert keep_car(path, "substitute") == keep_car(path, "") == keep_car(path, "no such profile") == []


def test_window_refuses_another_profile_than_the_one_connected_at_the_beginning():
    test = Test(None, None, progress(), None)
    robot = RobotChoice(BEGUN.robot)
    go_on(test, Connection(robot, CanChoice("pcan", profile="golf")))
    # Without an adapter nothing can be measured, and the sentence of that is another one.
    go_on(test, Connection(robot))
    for can in (CanChoice("pcan", profile="passat"), CanChoice(SIMULATED)):
        with pytest.raises(ProgressFileError, match="continue it"):
            go_on(test, Connection(robot, can))
