"""The pump: one answer per Status, silence, Ctrl-C, trouble."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.preparation import prepare
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.trouble import Cancelled, LineInvalid
from mtr_operator.domain.errors import ConnectionFailed, LinkLost, RobotFailed
from mtr_operator.domain.exchange.exchange import MAX_BLIND_S, POLL_PERIOD_S, RESEND_POLLS
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.robot_status import Interventions, Notification, PreflightItem, PreflightReport
from mtr_operator.domain.supervision.refusals import CHARGE_LIMIT_S

AHEAD = Ray(0.0, 0.0, 1.0, 0.0)


@pytest.fixture
def session(robot_link, car_link):
    return ControlLoop(robot_link, car_link)


def test_every_status_gets_exactly_one_answer_in_order(session, robot_link):
    for _ in range(5):
        session.step()
    session.step()
    assert [status_id for status_id, _ in robot_link.answers] == [1, 2, 3, 4, 5]


def test_decision_after_a_status_is_the_answer_to_that_status(session, robot_link):
    session.step()
    session.change(max_speed_mps=0.3)
    session.step()
    session.change(max_speed_mps=0.4)
    session.step()
    assert [(status_id, desired.max_speed_mps) for status_id, desired in robot_link.answers] == [(1, 0.3), (2, 0.4)]


def test_desired_state_is_sent_again_while_the_robot_is_silent(session, robot_link, world):
    session.step()
    world.spoil = lambda status: None if status.id < 2 + 3 * RESEND_POLLS else status
    session.step()
    assert len(robot_link.answers) == 4
    assert len({desired for _, desired in robot_link.answers}) == 1


def test_lasting_silence_is_a_lost_link(session, world):
    session.step()
    world.spoil = lambda status: None
    with pytest.raises(LinkLost, match="silent for 30 s"):
        session.step()


def test_robot_that_never_speaks_is_a_lost_link_and_says_what_came_instead(session, world, robot_link):
    world.spoil = lambda status: None
    robot_link.statistics.last_error = "A message was ignored: 3 bytes are no Status."
    with pytest.raises(LinkLost, match="no Status has come for 10 s; .* 3 bytes are no Status"):
        session.status.stamp_s  # noqa: B018


def test_wish_to_end_is_heard_after_the_next_status(robot_link, car_link):
    with pytest.raises(Cancelled):
        ControlLoop(robot_link, car_link, is_cancelled=lambda: True).step()


def test_wish_to_end_is_heard_while_the_robot_is_silent(robot_link, car_link, world):
    world.spoil = lambda status: None
    with pytest.raises(Cancelled):
        ControlLoop(robot_link, car_link, is_cancelled=lambda: True).step()


def test_halt_stops_a_moving_robot_and_answers_its_last_status(session, robot_link, world):
    robot = Robot(session)
    robot.set_maximum_speed(0.5)
    world.x = 8.0
    robot.go_to(AHEAD, 4.0, Direction.FORWARD)
    for _ in range(3):
        session.step()
    assert session.status.speed_mps > 0
    assert session.halt()
    assert session.status.speed_mps == 0
    assert robot_link.answers[-1][0] == session.status.id
    assert robot_link.answers[-1][1].stop


def test_halt_gives_up_on_a_silent_robot(session, world):
    session.step()
    world.spoil = lambda status: None
    assert session.halt() is False


def test_restart_of_the_robot_ends_the_test(session, world):
    session.step()
    world.spoil = lambda status: replace(status, robot_session_id=8)
    with pytest.raises(RobotFailed, match="started anew"):
        session.step()


def test_robot_in_other_hands_is_an_error(session, spoil, car_link):
    spoil(lambda status: True, controlled_by_other=True)
    with pytest.raises(RobotFailed, match="controlled by another application; end that one"):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert session.desired.waypoint is None
    assert session.halt() is None


def test_robot_that_another_application_takes_over_ends_the_test(session, spoil):
    spoil(lambda status: status.id <= 2, session_id=4)
    session.step()
    spoil(lambda status: status.id > 2, session_id=5, controlled_by_other=True)
    session.step()
    with pytest.raises(RobotFailed, match="taken over"):
        session.step()


def test_robot_that_is_given_free_in_time_is_prepared(session, spoil):
    spoil(lambda status: status.stamp_s < 5.0, controlled_by_other=True)
    prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert session.now_s > 5.0


FULL = PreflightReport(1.0, (PreflightItem("disk", True, "Full."),), 2, 1)
FINE = PreflightReport(1.0, (PreflightItem("disk", False, "Free."),), 2, 0)


def told(report, every=10):
    """What becomes of a Status of a robot that tells this preflight, in every tenth Status."""
    return lambda status: replace(status, sent_s=100.0 + status.stamp_s, steady_s=100.0 + status.stamp_s,
                                  preflight=None if status.id % every else report)


def test_no_test_begins_on_a_robot_whose_preflight_found_something_wrong(session, robot_link, world):
    world.spoil = told(FULL)
    with pytest.raises(RobotFailed, match=r"^No test begins, because the robot's preflight found: disk: Full\. Mend"):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


def test_no_test_begins_on_a_real_robot_without_an_emergency_stop_by_hand(session, spoil, robot_link):
    spoil(lambda status: True, notifications=(Notification("no_emergency_stop", 3, "None."),))
    with pytest.raises(RobotFailed, match="no hand-held emergency stop, so no test begins"):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert all(answer.waypoint is None and answer.key_height_m is None for _, answer in robot_link.answers)


def test_no_test_begins_on_a_robot_whose_disk_is_full(session, spoil, robot_link):
    full = Notification("disk_full", 3, "The robot's disk is full.")
    spoil(lambda status: True, notifications=(full,))
    with pytest.raises(RobotFailed, match=r"^The robot's disk is full\.$"):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


def test_no_test_begins_with_a_data_sheet_that_the_car_contradicts(session, spoil, robot_link):
    told = Notification("sheet_contradicted", 3, "The Car was found. Its data sheet is contradicted.")
    spoil(lambda status: True, notifications=(told,))
    with pytest.raises(RobotFailed, match=r"^The Car was found\. Its data sheet is contradicted\.$"):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert not any(desired.waypoint for _, desired in robot_link.answers)


@pytest.mark.parametrize("percent", [0, 9])
def test_no_test_begins_on_a_robot_whose_battery_is_nearly_empty(session, spoil, robot_link, percent):
    spoil(lambda status: True, battery_percent=percent)
    with pytest.raises(RobotFailed, match=rf"^The robot's battery is nearly empty \({percent} %\); charge it,"):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


def test_no_test_begins_on_a_robot_whose_charge_is_unknown(session, spoil, robot_link):
    spoil(lambda status: True, battery_percent=None)
    with pytest.raises(RobotFailed, match="^The robot does not report the charge of its battery; check the topic"):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert session.waited_s - 1.0 < 2.0 * CHARGE_LIMIT_S
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


def test_charge_that_comes_late_is_waited_for(session, spoil):
    spoil(lambda status: status.stamp_s < 1.0 + 0.8 * CHARGE_LIMIT_S, battery_percent=None)
    prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert session.desired.key_height_m == 1.0


@pytest.mark.parametrize("percent", [10, 100])
def test_test_begins_with_a_charge_that_suffices(session, spoil, percent):
    spoil(lambda status: True, battery_percent=percent)
    prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert session.desired.key_height_m == 1.0


@pytest.mark.parametrize("spoiled", [
    told(FINE), told(PreflightReport()), told(replace(FULL, made_s=1e6)), told(FULL, every=10**6)],
    ids=["nothing is wrong", "none was made", "of another run", "a robot of before does not tell"])
def test_test_begins_where_no_preflight_of_this_run_is_known_to_be_bad(session, world, spoiled):
    world.spoil = spoiled
    prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert session.desired.key_height_m == 1.0


@pytest.mark.parametrize(("changes", "part"), [
    ({"pose_valid": False}, "position"),
    ({"stamp_s": 5.0}, r"interrupted for 3\.\d s"),
    ({"notifications": (Notification("link_lost", 3, "Silent for 1 s."),)}, "Silent for 1 s"),
])
def test_trouble_makes_a_watched_line_invalid(session, spoil, changes, part):
    session.step()
    spoil(lambda status: status.id == 4, **changes)
    with pytest.raises(LineInvalid, match=part), session.watched():
        while session.status.id < 4:
            session.step()


def test_trouble_of_the_bus_makes_a_watched_line_invalid(session, world):
    session.step()
    world.car_problem = lambda time_s: "The bus is off." if time_s > 1.35 else ""
    with pytest.raises(LineInvalid, match="The bus is off"), session.watched():
        while session.now_s < 2.0:
            session.step()


def test_trouble_outside_of_a_measurement_is_only_told(session, spoil):
    spoil(lambda status: True, pose_valid=False)
    session.step()
    session.step()
    assert "position" in session.trouble()


def test_press_is_removed_once_it_is_confirmed_and_never_repeated(session, robot_link, world):
    robot = Robot(session)
    confirmation = robot.press(2, 1.0, 0.3)
    session.step()
    assert confirmation.id == 1
    assert robot.press(1, 1.0, 0.3).id == 2
    session.step()
    presses = [desired.press.id for _, desired in robot_link.answers if desired.press]
    assert presses == sorted(presses)
    assert robot_link.answers[-1][1].press is None
    assert len(world.presses) == 2


def test_press_that_is_never_confirmed_makes_the_line_invalid(session, spoil):
    spoil(lambda status: True, presses=())
    with pytest.raises(LineInvalid, match="did not confirm"):
        Robot(session).press(2, 1.0, 0.3)
    assert session.desired.press is None


def test_key_that_does_not_reach_its_height_is_an_error(session, spoil):
    spoil(lambda status: True, key_height_m=0.4)
    with pytest.raises(RobotFailed, match=r"height of 100 cm .* 40 cm"):
        Robot(session).move_key_to(1.0)


def test_waypoint_that_is_never_reached_makes_the_line_invalid(session, world):
    robot = Robot(session)
    robot.go_to(AHEAD, 4.0)
    world.mode = None
    session.change(stop=True)
    with pytest.raises(LineInvalid, match="did not reach"):
        robot.wait_until_reached()


def test_silent_bus_at_the_start_is_an_error(session, world):
    world.car_problem = lambda time_s: "No frame for 2 s."
    with pytest.raises(ConnectionFailed, match="No frame for 2 s"):
        Car(session).prepare()
    with pytest.raises(LinkLost, match="No frame for 2 s"):
        Car(session).wait_for_bus()


class Wish:
    """The Operator's wish to end, after so many questions for it."""

    def __init__(self, after):
        self.after = after

    def __call__(self):
        self.after -= 1
        return self.after < 0


