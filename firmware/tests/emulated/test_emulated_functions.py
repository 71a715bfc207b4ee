"""The flashed firmware on an emulated board, in lock-step: LEDs, both stops, its clock's wrap, limits of the chip."""
# SPDX-License-Identifier: Apache-2.0
import re
import subprocess

import pytest
from conftest import FIRMWARE, HEIGHT_TOLERANCE_M, running_host
from serial_host import DONE, REFUSED, STOP, frame

FLASH_LIMIT, STATIC_RAM_LIMIT = 16 * 1024, 1024
STOPPED = 10


def test_stop_of_an_order_brakes_the_lift_releases_the_servos_and_lets_no_press_begin(host):  # A3
    host.height_m = 0.8
    host.order_press(1, hold_ms=8000)
    moving = host.run(2.0)
    assert moving.lift_duty > 0.5 and moving.servo_us[0] > 1999
    host.stop = 1
    held = host.run(1.0)
    assert held.lift_m < moving.lift_m + 0.06 and held.servo_us == pytest.approx((1000, 1000), abs=0.5)
    host.order_press(2, hold_ms=100)
    host.log.clear()
    assert host.run(1.0).lift_m == pytest.approx(held.lift_m, abs=1e-4)
    assert {round(width) for seen in host.log for width in seen.servo_us} == {1000}
    assert (host.state.press_state, host.healths[-1].last_refusal) == (REFUSED, STOPPED)
    host.stop = 0
    assert host.run(1.0).lift_m > held.lift_m + 0.05


def test_each_led_pattern_is_shown(host):
    looks = set()
    for pattern in range(10):
        host.led = pattern
        host.run(0.2)
        host.log.clear()
        host.run(2.0, step_us=25_000)
        looks.add(tuple(round(sum(seen.led[led] for seen in host.log) / len(host.log), 1) for led in range(3)))
        assert host.state.led_pattern == pattern
    assert len(looks) >= 8


def test_stop_of_the_host_stops_all_and_silences_the_board(host):
    host.height_m = 0.8
    host.order_press(1, hold_ms=5000)
    host.run(1.0)
    host.is_talking = host.answers_time = False
    host.send(frame(STOP))
    seen = host.run(0.06)
    assert seen.lift_duty == 0 and seen.servo_us == pytest.approx((1000, 1000), abs=0.5)
    sent = seen.tx
    assert host.run(2.0).tx == sent


@pytest.mark.parametrize("mcu", ["atmega328p"])
def test_clock_wrap_changes_nothing(host):
    host.run(118.0, step_us=100_000)
    assert host.state.time_us > 2 ** 31
    host.height_m = 0.2
    for id in range(1, 5):
        host.order_press(id, hold_ms=200)
        host.run(1.0)
        assert (host.state.press_id, host.state.press_state) == (id, DONE)
        held_us = (host.state.press_end_us - host.state.press_start_us) % 2 ** 32
        assert 199_000 <= held_us <= 220_000
    assert host.state.time_us < 2 ** 31
    assert host.state.lift_height_m == pytest.approx(0.2, abs=HEIGHT_TOLERANCE_M)


def test_two_runs_are_identical(mcu):
    logs = []
    for _ in range(2):
        with running_host(mcu) as host:
            host.height_m = 0.3
            host.order_press(1, servos=3, strength=0.7)
            host.board.fault("corrupt", 100)
            host.run(4.0)
            logs.append((host.log, host.states, host.healths))
    assert logs[0] == logs[1]


def test_loop_is_short_and_memory_suffices(host):
    host.height_m = 0.3
    host.order_press(1, servos=3)
    host.run(2.0)
    assert max(health.worst_loop_us for health in host.healths) < 3000
    assert min(health.free_ram for health in host.healths) > 500
    assert host.board.probe().untouched_ram == host.healths[-1].free_ram
    assert host.healths[-1].uart_overruns == host.healths[-1].dropped_bytes == host.healths[-1].dropped_reports == 0


def test_firmware_fits(mcu):
    elf = FIRMWARE / "build" / f"mtr_firmware_{mcu}.elf"
    listing = subprocess.run(["avr-size", "-A", elf], check=True, text=True, capture_output=True).stdout
    sizes = {name: int(size) for name, size in re.findall(r"^\.(\w+)\s+(\d+)", listing, re.MULTILINE)}
    assert 4000 < sizes["text"] + sizes["data"] <= FLASH_LIMIT
    assert 100 < sizes["data"] + sizes["bss"] + sizes["noinit"] <= STATIC_RAM_LIMIT
