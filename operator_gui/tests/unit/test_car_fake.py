"""The Car's substitute: timer, random number, threshold."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.car_link.fake import FakeCarLink
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import PressReport, RobotStatus


def observed(link, seconds, start_s=1.0):
    """Events of a course of Statuses at 10 Hz."""
    return [event for index in range(round(seconds * 10))
            for event in link.observe(RobotStatus(index + 1, 1, start_s + index * 0.1))]


def connected(**parameters):
    """Active substitute."""
    link = FakeCarLink(**parameters)
    link.connect()
    return link


def test_nothing_happens_while_disconnected():
    link = FakeCarLink(threshold=1.0)
    assert observed(link, 10.0) == [] and link.lock_state is LockState.UNKNOWN and link.problem
    link.connect()
    assert observed(link, 10.0)
    link.close()
    link.close()
    assert observed(link, 10.0) == []


def test_threshold_one_changes_at_each_turn_and_zero_never():
    events = observed(connected(threshold=1.0, period_s=0.5), 3.1)
    assert [event.lock_state for event in events[:2]] == [LockState.UNLOCKED, LockState.LOCKED]
    assert [event.time_s for event in events] == pytest.approx([1.5, 2.0, 2.5, 3.0, 3.5, 4.0])
    assert observed(connected(threshold=0.0), 100.0) == []


def test_threshold_sets_the_likelihood():
    assert 30 < len(observed(connected(seed=5, threshold=0.2), 200.0)) < 50


def test_same_seed_gives_the_same_events():
    assert observed(connected(seed=2), 60.0) == observed(connected(seed=2), 60.0) != observed(connected(seed=3), 60.0)


def test_state_is_that_of_the_last_event():
    link = connected(threshold=1.0)
    assert link.lock_state is LockState.LOCKED
    events = observed(link, 5.05)
    assert link.lock_state is events[-1].lock_state


def test_once_pressed_only_presses_are_turns():
    link = connected(threshold=1.0)
    presses = tuple(PressReport(number, 2.0 * number, 2.0 * number + 0.3) for number in range(1, 21))
    events = []
    for index in range(410):
        now_s = 2.0 + index * 0.1
        made = tuple(press for press in presses if press.end_s <= now_s)
        events += link.observe(RobotStatus(index + 1, 1, now_s, presses=made))
    answered = {round(event.time_s - 0.1, 6) for event in events}
    assert answered <= {press.start_s for press in presses} and 3 < len(answered) < 18


@pytest.mark.parametrize(("parameters", "words"), [
    ({"threshold": 1.5}, "threshold is 1.5; allowed is 0 to 1"), ({"period_s": 0.0}, "period_s is 0 s")])
def test_parameter_out_of_range_is_named(parameters, words):
    with pytest.raises(InvalidParameter, match=words):
        FakeCarLink(**parameters)
