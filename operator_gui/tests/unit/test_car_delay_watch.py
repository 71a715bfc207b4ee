"""Stamps that arrive late together are no clock that was set: a stall of laptop or link ends with one in time."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math

import pytest

from mtr_operator.car_link.clocks.delay_watch import DelayWatch
from mtr_operator.car_link.clocks.robot_clock import RobotClock
from mtr_operator.domain.robot_status import RobotStatus

PERIOD_S, WAY_S, STEP_S = 0.1, 0.002, 0.012
BEGIN_S = 20.0


def arrivals(duration_s, period_s, stalls=()):
    """(sent, arrived) in s; what a stall (begin, end) holds back arrives one after the other at its end."""
    arrived_s = 0.0
    for index in range(round(duration_s / period_s)):
        sent_s = index * period_s
        held_s = max((end_s for begin_s, end_s in stalls if begin_s <= sent_s < end_s), default=sent_s)
        arrived_s = max(held_s + WAY_S, arrived_s + 0.001)
        yield sent_s, arrived_s


@pytest.mark.parametrize("period_s", [PERIOD_S, 0.02], ids=["Statuses", "frames"])
@pytest.mark.parametrize("length_s", [0.5, 1.1, 1.5, 3.0, 8.0])
def test_what_a_stall_held_back_is_no_step(length_s, period_s):
    watch = DelayWatch(STEP_S)
    stalls = [(BEGIN_S, BEGIN_S + length_s), (BEGIN_S + 15.0, BEGIN_S + 15.0 + length_s)]
    assert not any(watch.add(1000.0 + sent_s, arrived_s) for sent_s, arrived_s in arrivals(60.0, period_s, stalls))


@pytest.mark.parametrize("step_s", [-0.02, -0.5, -3600.0])
def test_step_back_is_noticed_within_the_patience_and_a_little(step_s):
    watch, noticed_s = DelayWatch(STEP_S), []
    for sent_s, arrived_s in arrivals(40.0, PERIOD_S):
        if watch.add(1000.0 + sent_s + step_s * (sent_s >= BEGIN_S), arrived_s):
            noticed_s.append(sent_s - BEGIN_S)
    assert len(noticed_s) == 1 and 1.0 <= noticed_s[0] <= 1.3


@pytest.mark.parametrize("step_s", [0.02, 0.5, 3600.0])
def test_step_forward_is_noticed_at_once(step_s):
    watch, noticed_s = DelayWatch(STEP_S), []
    for sent_s, arrived_s in arrivals(40.0, PERIOD_S):
        if watch.add(1000.0 + sent_s + step_s * (sent_s >= BEGIN_S), arrived_s):
            noticed_s.append(sent_s - BEGIN_S)
    assert noticed_s == [pytest.approx(0.0, abs=1e-6)]


def statuses(late_s, tells_steady_clock):
    """(Status, arrival) of a link that is slower by so much from BEGIN_S on."""
    for number, (sent_s, arrived_s) in zip(itertools.count(1), arrivals(40.0, PERIOD_S)):
        yield (RobotStatus(number, 1, 1000.0 + sent_s, sent_s=1000.0 + sent_s,
                           steady_s=70.0 + sent_s if tells_steady_clock else math.nan),
               arrived_s + late_s * (sent_s >= BEGIN_S))


@pytest.mark.parametrize("late_s", [0.05, 0.5])
def test_robot_that_tells_its_steady_clock_sets_nothing_by_a_link_that_becomes_slow(late_s):
    clock = RobotClock()
    assert not any(clock.status(status, arrival_s) for status, arrival_s in statuses(late_s, True))
    assert clock.is_real_time and clock.certain_s == math.inf


def test_of_a_robot_of_before_nobody_knows_which_it_was():
    clock = RobotClock()
    assert sum(clock.status(status, arrival_s) for status, arrival_s in statuses(0.05, False)) == 1
