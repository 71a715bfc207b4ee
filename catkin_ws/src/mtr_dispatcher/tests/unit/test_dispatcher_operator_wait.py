"""Waiting of simulated time for the Operator's application."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_dispatcher.command import Command
from mtr_dispatcher.operator_wait import OperatorWait
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.session import ControlSession

STATUS = 4


class WallClock:
    now_s = 0.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def wall():
    return WallClock()


@pytest.fixture
def wait(wall):
    return OperatorWait(5.0, wall)


def answered(status_id, **content):
    session = ControlSession(Parameters())
    session.take(Command(1, 1, status_id, 100.0), 100.0, 100.0)
    if content:
        session.take(Command(1, 2, status_id, 100.0, **content), 100.0, 100.0)
    return session


def test_without_session_it_waits_for_ever(wait, wall):
    wait.begin()
    wall.now_s = 1e6
    assert not wait.is_over(ControlSession(Parameters()), STATUS)


def test_answer_ends_the_wait(wait):
    wait.begin()
    assert not wait.is_over(answered(STATUS - 1), STATUS)
    assert wait.is_over(answered(STATUS), STATUS)


def test_goodbye_ends_the_tick_and_the_next_one_waits_for_a_session(wait):
    wait.begin()
    session = answered(STATUS, end_session=True)
    assert wait.is_over(session, STATUS)
    wait.begin()
    assert not wait.is_over(session, STATUS + 1)


def test_silent_application_is_given_up_until_it_is_received(wait, wall):
    session = answered(STATUS - 1)
    wait.begin()
    wall.now_s = 4.9
    assert not wait.is_over(session, STATUS)
    wall.now_s = 5.0
    assert wait.is_over(session, STATUS)
    wait.begin()
    assert wait.is_over(session, STATUS + 1)
    wait.received()
    assert not wait.is_over(session, STATUS + 1)
