"""Service mode: who enters it, the two agreements that end it, and what outlives a restart. Hazard H23"""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
import os
import stat

import pytest

from mtr_core.problems import NO_PROBLEM
from mtr_dispatcher import problems
from mtr_dispatcher.service.file import FILE_NAME, ServiceFile, recalled
from mtr_dispatcher.service.mode import NOT_IN_SERVICE, ServiceMode, random_id

RELEASE_S = 60.0
NOW_S = 1000.0
SESSION, OTHER = 5, 6
BY_OPERATOR, AT_ROBOT = problems.SERVICE_BY_OPERATOR(), problems.SERVICE_AT_ROBOT()


class Robot:
    """A service mode at work, with what it stores; an update each time."""

    def __init__(self, recall=NO_PROBLEM):
        self.stored, self.error = [], None
        numbers = itertools.count(1)
        self.mode = ServiceMode(RELEASE_S, recall, self._remember, lambda: next(numbers))
        self.update(NOW_S - 1.0)

    def _remember(self, is_active):
        if self.error is not None:
            raise self.error
        self.stored.append(is_active)

    def update(self, now_s=NOW_S, session=SESSION, stop=False):
        self.mode.update(now_s, session, stop)
        self.mode.store()
        return self

    def enter(self, cause=BY_OPERATOR):
        self.mode.enter(cause)
        self.mode.store()
        return self

    def at_robot(self, now_s=NOW_S):
        return self.mode.agree_at_robot(now_s)

    def operator(self, now_s=NOW_S, session=SESSION, mode_id=None):
        self.mode.agree_by_operator(session, self.mode.agreements[0] if mode_id is None else mode_id, now_s)
        return self

    @property
    def is_active(self):
        return bool(self.mode.problem)


@pytest.fixture
def robot():
    return Robot().enter()


def test_robot_begins_outside_service_mode_and_says_nothing_of_it():
    robot = Robot()
    assert robot.mode.state_at(NOW_S).id == NOT_IN_SERVICE.id == 0
    assert not robot.mode.state_at(NOW_S).is_active and not robot.is_active and robot.stored == []


@pytest.mark.parametrize("cause", [BY_OPERATOR, AT_ROBOT])
def test_entry_counts_at_once_is_stored_and_says_who_entered(cause):
    robot = Robot()
    robot.mode.enter(cause)
    assert robot.is_active and robot.stored == []
    robot.mode.store()
    robot.mode.store()
    state = robot.mode.state_at(NOW_S)
    assert robot.stored == [True] and state.is_active and state.id
    assert [each.code for each in state.problem.chain()] == ["dispatcher.service_mode", cause.code]
    assert math.isnan(state.robot_agrees_s) and math.isnan(state.operator_agrees_s)


@pytest.mark.parametrize("robot_first", [True, False])
def test_mode_ends_when_both_agree_in_any_order(robot, robot_first):
    for step in ("robot", "operator") if robot_first else ("operator", "robot"):
        assert robot.is_active
        if step == "robot":
            assert not robot.at_robot()
        else:
            robot.operator()
        robot.update()
    assert not robot.is_active and robot.stored == [True, False] and robot.mode.agreements == (0, False)


def test_one_agreement_alone_never_ends_it_however_often_it_is_repeated(robot):
    for second in range(100):
        robot.at_robot(NOW_S + second)
        robot.update(NOW_S + second)
    assert robot.is_active
    robot = Robot().enter()
    for second in range(100):
        robot.operator(NOW_S + second).update(NOW_S + second)
    assert robot.is_active and robot.stored == [True]


def test_agreements_from_before_the_entry_do_not_count():
    robot = Robot()
    assert robot.at_robot().code == "dispatcher.service_not_active"
    robot.operator(mode_id=1).enter().operator(mode_id=0)
    assert robot.update().is_active
    robot.operator().update()
    assert robot.is_active


@pytest.mark.parametrize("age_s, ends", [(0.0, True), (59.9, True), (60.0, False), (61.0, False), (1e6, False)])
@pytest.mark.parametrize("robot_first", [True, False])
def test_each_agreement_counts_for_its_time(robot, robot_first, age_s, ends):
    robot.at_robot() if robot_first else robot.operator()
    robot.update()
    robot.operator(NOW_S + age_s) if robot_first else robot.at_robot(NOW_S + age_s)
    robot.update(NOW_S + age_s)
    assert robot.is_active is not ends


