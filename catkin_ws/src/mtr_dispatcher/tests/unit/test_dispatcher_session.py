"""Control of the robot and acceptance of Commands."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_core.problems import NO_PROBLEM
from mtr_core.requests import Press, Waypoint
from mtr_core.se2 import Pose2
from mtr_dispatcher.command import Command
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.session import REMEMBERED_SESSIONS, CommandResult, ControlSession, desired_state, is_same

NEWEST_STATUS = 10


def command(session_id=1, number=1, seen_s=100.0, **content):
    return Command(session_id=session_id, id=number, seen_status_id=NEWEST_STATUS, seen_robot_time_s=seen_s, **content)


def waypoint(x, y, heading, number=1, direction=0):
    return Waypoint(number, "application/1", "car", Pose2(x, y, heading), direction)


@pytest.fixture
def session():
    return ControlSession(Parameters())


def take(session, order, now_s=100.0):
    """Take an order; every Status up to NEWEST_STATUS was sent at the time of its stamp."""
    sent = order.seen_status_id <= NEWEST_STATUS and math.isfinite(order.seen_robot_time_s)
    return session.take(order, now_s, order.seen_robot_time_s if sent else None)


def test_without_application_the_robot_stops(session):
    desired = session.desired(100.0)
    assert (desired.session_id, desired.link_alive) == (0, False)
    assert desired.stop_reason


def test_first_command_takes_control(session):
    assert take(session, command(waypoint=waypoint(2.0, 3.0, 0.5))) is CommandResult.TAKEN
    desired = session.desired(100.0)
    assert (desired.session_id, desired.link_alive, desired.stop_reason) == (1, True, NO_PROBLEM)
    assert desired.command.waypoint == waypoint(2.0, 3.0, 0.5)


def test_repetition_keeps_the_link_alive(session):
    take(session, command())
    assert take(session, command(seen_s=100.9), 100.9) is CommandResult.REPEATED
    assert session.desired(101.8).link_alive


def test_silence_beyond_the_limit_stops_and_the_same_command_resumes(session):
    take(session, command())
    assert session.desired(100.89).stop_reason == NO_PROBLEM
    lost = session.desired(100.91)  # the next period would end after 101.0
    assert not lost.link_alive and "silent" in lost.stop_reason.text and lost.session_id == 1
    assert take(session, command(seen_s=105.0), 105.0) is CommandResult.REPEATED
    assert session.desired(105.0).stop_reason == NO_PROBLEM


@pytest.mark.parametrize("seen_s", [98.9, 101.1, math.nan, -math.inf])
def test_command_that_answers_no_recent_status_moves_nothing(session, seen_s):
    assert take(session, command(seen_s=seen_s)) is CommandResult.EXPIRED
    assert session.session_id == 0


def test_command_that_answers_a_status_never_sent_has_expired(session):
    stranger = replace(command(), seen_status_id=NEWEST_STATUS + 1)
    assert take(session, stranger) is CommandResult.EXPIRED


def test_expired_repetition_does_not_keep_the_link_alive(session):
    take(session, command())
    assert take(session, command(seen_s=100.0), 101.5) is CommandResult.EXPIRED
    assert not session.desired(101.5).link_alive


def test_older_id_is_ignored(session):
    take(session, command(number=5, max_speed_mps=0.3))
    assert take(session, command(number=4, max_speed_mps=0.9)) is CommandResult.OUTDATED
    assert session.command.max_speed_mps == 0.3


def test_second_application_is_rejected_while_the_first_is_received(session):
    take(session, command(1))
    assert take(session, command(2, seen_s=102.9), 102.9) is CommandResult.FOREIGN
    assert session.session_id == 1


def test_second_application_takes_over_after_silence(session):
    take(session, command(1, map_car_id=4))
    assert take(session, command(2, seen_s=103.1), 103.1) is CommandResult.TAKEN
    assert (session.session_id, session.command.map_car_id) == (2, 0)


def test_application_that_has_lost_control_does_not_take_it_back_by_itself(session):  # D3
    take(session, command(1, 1, waypoint=waypoint(5.0, 0.0, 0.0)))
    take(session, command(2, 1, seen_s=103.1), 103.1)
    # Its blind stop and the next order increase its id.
    for number, content in ((2, {"stop": True}), (3, {"waypoint": waypoint(5.0, 0.0, 0.0)})):
        assert take(session, command(1, number, seen_s=103.2, **content), 103.2) is CommandResult.OUTDATED
    take(session, command(2, 2, seen_s=103.3, end_session=True), 103.3)
    before = session.desired(103.4)
    assert take(session, command(1, 3, seen_s=103.4, waypoint=waypoint(5.0, 0.0, 0.0)), 103.4) is CommandResult.OUTDATED
    assert take(session, command(1, 4, seen_s=103.4, end_session=True), 103.4) is CommandResult.OUTDATED
    assert session.desired(103.4) == before and session.session_id == 0


def test_application_that_has_lost_control_has_it_again_with_a_new_session(session):
    take(session, command(1))
    take(session, command(2, seen_s=103.1), 103.1)
    assert take(session, command(3, seen_s=103.2), 103.2) is CommandResult.FOREIGN
    take(session, command(2, 2, seen_s=103.3, end_session=True), 103.3)
    assert take(session, command(3, seen_s=103.4), 103.4) is CommandResult.TAKEN


def test_goodbye_stops_the_robot_and_frees_control(session):
    take(session, command(1, waypoint=waypoint(1.0, 1.0, 0.0)))
    assert take(session, command(1, 2, end_session=True)) is CommandResult.ENDED
    assert session.desired(100.0).session_id == 0 and session.desired(100.0).command.waypoint is None
    assert take(session, command(2)) is CommandResult.TAKEN


def test_goodbye_counts_as_long_as_the_status_that_it_answers_is_remembered(session):  # D3
    take(session, command(1))
    assert take(session, command(1, 2, seen_s=math.nan, end_session=True)) is CommandResult.EXPIRED
    assert session.session_id == 1
    assert take(session, command(1, 2, seen_s=70.0, end_session=True)) is CommandResult.ENDED


def test_goodbye_of_another_application_is_ignored(session):
    take(session, command(1))
    assert take(session, command(2, 2, end_session=True)) is CommandResult.OUTDATED
    assert session.session_id == 1


def test_message_from_before_the_goodbye_does_not_take_control_again(session):
    take(session, command(1, 3))
    take(session, command(1, 4, end_session=True))
    assert take(session, command(1, 3)) is CommandResult.OUTDATED
    assert session.session_id == 0


REFUSED = {
    "nan": {"waypoint": waypoint(math.nan, 0.0, 0.0)},
    "infinite": {"waypoint": waypoint(0.0, math.inf, 0.0)},
    "heading": {"waypoint": waypoint(0.0, 0.0, math.nan)},
    "far": {"waypoint": waypoint(0.0, 101.0, 0.0)},
    "no-id": {"waypoint": waypoint(0.0, 1.0, 0.0, number=0)},
    "direction": {"waypoint": waypoint(0.0, 1.0, 0.0, direction=3)},
    "speed-zero": {"max_speed_mps": 0.0},
    "speed-high": {"max_speed_mps": 2.1},
    "speed-nan": {"max_speed_mps": math.nan},
    "height": {"key_height_m": -0.1},
    "press-without-buttons": {"press": Press(1, 1)},
    "press-strength": {"press": Press(1, 1, (1,), 1.1)},
    "press-duration": {"press": Press(1, 1, (1,), 1.0, math.inf)},
    "press-no-id": {"press": Press(0, 1, (1,))},
}


@pytest.mark.parametrize("content", REFUSED.values(), ids=list(REFUSED))
def test_unacceptable_content_stops_the_robot_until_a_good_command(session, content):
    take(session, command(1, 1))
    assert take(session, command(1, 2, **content)) is CommandResult.REFUSED
    assert "refused" in session.desired(100.0).stop_reason.text and session.desired(100.0).link_alive
    assert take(session, command(1, 2, **content)) is CommandResult.REFUSED
    assert take(session, command(1, 1)) is CommandResult.OUTDATED
    assert take(session, command(1, 3)) is CommandResult.TAKEN
    assert session.desired(100.0).stop_reason == NO_PROBLEM


def test_mapping_orders_of_two_sessions_differ(session):
    take(session, command(1, map_car_id=1))
    first = session.desired(100.0).map_order
    take(session, command(1, 2, end_session=True))
    take(session, command(2, map_car_id=1))
    second = session.desired(100.0).map_order
    assert 0 < first < second
    assert session.map_orders.id_of(2, second) == 1
    assert session.map_orders.id_of(2, first) == 0
    assert session.map_orders.id_of(1, first) == 0


def test_orders_to_check_are_numbered_on_their_own(session):
    take(session, command(1, map_car_id=1, check_car_id=5))
    first = session.desired(100.0)
    take(session, command(1, 2, map_car_id=1, check_car_id=6))
    second = session.desired(100.0)
    assert second.map_order == first.map_order and second.check_order > first.check_order
    assert session.check_orders.id_of(1, second.check_order) == 6
    assert session.check_orders.id_of(1, first.check_order) == 0


def test_repetition_asks_for_the_same(session):
    take(session, command())
    before = session.desired(100.0)
    take(session, command(seen_s=100.5), 100.5)
    assert is_same(before, session.desired(100.5))
    assert not is_same(before, session.desired(102.0))
    assert not is_same(None, before)


ACCEPTED = {
    "speed": {"max_speed_mps": 2.0},
    "height": {"key_height_m": 0.0},
    "corner": {"waypoint": waypoint(-100.0, 100.0, 4.0 * math.pi)},
    "one-button-as-softly-as-can-be": {"press": Press(1, 1, (1,), 0.0, 0.0)},
    "eight-buttons-as-firmly-and-long-as-can-be": {"press": Press(1, 1, (1, 2, 3, 4, 5, 6, 7, 8), 1.0, 10.0)},
}


@pytest.mark.parametrize("content", ACCEPTED.values(), ids=list(ACCEPTED))
def test_ends_of_the_allowed_ranges_are_acceptable(session, content):
    assert take(session, command(**content)) is CommandResult.TAKEN


@pytest.mark.parametrize("press", [Press(1, 1, (1, 0)), Press(1, 1, tuple(range(1, 10))), Press(1, 1, (1,), -0.1),
                                   Press(1, 1, (1,), 0.5, -0.1)],
                         ids=["button-zero", "nine-buttons", "strength-below-zero", "duration-below-zero"])
def test_press_just_outside_what_is_allowed_is_refused(session, press):
    assert take(session, command(press=press)) is CommandResult.REFUSED


def test_without_orders_their_numbers_are_zero(session):
    take(session, command())
    assert (session.desired(100.0).map_order, session.desired(100.0).check_order) == (0, 0)


def test_answer_of_the_former_application_does_not_count_for_the_next(session):
    assert session.answered_status_id == 0
    take(session, command(1))
    take(session, command(1, 2, end_session=True))
    take(session, replace(command(2), seen_status_id=0))
    assert session.answered_status_id == 0


def test_command_as_old_as_allowed_is_taken(session):
    assert take(session, command(seen_s=99.0)) is CommandResult.TAKEN


def test_goodbye_needs_no_new_id(session):
    take(session, command(1, 3))
    assert take(session, command(1, 3, end_session=True)) is CommandResult.ENDED


def test_goodbye_is_not_a_command_when_it_is_repeated_without_its_flag(session):
    take(session, command(1, 3))
    take(session, command(1, 4, end_session=True))
    assert take(session, command(1, 4)) is CommandResult.OUTDATED


def test_silent_application_is_followed_by_another_after_the_limit_only(session):
    take(session, command(1))
    assert take(session, command(2, seen_s=103.0), 103.0) is CommandResult.FOREIGN
    assert take(session, command(2, seen_s=103.1), 103.1) is CommandResult.TAKEN


def test_the_last_applications_are_remembered(session):
    for session_id in range(1, REMEMBERED_SESSIONS + 1):
        take(session, command(session_id))
        take(session, command(session_id, 2, end_session=True))
    assert take(session, command(1)) is CommandResult.OUTDATED
    another = REMEMBERED_SESSIONS + 1
    take(session, command(another))
    take(session, command(another, 2, end_session=True))
    assert take(session, command(2)) is CommandResult.OUTDATED
    assert take(session, command(1)) is CommandResult.TAKEN


def test_watching_application_claims_nothing_and_lets_a_person_drive(session):
    assert take(session, command(watches=True)) is CommandResult.WATCHED
    desired = session.desired(100.0)
    assert (desired.session_id, desired.link_alive, desired.stop_reason) == (0, False, NO_PROBLEM)
    # The other nodes do not move the robot either.
    assert desired_state(desired, 0.5).stop
    assert take(session, command(session_id=2)) is CommandResult.TAKEN
    assert session.session_id == 2


def test_robot_without_a_fresh_watcher_is_locked(session):
    take(session, command(watches=True))
    assert session.desired(100.89).stop_reason == NO_PROBLEM
    assert session.desired(100.91).stop_reason.code == "dispatcher.no_application"


@pytest.mark.parametrize("seen_s", [98.9, 101.1, math.nan])
def test_watcher_that_answers_no_recent_status_counts_for_nothing(session, seen_s):
    assert take(session, command(watches=True, seen_s=seen_s)) is CommandResult.OUTDATED
    assert session.desired(100.0).stop_reason.code == "dispatcher.no_application"


def test_robot_stays_with_the_application_that_was_paused_while_another_one_watches(session):
    take(session, command(stop=True))
    assert take(session, command(session_id=2, watches=True)) is CommandResult.WATCHED
    assert take(session, command(end_session=True, number=2)) is CommandResult.ENDED
    assert take(session, command(session_id=2, watches=True)) is CommandResult.WATCHED
    assert take(session, command(session_id=3, stop=True)) is CommandResult.TAKEN
    assert session.session_id == 3 and session.desired(100.0).stop_reason.code == "dispatcher.stopped_by_operator"


def test_silent_application_locks_the_robot_although_another_one_watches(session):
    take(session, command())
    take(session, command(session_id=2, watches=True, seen_s=101.0), 101.0)
    assert session.desired(101.0).stop_reason.code == "dispatcher.application_silent"


def test_watcher_answers_for_lockstep_only_while_no_application_is_in_control(session):
    take(session, command(watches=True))
    assert session.answered_status_id == NEWEST_STATUS
    take(session, command(session_id=2))
    session.answered_status_id = 0
    take(session, command(watches=True))
    assert session.answered_status_id == 0


def test_application_that_has_lost_control_may_watch(session):
    take(session, command())
    take(session, command(session_id=2, seen_s=104.0), 104.0)
    take(session, command(session_id=2, number=2, end_session=True, seen_s=104.0), 104.0)
    assert take(session, command(number=2, seen_s=104.0), 104.0) is CommandResult.OUTDATED
    assert take(session, command(number=2, watches=True, seen_s=104.0), 104.0) is CommandResult.WATCHED


def test_application_in_control_that_says_it_watches_keeps_control(session):
    take(session, command())
    assert take(session, command(number=2, watches=True)) is CommandResult.TAKEN
    assert session.session_id == 1
