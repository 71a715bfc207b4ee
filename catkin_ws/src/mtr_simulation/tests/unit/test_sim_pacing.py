"""Speed of the simulated clock relative to the wall clock, and its report."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_simulation.clock.pacing import Pace


def test_unlimited_pace_never_delays(clock):
    pace = Pace(0.0, clock)
    pace.start(1.0)
    assert pace.delay(100.0) == 0.0


def test_pace_delays_to_the_wanted_factor(clock):
    pace = Pace(2.0, clock)
    pace.start(1.0)
    assert pace.delay(2.0) == pytest.approx(0.5)


def test_pace_does_not_make_up_for_lost_time(clock):
    pace = Pace(1.0, clock)
    pace.start(0.0)
    clock.now_s = 10.0
    assert pace.delay(1.0) == 0.0
    assert pace.delay(2.0) == pytest.approx(1.0)


def test_pace_makes_up_for_so_much_lost_time_and_says_when_a_tick_was_due(clock):
    pace = Pace(1.0, clock, made_up_s=0.5)
    pace.start(0.0)
    clock.now_s = 1.3
    assert (pace.delay(1.0), pace.due_s) == (0.0, 1.0)
    assert (pace.delay(1.25), pace.due_s) == (0.0, 1.25)
    assert (pace.delay(1.5), pace.due_s) == (pytest.approx(0.2), 1.5)
    assert pace.lost_s == 0.0
    clock.now_s = 10.0
    assert (pace.delay(1.75), pace.due_s, pace.lost_s) == (0.0, 9.5, 7.75)


def test_pace_reports_the_factor_each_30_s(clock):
    pace = Pace(0.0, clock)
    pace.start(1.0)
    clock.now_s = 5.0
    assert pace.report(30.0) is None
    assert pace.report(31.0) == "Simulated 30.0 s in 5.0 s: 6.0 x real time"
    assert pace.report(32.0) is None
    assert pace.total(41.0) == "Simulated 40.0 s in 5.0 s: 8.0 x real time"