def test_application_that_repeats_an_expired_agreement_does_not_renew_it(robot):
    mode_id = robot.mode.agreements[0]
    for tenth in range(700):
        robot.operator(NOW_S + 0.1 * tenth, mode_id=mode_id).update(NOW_S + 0.1 * tenth)
    robot.at_robot(NOW_S + 70.0)
    assert robot.update(NOW_S + 70.0).is_active and robot.mode.agreements[0] != mode_id
    robot.operator(NOW_S + 70.0).update(NOW_S + 70.0)
    assert not robot.is_active


@pytest.mark.parametrize("session", [OTHER, 0], ids=["another controls", "silent or gone"])
def test_agreement_ends_with_the_control_of_its_application(robot, session):
    mode_id = robot.mode.agreements[0]
    robot.operator().update(session=session)
    robot.at_robot()
    assert robot.update().is_active and robot.update(session=session).is_active
    assert robot.mode.agreements[0] != mode_id


def test_release_at_the_robot_needs_a_stop_that_is_released_all_the_time(robot):
    robot.update(stop=True)
    assert robot.at_robot().code == "dispatcher.service_stop_engaged"
    robot.update()
    assert not robot.at_robot()
    robot.update(stop=True).operator().update()
    assert robot.is_active
    assert not robot.at_robot() and not robot.update().is_active


def test_robot_whose_stops_are_not_known_yet_is_not_released():
    mode = ServiceMode(RELEASE_S, problems.SERVICE_RESTORED())
    assert mode.agree_at_robot(NOW_S).code == "dispatcher.service_stop_engaged"


@pytest.mark.parametrize("given", ["robot", "operator"])
def test_second_entry_withdraws_what_was_agreed(robot, given):
    mode_id = robot.mode.agreements[0]
    robot.at_robot() if given == "robot" else robot.operator()
    robot.enter(AT_ROBOT)
    assert robot.mode.agreements[0] != mode_id and robot.stored == [True]
    robot.operator() if given == "robot" else robot.at_robot()
    assert robot.update().is_active


def test_entry_that_an_application_repeats_leaves_the_number_as_it_is(robot):
    mode_id = robot.mode.agreements[0]
    assert robot.enter().enter().mode.agreements == (mode_id, False)


@pytest.mark.parametrize("wrong", [0, 2, 2 ** 63])
def test_another_number_is_no_agreement(robot, wrong):
    robot.at_robot()
    assert robot.operator(mode_id=wrong).update().is_active


def test_times_left_are_shown(robot):
    robot.at_robot(NOW_S)
    robot.update(NOW_S)
    assert robot.mode.state_at(NOW_S + 10.0).robot_agrees_s == 50.0 and robot.mode.agreements[1]
    robot = Robot().enter().operator(NOW_S)
    assert robot.mode.state_at(NOW_S + 20.0).operator_agrees_s == 40.0


def test_time_that_is_no_number_ends_nothing(robot):
    robot.at_robot(math.nan)
    robot.operator(math.nan)
    assert robot.update(math.nan).is_active


def test_entry_that_cannot_be_stored_counts_says_so_and_is_tried_again():
    robot = Robot()
    robot.error = OSError(28, "No space left on device")
    robot.enter()
    assert [each.code for each in robot.mode.problem.chain()][1:] == ["dispatcher.service_not_stored"]
    assert "No space left on device" in robot.mode.problem.text
    robot.error = None
    robot.mode.store()
    assert robot.stored == [True] and robot.mode.problem.cause.code == "dispatcher.service_by_operator"


def test_end_that_cannot_be_stored_does_not_end():
    robot = Robot().enter()
    robot.error = OSError(30, "Read-only file system")
    robot.at_robot()
    robot.operator().update()
    assert robot.is_active and "Read-only file system" in robot.mode.problem.text
    robot.error = None
    assert robot.update().is_active
    robot.at_robot()
    assert not robot.operator().update().is_active and robot.stored == [True, False]


def test_mode_that_ended_can_be_entered_again_with_another_number(robot):
    first = robot.mode.agreements[0]
    robot.at_robot()
    robot.operator().update()
    robot.enter()
    assert robot.is_active and robot.mode.agreements[0] not in (0, first) and robot.stored == [True, False, True]


