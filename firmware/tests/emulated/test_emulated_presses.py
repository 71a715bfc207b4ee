"""The flashed firmware on an emulated board, in lock-step: presses are made once, as ordered, or refused."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from serial_host import CLOCK_START_US, DONE, REFUSED, press

PULSE_US = 20_000
LATE = 9
# From power on to the start of the clock; most of it marks unused RAM.
BOOT_US = {"atmega2560": 4_500, "atmega328p": 1_200}


def test_press_travels_by_strength_is_held_and_reported_with_its_times(host, mcu):
    host.log.clear()
    host.order_press(1, servos=2, strength=0.5, hold_ms=300)
    host.run(1.0, step_us=1000)
    state = host.state
    assert (state.press_id, state.press_state) == (1, DONE)
    pressed = [seen.time_us for seen in host.log if seen.servo_us[1] > 1499]
    assert {round(seen.servo_us[0]) for seen in host.log} == {1000}
    # Five pulses of the ramp, none wider than the strength allows.
    assert {round(seen.servo_us[1]) for seen in host.log} == {1000, 1100, 1200, 1300, 1400, 1500}
    to_power_on_us = BOOT_US[mcu] - CLOCK_START_US
    start_us, end_us = state.press_start_us + to_power_on_us, state.press_end_us + to_power_on_us
    # A pulse shows when it has ended; the probe looks once per ms.
    assert pressed[0] == pytest.approx(start_us + 500, abs=1000)
    assert pressed[-1] == pytest.approx(end_us - 500, abs=1000)
    assert 300_000 <= end_us - start_us + 500 <= 300_000 + PULSE_US


def test_repeated_id_presses_once(host):
    host.log.clear()
    for _ in range(20):
        host.send(press(1, host.latest_us, hold_ms=100))
        host.run(0.1)
    pressed = [seen.servo_us[0] > 1999 for seen in host.log]
    assert sum(later and not earlier for earlier, later in zip(pressed, pressed[1:])) == 1


def test_press_that_comes_late_is_refused_without_movement(host):  # B8
    host.log.clear()
    late_us = host.state.time_us - 1000
    for _ in range(3):
        host.send(press(9, late_us))
        host.run(0.2)
    assert (host.state.press_id, host.state.press_state) == (9, REFUSED)
    assert {round(width) for seen in host.log for width in seen.servo_us} == {1000}
    assert (host.healths[-1].refused_commands, host.healths[-1].last_refusal) == (1, LATE)


def test_both_servos_press_together(host):
    host.order_press(1, servos=3, strength=1.0, hold_ms=200)
    host.run(0.3)
    assert host.board.probe().servo_us == pytest.approx((2000, 2000), abs=0.5)


@pytest.mark.parametrize("fields", [{"servos": 0}, {"servos": 4}, {"strength": math.nan}, {"strength": -0.1},
                                    {"strength": 1.01}, {"hold_ms": 0}, {"hold_ms": 10_001}])
def test_impossible_press_is_refused_without_movement(host, fields):
    host.log.clear()
    host.order_press(1, **fields)
    host.run(0.5)
    assert (host.state.press_id, host.state.press_state) == (1, REFUSED)
    assert {round(width) for seen in host.log for width in seen.servo_us} == {1000}
    assert host.healths[-1].refused_commands == 1
