"""Calls of a device's services."""
# SPDX-License-Identifier: Apache-2.0
from mtr_serial_link.calls import Calls, CallState

TIMEOUT_S = 2.0


def test_answer_belongs_to_the_call():
    calls = Calls(TIMEOUT_S)
    assert calls.begin(0.0) == ""
    calls.take(b"yes", 0.5)
    assert (calls.state(0.5), calls.answer) == (CallState.ANSWERED, b"yes")


def test_second_call_is_refused_while_the_first_is_under_way():
    calls = Calls(TIMEOUT_S)
    calls.begin(0.0)
    assert "under way" in calls.begin(1.0)


def test_late_answer_is_never_taken_for_the_next_calls():
    calls = Calls(TIMEOUT_S)
    calls.begin(0.0)
    assert calls.state(2.0) is CallState.OVERDUE
    assert "not been answered" in calls.begin(2.5)
    calls.take(b"late", 3.0)
    assert calls.begin(3.1) == "" and calls.answer is None and calls.late == 1


def test_device_that_never_answers_can_be_called_again_later():
    calls = Calls(TIMEOUT_S)
    calls.begin(0.0)
    assert calls.state(5.9) is CallState.OVERDUE
    assert calls.begin(6.1) == ""


def test_lost_link_ends_a_call():
    calls = Calls(TIMEOUT_S)
    calls.begin(0.0)
    calls.abort()
    assert calls.begin(0.1) == ""
