"""The flashed firmware on an emulated board, in lock-step: lift, servos, LEDs, negotiation, limits."""
# SPDX-License-Identifier: Apache-2.0
import math
import re
import statistics
import subprocess

import pytest
from conftest import FIRMWARE, running_host
from serial_host import (
    CLOCK_START_US,
    COMMAND,
    PRESS,
    STATE,
    STOP,
    SUBSCRIBER,
    Host,
    calibrate,
    command,
    frame,
    press,
)

from mtr_emulator import Emulator

FLASH_LIMIT, STATIC_RAM_LIMIT = 16 * 1024, 1024
HEIGHT_TOLERANCE_M = 0.002
PULSE_US = 20_000
DONE, REFUSED = 2, 3
LATE, STOPPED = 9, 10
# From power on to the start of the clock; most of it marks unused RAM.
BOOT_US = {"atmega2560": 4_500, "atmega328p": 1_200}


def settled(host, height_m, limit_s=12.0):
    """True height after the lift has come to rest; None when it does not within the time."""
    host.height_m = height_m
    host.run(0.2)
    for _ in range(int(limit_s / 0.2)):
        seen = host.run(0.2)
        if host.state.lift_state == 0:
            return seen.lift_m
    return None


def test_host_is_told_all_topics(host):
    names = {topic: (found.kind, found.name, found.type) for topic, found in host.topics.items()}
    assert names[COMMAND] == (SUBSCRIBER, "/firmware/command", "mtr_msgs/FirmwareCommand")
    assert names[STATE] == (0, "/firmware/state", "mtr_msgs/FirmwareState")
    assert len(names) == 6


def test_host_that_comes_late_is_told_all_topics_soon(mcu):
    with Emulator(mcu, stepped=True) as board:
        board.step(3_333_000)
        host = Host(board)
        host.run(0.5)
        assert len(host.topics) == 6 and len(host.states) > 2
        host.close()


def test_md5_sums_are_those_of_the_built_messages(host):
    messages = pytest.importorskip("mtr_msgs.msg")
    for topic in host.topics.values():
        assert topic.md5 == getattr(messages, topic.type.split("/")[1])._md5sum


def test_reports_come_in_time(host):
    host.states.clear()
    host.healths.clear()
    host.echoes.clear()
    host.run(2.0)
    times = [state.time_us for state in host.states]
    gaps = {round((later - earlier) / 1000) for earlier, later in zip(times, times[1:])}
    assert len(times) in (49, 50, 51) and gaps <= {39, 40, 41}
    assert len(host.healths) in (9, 10, 11)
    assert len(host.echoes) in (19, 20, 21)


def test_half_of_the_echoes_come_within_six_milliseconds(host):
    host.is_talking = False
    waits_ms = []
    for seq in range(40):
        host.run(0.053, step_us=1000)
        host.echoes.clear()
        host.send(command(seq, math.nan, host.latest_us))
        waits_ms.append(0.0)
        while not host.echoes and waits_ms[-1] < 50.0:
            host.run(0.0005, step_us=500)
            waits_ms[-1] += 0.5
        assert host.echoes == [seq]
    # The others wait behind a state report (8.9 ms on the line), the worst behind a health report too.
    assert statistics.median(waits_ms) <= 6.0 and max(waits_ms) <= 25.0


@pytest.mark.parametrize("heights_m", [(0.06, 0.061, 0.055), (1.2, 0.0), (0.7, 0.3)])
def test_lift_reaches_heights_within_two_millimetres(host, heights_m):
    for height_m in heights_m:
        assert settled(host, height_m) == pytest.approx(height_m, abs=HEIGHT_TOLERANCE_M)
        assert host.state.lift_height_m == pytest.approx(height_m, abs=HEIGHT_TOLERANCE_M)
        assert host.state.fault == 0


def test_lift_keeps_to_its_speed_and_acceleration(host):
    host.log.clear()
    settled(host, 0.6)
    heights = [seen.lift_m for seen in host.log]
    speeds = [(later - earlier) / 0.01 for earlier, later in zip(heights, heights[1:])]
    assert 0.13 < max(speeds) < 0.175
    assert max(abs(later - earlier) for earlier, later in zip(speeds, speeds[10:])) < 0.06


def test_lift_goes_the_other_way_when_the_height_changes_on_the_way(host):
    host.height_m = 0.8
    host.run(2.0)
    assert settled(host, 0.1) == pytest.approx(0.1, abs=HEIGHT_TOLERANCE_M)


def test_nan_holds_the_lift_still(host):
    host.height_m = 0.8
    before = host.run(2.0)
    host.height_m = math.nan
    held = host.run(1.0)
    assert before.lift_m < held.lift_m < before.lift_m + 0.06
    assert host.run(1.0).lift_m == pytest.approx(held.lift_m, abs=1e-4)


@pytest.mark.parametrize("height_m", [-0.01, 1.21, 1e9, math.inf, -math.inf])
def test_impossible_height_is_refused_without_movement(host, height_m):
    before = host.board.probe().lift_m
    host.height_m = height_m
    assert host.run(1.0).lift_m == before
    assert host.healths[-1].refused_commands >= 8 and host.healths[-1].last_refusal == 1


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


def test_unknown_topics_and_oversized_frames_are_skipped(host):
    host.send(frame(999, b"abc") + frame(COMMAND, bytes(2000)) + frame(PRESS, b"\xff" * 24))
    host.run(0.6)
    assert host.healths[-1].skipped_frames >= 3
    assert host.state.fault == 0 and host.state.press_id == 0
    host.states.clear()
    host.run(0.5)
    assert len(host.states) > 10


def test_wrong_crc_inside_a_good_frame_is_not_obeyed(host):
    good = press(1, host.latest_us)
    host.send(frame(PRESS, good[7:-2] + bytes([good[-2] ^ 1])))
    host.run(0.5)
    assert host.state.press_id == 0 and host.healths[-1].checksum_errors == 1


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


def test_calibration_finds_the_stops_and_outlives_power_off(mcu, tmp_path):
    options = ["--low-mv", "600", "--high-mv", "4200", "--stroke-m", "0.4", "--eeprom", str(tmp_path / "eeprom")]
    with running_host(mcu, options=options) as host:
        host.height_m = 0.1
        host.run(0.5)
        for _ in range(300):
            host.send(calibrate(1, 0.4, host.latest_us))
            host.run(0.2)
            if host.state.calibration_state != 1:
                break
        assert (host.state.calibration_id, host.state.calibration_state) == (1, 2)
        assert settled(host, 0.25) == pytest.approx(0.25, abs=HEIGHT_TOLERANCE_M)
    with running_host(mcu, options=options) as host:
        assert settled(host, 0.25) == pytest.approx(0.25, abs=HEIGHT_TOLERANCE_M)
        assert (host.healths[-1].calibration_copies, host.healths[-1].stroke_mm) == (2, 400)
        assert host.healths[-1].resets == 2


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
