"""Emergency stops: engaged, silent, required, and released."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_peripherals.emergency import EmergencyStops, EmergencyWord

SECOND = 1_000_000_000
START = 100 * SECOND
PRESSED = Problem("controller_input.pressed", "The emergency stop is pressed.")


def word(reason=NO_PROBLEM, at_ns=START, owner="remote", emergency=True):
    return EmergencyWord(owner, reason, at_ns, emergency)


def test_robot_without_an_emergency_stop_may_move():
    assert not EmergencyStops((), 0.5).reason(START)


def test_required_one_that_was_never_heard_is_engaged():  # A3
    assert "remote was not heard" in EmergencyStops(("remote",), 0.5).reason(START).text


@pytest.mark.parametrize("required", [(), ("remote",)])
def test_engaged_one_stops_until_it_is_released(required):  # A3
    stops = EmergencyStops(required, 0.5)
    stops.take(word())
    assert not stops.reason(START)
    assert stops.take(word(PRESSED)) and not stops.take(word(PRESSED))
    assert PRESSED.text in stops.reason(START).text
    assert PRESSED.text in stops.reason(START + 60 * SECOND).text, "silence releases nothing"
    later = START + 60 * SECOND
    assert not stops.take(word(PRESSED, later)) and not stops.take(word(at_ns=later + SECOND // 10))
    assert not stops.reason(later + SECOND // 10)


@pytest.mark.parametrize("required", [(), ("remote",)])
def test_engaged_one_of_an_owner_that_restarts_and_says_nothing_of_it_stays_engaged(required):  # A4
    stops = EmergencyStops(required, 0.5)
    stops.take(word(PRESSED))
    for at_ns in range(START + 2 * SECOND, START + 12 * SECOND, SECOND // 10):
        assert not stops.take(word(at_ns=at_ns))
        assert "engage it and release it again" in stops.reason(at_ns).text


def test_engaged_one_of_an_owner_that_restarted_is_released_after_it_was_engaged_anew():  # A4
    stops = EmergencyStops((), 0.5)
    anew = START + 3 * SECOND
    for said in (word(PRESSED), word(at_ns=START + 2 * SECOND), word(PRESSED, anew), word(at_ns=anew + SECOND // 10)):
        stops.take(said)
    assert not stops.reason(anew + SECOND // 10)


def test_required_owner_that_begins_engaged_stops_lift_and_servos_with_its_first_word():
    assert EmergencyStops(("remote",), 0.5).take(word(PRESSED))


@pytest.mark.parametrize("age_s, engaged", [(0.5, False), (0.51, True), (-0.51, True)])
def test_one_that_was_heard_once_and_falls_silent_is_engaged(age_s, engaged):  # A3
    stops = EmergencyStops((), 0.5)
    stops.take(word())
    assert bool(stops.reason(START + int(age_s * SECOND))) is engaged


def test_motion_lock_that_is_no_emergency_stop_does_not_hold_the_lift():
    stops = EmergencyStops((), 0.5)
    assert not stops.take(word(PRESSED, emergency=False)) and not stops.reason(START)


def test_required_owner_counts_whether_or_not_it_calls_itself_an_emergency_stop():
    stops = EmergencyStops(("remote",), 0.5)
    stops.take(word(emergency=False))
    assert not stops.reason(START)
    assert stops.take(word(PRESSED, emergency=False)) and stops.reason(START)