def test_stop_leaves_within_50_ms_and_then_every_50_ms_while_the_robot_is_silent(robot_link, car_link, world):  # A6
    loop = ControlLoop(robot_link, car_link, is_cancelled=Wish(after=1 + 5))
    loop.change(max_speed_mps=0.5)
    loop.step()
    world.spoil = lambda status: None
    with pytest.raises(Cancelled):
        loop.step()
    answers = [desired for _, desired in robot_link.answers]
    first_stop = [desired.stop for desired in answers].index(True)
    # The order itself, and one repetition in the 0.25 s before the wish.
    assert first_stop == 2 and all(desired.stop for desired in answers[first_stop:])
    polls = robot_link.status_id - 1
    assert POLL_PERIOD_S == 0.05 and len(answers) - first_stop == polls - 5 - 1


def test_nothing_that_moves_is_sent_after_a_second_of_silence(session, robot_link, world):  # A5, A6
    session.change(max_speed_mps=0.5)
    session.step()
    world.spoil = lambda status: None
    with pytest.raises(LinkLost):
        session.step()
    moving = [status_id for status_id, desired in robot_link.answers if not desired.stop]
    assert (moving[-1] - 1) * POLL_PERIOD_S <= MAX_BLIND_S
    assert robot_link.answers[-1][1].stop and not session.desired.stop


