"""The firmware's clock on the robot's clock."""
# SPDX-License-Identifier: Apache-2.0
import random

import pytest

from mtr_peripherals.firmware_clock import WRAP_US, FirmwareClock, SharedClock, nearest_unwrapped_ns

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
    assert clock.robot_ns(WRAP_US - 10_000, stamp) == stamp - 50 * MS


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
    assert clock.robot_ns(WRAP_US - 1_000, stamp) == stamp - 2 * MS


@pytest.mark.parametrize("share, wraps", [(0.45, 0), (0.55, -1)])
def test_nearest_instant_is_less_than_half_a_wrap_away(share, wraps):
    time_us = int(share * WRAP_US)
    assert nearest_unwrapped_ns(time_us, 0) == (time_us + wraps * WRAP_US) * 1000


def test_instant_of_a_clock_that_starts_elsewhere_is_mapped_by_its_start():
    clock = SharedClock(5_000_000)
    assert clock.robot_ns(6_000_000, SECOND) == SECOND


def test_instant_is_mapped_though_the_robots_clock_is_hours_ahead():
    clock = FirmwareClock()
    stamp = clock.observe(2_000_000, 10_000 * SECOND)
    assert clock.robot_ns(1_000_000, stamp) == stamp - SECOND


def observed(*reports):
    """How often the firmware was taken for restarted after these (time us, arrival ns)."""
    clock = FirmwareClock()
    for time_us, arrival_ns in reports:
        clock.observe(time_us, arrival_ns)
    return clock.restarts


def test_report_that_comes_twice_is_no_restart():
    assert observed((1_000_000, SECOND), (1_000_000, SECOND + MS)) == 0


def test_clock_that_steps_back_a_little_has_started_again():
    assert observed((500_000, SECOND), (100_000, SECOND + 200 * MS)) == 1


@pytest.mark.parametrize("late_ns, restarts", [(SECOND, 0), (SECOND + MS, 1)])
def test_report_that_is_more_than_a_second_late_is_of_a_firmware_that_has_started_again(late_ns, restarts):
    assert observed((1_000_000, SECOND), (2_000_000, 2 * SECOND + late_ns)) == restarts
