"""Ages and steps of the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_core.liveness import ClockWatch, Instant, is_fresh, steady_stamp_ns

SECOND_NS = 1_000_000_000
STEPS_S = [0.05, -0.05, 0.4, -0.4, 60.0, -60.0, 3600.0, -3600.0]


def at(steady_s, step_s=0.0):
    return Instant(round((1000.0 + steady_s + step_s) * SECOND_NS), round(steady_s * SECOND_NS))


@pytest.mark.parametrize("age_s, fresh", [(0.0, True), (0.5, True), (-0.5, True), (0.51, False), (-0.51, False),
                                          (-60.0, False), (math.nan, False), (math.inf, False)])
def test_message_of_the_future_or_of_no_time_is_not_fresh(age_s, fresh):  # A10
    assert is_fresh(age_s, 0.5) is fresh


@pytest.mark.parametrize("step_s", STEPS_S)
def test_step_of_the_clock_changes_no_age(step_s):  # A10
    """One message is stamped before the step and arrives after it, the next one is stamped after it."""
    in_flight = steady_stamp_ns(at(5.0).clock_ns, at(5.01, step_s), before=at(4.91))
    assert in_flight == pytest.approx(5.0 * SECOND_NS, abs=0.011 * SECOND_NS)
    after = steady_stamp_ns(at(5.1, step_s).clock_ns, at(5.11, step_s), before=at(5.01, step_s))
    assert after == pytest.approx(5.1 * SECOND_NS, abs=1000)


@pytest.mark.parametrize("step_s", [-0.4, 0.4])
def test_message_that_a_busy_machine_delays_across_a_step_is_not_of_the_future(step_s):  # A10
    in_flight = steady_stamp_ns(at(5.0).clock_ns, at(5.3, step_s), before=at(4.9))
    assert in_flight <= 5.3 * SECOND_NS
    after = steady_stamp_ns(at(5.1, step_s).clock_ns, at(5.4, step_s), before=at(5.0))
    assert after <= 5.4 * SECOND_NS


def test_message_that_is_really_old_stays_old():
    assert steady_stamp_ns(at(2.0).clock_ns, at(5.0), before=at(4.9)) == pytest.approx(2.0 * SECOND_NS, abs=1000)


@pytest.mark.parametrize("step_s", STEPS_S)
def test_every_setting_of_the_clock_is_counted_once(step_s):  # A10
    watch = ClockWatch()
    assert [watch.update(at(steady_s)) for steady_s in (1.0, 1.1, 1.2)] == [False] * 3
    assert [watch.update(at(steady_s, step_s)) for steady_s in (1.3, 1.4)] == [True, False]
    assert watch.steps == 1


def test_slewed_clock_has_not_been_set():
    watch = ClockWatch()
    for tenth in range(6000):
        watch.update(at(0.1 * tenth, step_s=0.0005 * 0.1 * tenth))
    assert watch.steps == 0


@pytest.mark.parametrize("late_ns", [0, 1_000_000, 15_000_000])
def test_two_clocks_told_for_an_instant_before_their_reading_lie_as_far_apart_as_then(late_ns):  # B4
    reading = Instant(1_700_000_000_000_000_000, 5_000_000_000)
    sent_ns = reading.clock_ns - late_ns
    assert sent_ns - reading.steady_of(sent_ns) == reading.offset_ns