def test_order_goes_on_as_it_was_after_an_interruption(session, robot_link, world):
    session.change(max_speed_mps=0.5)
    session.step()
    world.spoil = lambda status: None if status.id < 60 else status
    session.step()
    session.step()
    assert not robot_link.answers[-1][1].stop


@pytest.mark.parametrize("step_s", [-0.15, -0.4, -3600.0])
def test_robots_clock_that_is_set_back_is_no_restart(session, world, step_s):  # D7
    session.step()
    session.step()
    world.spoil = lambda status: replace(status, stamp_s=status.stamp_s + step_s,
                                         interventions=Interventions(clock_steps=1))
    session.step()
    now_s = session.step().stamp_s
    assert session.poses.at(now_s).stamp_s == now_s


def test_pose_that_becomes_valid_again_with_an_older_stamp_is_no_restart(session, world):  # D7
    session.step()
    world.spoil = lambda status: replace(status, stamp_s=status.stamp_s - 0.12)
    older = session.step()
    assert session.step().id > older.id


class Person:
    """Releases the hold that the robot says after some questions."""

    def __init__(self, after):
        self.after, self.hold_id = after, 0

    def __call__(self, _hold_id):
        self.after -= 1
        return self.hold_id if self.after < 0 else 0


def test_test_waits_while_the_robot_is_held_and_goes_on_by_the_operators_word(robot_link, car_link, world):  # A8
    person = Person(after=30)
    person.hold_id = 77
    loop = ControlLoop(robot_link, car_link, resumed_hold=person)
    loop.change(max_speed_mps=0.5)

    def held(status):
        released = world.desired is not None and world.desired.resume_hold_id == 77
        return replace(status, hold_id=0 if released else 77)
    world.spoil = held
    status = loop.step()
    assert status.hold_id == 0 and status.id > 30
    assert robot_link.answers[-1][1].resume_hold_id == 77


def test_held_test_can_be_ended(robot_link, car_link, world):  # A8
    world.spoil = lambda status: replace(status, hold_id=77)
    with pytest.raises(Cancelled):
        ControlLoop(robot_link, car_link, is_cancelled=Wish(after=10)).step()