# The file

def test_file_tells_a_new_process_what_holds(tmp_path):
    folder = tmp_path / "home" / "mtr_service"
    assert not ServiceFile(folder).recall()
    for is_active in (True, False, True):
        ServiceFile(folder).remember(is_active)
        assert bool(ServiceFile(folder).recall()) is is_active
    assert ServiceFile(folder).recall().code == "dispatcher.service_restored"
    assert stat.S_IMODE(os.stat(folder / FILE_NAME).st_mode) == 0o600 and os.listdir(folder) == [FILE_NAME]


@pytest.mark.parametrize("content", [b"", b"{", b"\xff\xfe", b"null", b"[]", b"{}", b'{"service_mode": 0}', b"false",
                                     b'{"service_mode": null}', b'{"service_mode": "false"}', b"[" * 100000],
                         ids=range(11))
def test_file_that_cannot_be_read_is_service_mode(tmp_path, content):
    (tmp_path / FILE_NAME).write_bytes(content)
    recall = ServiceFile(tmp_path).recall()
    assert recall.code == "dispatcher.service_unreadable"
    robot = Robot(recall)
    assert robot.is_active and robot.mode.agreements[0]


def test_folder_in_place_of_the_file_is_service_mode(tmp_path):
    (tmp_path / FILE_NAME).mkdir()
    assert ServiceFile(tmp_path).recall().code == "dispatcher.service_unreadable"


def test_loss_of_power_while_the_file_is_replaced_leaves_the_former_one(tmp_path, monkeypatch):
    ServiceFile(tmp_path).remember(True)

    def power_off(*_):
        raise OSError("power off")

    monkeypatch.setattr(os, "replace", power_off)
    with pytest.raises(OSError):
        ServiceFile(tmp_path).remember(False)
    assert ServiceFile(tmp_path).recall().code == "dispatcher.service_restored"


def test_folder_that_others_may_write_stores_nothing(tmp_path):
    tmp_path.chmod(0o777)
    with pytest.raises(OSError, match="Others may write"):
        ServiceFile(tmp_path).remember(True)


def test_restart_in_service_mode_needs_both_agreements_again(tmp_path):
    ServiceFile(tmp_path).remember(True)
    robot = Robot(ServiceFile(tmp_path).recall())
    assert robot.is_active and robot.stored == []
    robot.at_robot()
    assert robot.update().is_active
    assert not robot.operator().update().is_active and robot.stored == [False]


@pytest.mark.parametrize("stored, code", [({"run": "7", "service_mode": True}, "dispatcher.service_restored"),
                                          ({"service_mode": False}, ""),
                                          ({"run": "7"}, "dispatcher.service_unreadable"),
                                          (1, "dispatcher.service_unreadable")])
def test_anything_but_a_clear_no_is_service_mode(stored, code):
    assert recalled(stored).code == code


def test_agreement_at_the_robot_has_ended_when_its_time_is_over(robot):
    robot.at_robot()
    assert robot.update(NOW_S + RELEASE_S - 0.001).mode.agreements[1]
    assert not robot.update(NOW_S + RELEASE_S).mode.agreements[1]


def test_agreement_of_the_operator_has_ended_when_its_time_is_over(robot):
    first = robot.operator().mode.agreements[0]
    assert robot.update(NOW_S + RELEASE_S - 0.001).mode.agreements[0] == first
    assert robot.update(NOW_S + RELEASE_S).mode.agreements[0] != first


@pytest.mark.parametrize(("error", "reason"), [
    (OSError(28, "No space left on device."), "No space left on device"), (OSError("disk is gone."), "disk is gone")])
def test_reason_of_an_entry_that_cannot_be_stored_is_the_text_of_the_error(error, reason):
    robot = Robot()
    robot.error = error
    robot.enter()
    assert f"restart of the robot's software: {reason}." in robot.mode.problem.text


@pytest.mark.parametrize(("bits", "number"), [(0, 1), (-1, 2 ** 63 - 1)])
def test_id_is_never_0_and_fits_the_link(monkeypatch, bits, number):
    monkeypatch.setattr("secrets.randbits", lambda count: bits & (1 << count) - 1)
    assert random_id() == number
