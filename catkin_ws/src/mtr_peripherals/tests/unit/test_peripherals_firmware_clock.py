"""Conversion of the firmware's clock to the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
import random

import pytest

from mtr_core.liveness import Instant
from mtr_peripherals.firmware_clock import WRAP_US, FirmwareClock, RobotClock, SharedClock, nearest_unwrapped_ns

MS = 1_000_000
SECOND = 1_000 * MS


@pytest.mark.parametrize("true_us, near_us", [(5, 0), (WRAP_US + 5, WRAP_US), (WRAP_US - 5, WRAP_US + 20_000),
                                              (7 * WRAP_US + 1, 7 * WRAP_US - 20_000)])
def test_nearest_instant_is_found_across_the_wrap(true_us, near_us):
    assert nearest_unwrapped_ns(true_us % WRAP_US, near_us * 1000) == true_us * 1000


def test_shared_clock_gives_the_firmwares_own_tick_however_late_the_message_is_read():
    clock = SharedClock()
    stamp = (WRAP_US + 40_000) * 1000
    for late_ns in (-20 * MS, 0, 15 * MS):
        assert clock.observe(40_000, stamp + late_ns) == stamp
    assert clock.steady_ns(WRAP_US - 10_000, stamp) == stamp - 50 * MS


def test_shared_clock_that_starts_elsewhere_is_mapped_by_its_start():
    clock = SharedClock(WRAP_US - 120_000_000)
    assert clock.observe(WRAP_US - 119_000_000, 1010 * MS) == SECOND
    assert clock.observe(5_000_000, 125 * SECOND) == 125 * SECOND


def run(clock, start_us, rate, seconds, robot_start=1000 * SECOND):
    """Feed 25 messages a second with 2 to 12 ms delay; returns the largest error of the last half, in ns."""
    random.seed(1)
    worst = 0
    for i in range(25 * seconds):
        sent = robot_start + i * 40 * MS
        time_us = int(start_us + rate * (sent - robot_start) / 1000) % WRAP_US
        stamp = clock.observe(time_us, sent + random.randint(2 * MS, 12 * MS))
        if i > 25 * seconds // 2:
            worst = max(worst, abs(stamp - sent - 2 * MS))
    return worst


@pytest.mark.parametrize("rate", [0.995, 1.0, 1.005])
@pytest.mark.parametrize("start_us", [0, WRAP_US - 5_000_000], ids=["from-zero", "across-the-wrap"])
def test_jitter_and_drift_cost_a_few_milliseconds(rate, start_us):
    clock = FirmwareClock()
    assert run(clock, start_us, rate, 20) < 8 * MS
    assert clock.restarts == 0


def test_restarted_firmware_is_noticed_and_mapped_anew():
    clock = FirmwareClock()
    run(clock, 50_000_000, 1.0, 10)
    assert run(clock, 0, 1.0, 10, robot_start=1020 * SECOND) < 8 * MS
    assert clock.restarts == 1


def test_instant_near_a_report_is_mapped_with_it():
    clock = FirmwareClock()
    stamp = clock.observe(1_000, 500 * SECOND)
    assert clock.steady_ns(WRAP_US - 1_000, stamp) == stamp - 2 * MS


@pytest.mark.parametrize("share, wraps", [(0.45, 0), (0.55, -1)])
def test_nearest_instant_is_less_than_half_a_wrap_away(share, wraps):
    time_us = int(share * WRAP_US)
    assert nearest_unwrapped_ns(time_us, 0) == (time_us + wraps * WRAP_US) * 1000


def test_instant_of_a_clock_that_starts_elsewhere_is_mapped_by_its_start():
    clock = SharedClock(5_000_000)
    assert clock.steady_ns(6_000_000, SECOND) == SECOND


def test_instant_is_mapped_though_the_robots_clock_is_hours_ahead():
    clock = FirmwareClock()
    stamp = clock.observe(2_000_000, 10_000 * SECOND)
    assert clock.steady_ns(1_000_000, stamp) == stamp - SECOND


def observed(*reports):
    """Return the number of detected restarts after these reports (time us, arrival ns)."""
    clock = FirmwareClock()
    for time_us, arrival_ns in reports:
        clock.observe(time_us, arrival_ns)
    return clock.restarts


def test_report_that_comes_twice_is_no_restart():
    assert observed((1_000_000, SECOND), (1_000_000, SECOND + MS)) == 0


def test_clock_that_steps_back_a_little_has_started_again():
    assert observed((500_000, SECOND), (100_000, SECOND + 200 * MS)) == 1


def test_report_that_waited_on_the_way_is_as_old_as_it_is_and_no_restart():  # A10
    clock = FirmwareClock()
    clock.observe(1_000_000, SECOND)
    for late_ns in (SECOND, SECOND + MS, 3 * SECOND):
        assert clock.observe(2_000_000, 2 * SECOND + late_ns) < 2 * SECOND + 40 * MS
    assert clock.restarts == 0


def test_reports_that_all_come_late_for_five_seconds_are_mapped_anew():
    clock = FirmwareClock()
    clock.observe(1_000_000, SECOND)
    stamps = [clock.observe(1_000_000 + 40_000 * i, 3 * SECOND + 40 * i * MS) for i in range(150)]
    assert stamps[10] < 2 * SECOND and stamps[-1] > 8 * SECOND


@pytest.mark.parametrize("early_ns, restarts", [(SECOND, 0), (SECOND + MS, 1)])
def test_clock_that_is_a_second_ahead_of_its_own_time_has_started_again(early_ns, restarts):
    assert observed((1_000_000, 10 * SECOND), (1_000_000 + 5_000_000, 15 * SECOND - early_ns)) == restarts


def test_time_of_the_firmware_is_told_across_the_wrap_and_unknown_before_its_first_message():  # B8
    clock = FirmwareClock()
    assert clock.firmware_us(SECOND) is None
    clock.observe(WRAP_US - 400_000, 10 * SECOND)
    assert clock.firmware_us(10 * SECOND + 500 * MS) == 100_000
    assert SharedClock(WRAP_US - 1).firmware_us(SECOND) == 999_999


@pytest.mark.parametrize("step_s", [-3600.0, -0.4, -0.05, -0.02, 0.02, 0.05, 0.4, 3600.0])
def test_step_of_the_robots_clock_moves_a_press_by_that_step_and_by_nothing_else(step_s):  # A10, B4
    """Press times must be correct at once after a step of the robot's clock, not only after an adaptation."""
    firmware, robot, step_ns = FirmwareClock(), RobotClock(), int(step_s * SECOND)
    for i in range(250):
        steady_ns = 500 * SECOND + i * 40 * MS
        robot.update(Instant(steady_ns + 10 ** 18 + (step_ns if i >= 249 else 0), steady_ns))
        stamp_ns = firmware.observe(7_000_000 + i * 40_000, steady_ns + 3 * MS)
    press_ns = robot.robot_ns(firmware.steady_ns(7_000_000 + 249 * 40_000 - 100_000, stamp_ns))
    true_ns = 500 * SECOND + 249 * 40 * MS - 100 * MS + 10 ** 18 + step_ns
    assert abs(press_ns - true_ns) <= 5 * MS


def test_jitter_of_two_readings_does_not_move_the_times_of_a_press():
    robot = RobotClock()
    robot.update(Instant(1_000 * SECOND, SECOND))
    robot.update(Instant(1_001 * SECOND + MS, 2 * SECOND))
    assert robot.robot_ns(SECOND) == 1_000 * SECOND
