"""A laptop that sleeps, or an application that was stopped, in the middle of a test: told, and nothing moves by it."""
# SPDX-License-Identifier: Apache-2.0
import time

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.standstill import MIN_SLEEP_S, Standstill, since_boot_s
from mtr_operator.domain.errors import StoodStill
from mtr_operator.domain.exchange.exchange import SILENCE_LIMIT_S
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import Waypoint


class Clocks:
    """Two clocks that a test sets: one that stands while the laptop sleeps, and one that does not."""

    def __init__(self):
        self.awake_s, self.passed_s = 100.0, 5000.0

    def sleep(self, duration_s):
        self.passed_s += duration_s

    def run(self, duration_s):
        self.awake_s += duration_s
        self.passed_s += duration_s

    def standstill(self, limit_s=SILENCE_LIMIT_S):
        return Standstill(limit_s, lambda: self.awake_s, lambda: self.passed_s)


@pytest.fixture
def clocks():
    return Clocks()


def test_sleep_is_told_once_with_how_long_it_was(clocks):
    standstill = clocks.standstill()
    clocks.run(0.05)
    assert standstill.look() == ""
    clocks.run(0.02)
    clocks.sleep(40.0)
    assert standstill.look() == "The laptop slept for 40 s, and the robot stood meanwhile."
    clocks.run(0.05)
    assert standstill.look() == ""


def test_process_that_was_stopped_is_told_beyond_the_limit_only(clocks):
    standstill = clocks.standstill()
    clocks.run(SILENCE_LIMIT_S - 0.1)
    assert standstill.look() == ""
    clocks.run(40.0)
    assert standstill.look() == "The application stood still for 40 s, and the robot stood meanwhile."


def test_clocks_that_are_read_one_after_the_other_are_no_sleep(clocks):
    standstill = clocks.standstill()
    clocks.sleep(0.9 * MIN_SLEEP_S)
    assert standstill.look() == ""


@pytest.mark.skipif(not hasattr(time, "CLOCK_BOOTTIME"), reason="this system has one steady clock only")
def test_clock_since_boot_is_the_one_that_counts_sleep(monkeypatch):
    monkeypatch.setattr(time, "clock_gettime", {time.CLOCK_BOOTTIME: 77.0}.get)
    assert since_boot_s() == 77.0


def test_where_there_is_one_clock_it_counts(monkeypatch):
    monkeypatch.delattr(time, "CLOCK_BOOTTIME", raising=False)
    monkeypatch.setattr(time, "monotonic", lambda: 78.0)
    assert since_boot_s() == 78.0


def sent_after(robot_link, action):
    """What is sent to the robot while a test does something."""
    before = len(robot_link.answers)
    action()
    return [desired for _, desired in robot_link.answers[before:]]


def test_test_ends_with_a_sentence_and_nothing_that_moves_leaves_after_the_sleep(robot_link, car_link, clocks):
    loop = ControlLoop(robot_link, car_link)
    loop.exchange.standstill = clocks.standstill()
    loop.step()
    loop.change(stop=False, max_speed_mps=0.5, waypoint=Waypoint(1, Pose(1.0, 0.0, 0.0)))
    loop.step()

    def wake():
        clocks.sleep(40.0)
        with pytest.raises(StoodStill, match="slept for 40 s, and the robot stood meanwhile. The line at hand is "
                                             "measured anew"):
            loop.step()
        loop.halt()
    sent = sent_after(robot_link, wake)
    assert sent and all(desired.stop for desired in sent)


def test_sleep_while_a_status_is_waited_for_is_noticed_before_it_is_answered(robot_link, car_link, clocks):
    loop = ControlLoop(robot_link, car_link)
    loop.exchange.standstill = clocks.standstill()
    loop.step()
    loop.change(stop=False)
    next_status, slept = robot_link.next_status, []

    def asleep(timeout_s):
        if not slept:
            slept.append(True)
            clocks.sleep(3600.0)
        return next_status(timeout_s)

    robot_link.next_status = asleep
    with pytest.raises(StoodStill, match="3600 s"):
        loop.step()
    sent = sent_after(robot_link, loop.halt)
    assert sent and all(desired.stop for desired in sent)
