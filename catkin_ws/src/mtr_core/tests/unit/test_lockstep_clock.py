"""Source of the nodes' time: the robot's own clock, another simulator's, or one that waits for the nodes."""
# SPDX-License-Identifier: Apache-2.0
import time

import pytest

from mtr_core.lockstep import clock

SUSPENDED_NS = 3600 * 1_000_000_000
NOW_NS = 12_345_678_900


def test_time_for_which_the_machine_was_suspended_counts_as_age(monkeypatch):  # A1, A10
    monkeypatch.setattr(clock, "is_simulated", lambda: False)
    read, before = time.clock_gettime_ns, (clock.steady_ns(), clock.steady_at(0))
    # Clocks of Linux after a suspension: CLOCK_MONOTONIC did not advance meanwhile, CLOCK_BOOTTIME did.
    monkeypatch.setattr(time, "clock_gettime_ns",
                        lambda which: read(which) + (SUSPENDED_NS if which == time.CLOCK_BOOTTIME else 0))
    assert clock.steady_ns() - before[0] >= SUSPENDED_NS
    assert clock.steady_at(0) - before[1] >= SUSPENDED_NS


@pytest.fixture
def parameters(monkeypatch):
    known = {}
    monkeypatch.setattr(clock.rospy, "get_param", known.get)
    monkeypatch.setattr(clock, "is_simulated", lambda: True)
    monkeypatch.setattr(clock, "now_ns", lambda: NOW_NS)
    clock._is_wanted.cache_clear()
    yield known
    clock._is_wanted.cache_clear()


def test_simulated_time_alone_is_no_lockstep_and_a_tick_that_is_worked_late_is_late(parameters):
    assert not clock.is_lockstep()
    assert clock.steady_ns() == clock.steady_at(NOW_NS - 1) == NOW_NS


def test_in_lockstep_a_tick_is_a_tick_however_late_it_is_worked(parameters):
    parameters[clock.LOCKSTEP_PARAMETER] = True
    assert clock.is_lockstep()
    assert clock.steady_at(NOW_NS - 1) == NOW_NS - 1


def test_a_replay_s_clock_waits_for_ticks_and_not_for_messages(parameters):
    assert not clock.is_held()
    parameters[clock.HELD_PARAMETER] = True
    clock._is_wanted.cache_clear()
    assert clock.is_held() and not clock.is_lockstep()


@pytest.mark.parametrize("parameter", [clock.LOCKSTEP_PARAMETER, clock.HELD_PARAMETER])
def test_a_robots_own_clock_waits_for_nobody(parameter, parameters, monkeypatch):
    parameters[parameter] = True
    monkeypatch.setattr(clock, "is_simulated", lambda: False)
    assert not clock.is_lockstep() and not clock.is_held()
