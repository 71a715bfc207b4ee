"""The flashed firmware on an emulated board, in lock-step: each fault while the lift moves and a button is held."""
# SPDX-License-Identifier: Apache-2.0
import binascii
import math

import pytest
from conftest import running_host
from serial_host import CUT_SHORT, DONE

SAFE_WITHIN_S, WORKING_WITHIN_S = 1.2, 2.0
JAMMED, SENSOR_BROKEN, LINK_LOST, GIVEN_UP = 1, 2, 3, 4
LED_LINK_LOST = 8
PRESSES = 200


@pytest.fixture
def busy_host(host):
    """The lift is on its way to 0.8 m and the lock button is held."""
    host.height_m = 0.8
    host.order_press(1, hold_ms=10_000)
    seen = host.run(1.0)
    assert seen.lift_duty > 0.5 and seen.servo_us[0] > 1999
    yield host


def is_safe(seen):
    """Motor off, servos released (or without pulses)."""
    return seen.lift_duty == 0 and all(width < 1001 for width in seen.servo_us)


def assert_works(host, id):
    """The lift moves and a press is carried out within the time."""
    host.order_press(id, hold_ms=100)
    before = host.board.probe().lift_m
    host.height_m = 0.8 if before < 0.6 else 0.2
    seen = host.run(WORKING_WITHIN_S)
    assert abs(seen.lift_m - before) > 0.05
    assert (host.state.press_id, host.state.press_state) == (id, DONE)
    assert host.state.fault == 0


def assert_stays_still(host, seconds):
    before = host.board.probe().lift_m
    host.log.clear()
    host.run(seconds)
    assert all(is_safe(seen) for seen in host.log)
    assert host.board.probe().lift_m == pytest.approx(before, abs=0.02)


@pytest.mark.parametrize("way", ["silent host", "cut line"])
def test_silence_stops_all_and_its_end_lets_it_work(busy_host, way):
    if way == "cut line":
        busy_host.board.fault("cut")
    else:
        busy_host.is_talking = busy_host.answers_time = False
    assert is_safe(busy_host.run(SAFE_WITHIN_S))
    assert_stays_still(busy_host, 3.0)
    busy_host.board.fault("restore")
    busy_host.is_talking = busy_host.answers_time = True
    busy_host.run(0.15)
    assert (busy_host.state.press_id, busy_host.state.press_state) == (1, CUT_SHORT)
    assert_works(busy_host, 2)


def test_silence_is_reported_to_whoever_listens(busy_host):
    busy_host.is_talking = False
    busy_host.run(SAFE_WITHIN_S)
    assert (busy_host.state.fault, busy_host.state.led_pattern) == (LINK_LOST, LED_LINK_LOST)
    red = [seen.led for seen in busy_host.log[-20:]]
    assert all(not green and not yellow for green, yellow, _ in red)


@pytest.mark.parametrize(("fault", "cause"), [("reset", 2), ("hang", 8)])
def test_reset_and_hang_release_all_and_work_goes_on(busy_host, fault, cause):
    busy_host.log.clear()
    busy_host.board.fault(fault)
    busy_host.run(0.5)
    assert any(is_safe(seen) for seen in busy_host.log)
    # The lift goes on as commanded; the press does not, and its id does not press again.
    assert busy_host.log[-1].resets == 1
    busy_host.run(0.5)
    assert busy_host.healths[-1].reset_cause == cause and busy_host.healths[-1].resets == 2
    assert (busy_host.state.press_id, busy_host.state.press_state) == (1, CUT_SHORT)
    assert all(width < 1001 for width in busy_host.board.probe().servo_us)
    busy_host.run(0.5)
    assert_works(busy_host, 2)


def test_id_that_was_pressed_before_a_reset_is_not_pressed_again(host):
    host.order_press(1, hold_ms=100)
    host.run(1.0)
    assert host.state.press_state == DONE
    host.board.fault("reset")
    host.run(0.5)
    host.log.clear()
    host.order_press(1, hold_ms=100)
    host.run(1.0)
    assert {round(width) for seen in host.log for width in seen.servo_us} == {1000}


def test_broken_wire_stops_the_lift_alone(busy_host):
    busy_host.board.fault("wire_break")
    seen = busy_host.run(0.1)
    assert seen.lift_duty == 0 and seen.servo_us[0] > 1999
    before = seen.lift_m
    assert busy_host.run(1.1).lift_m == pytest.approx(before, abs=0.02)
    assert busy_host.state.fault == SENSOR_BROKEN and busy_host.state.lift_height_m != busy_host.state.lift_height_m
    busy_host.board.fault("none")
    busy_host.run(1.0)
    assert busy_host.state.fault == 0
    assert busy_host.run(1.0).lift_m > before + 0.05


def test_jam_switches_the_motor_off_and_is_tried_again(busy_host):
    busy_host.board.fault("jam")
    assert busy_host.run(0.6).lift_duty == 0
    assert busy_host.state.fault == JAMMED
    before = busy_host.board.probe().lift_m
    busy_host.board.fault("none")
    assert busy_host.run(WORKING_WITHIN_S).lift_m > before + 0.05
    assert busy_host.state.fault == 0


def test_lasting_jam_is_tried_once_more_and_then_waits_for_the_host(busy_host):
    busy_host.board.fault("jam")
    busy_host.log.clear()
    busy_host.run(2.5)
    pushing = [seen.lift_duty != 0 for seen in busy_host.log]
    assert sum(later and not earlier for earlier, later in zip(pushing, pushing[1:])) == 1
    assert busy_host.state.fault == GIVEN_UP
    busy_host.board.fault("none")
    for height_m in (0.7, 0.2, 0.8):
        busy_host.height_m = height_m
        busy_host.log.clear()
        busy_host.run(1.5)
        assert all(seen.lift_duty == 0 for seen in busy_host.log) and busy_host.state.fault == GIVEN_UP
    before = busy_host.board.probe().lift_m
    busy_host.height_m = math.nan
    busy_host.run(0.3)
    assert busy_host.state.fault == 0
    busy_host.height_m = 0.7
    assert busy_host.run(WORKING_WITHIN_S).lift_m > before + 0.05


def test_silent_host_is_no_decision_to_try_again(busy_host):
    busy_host.board.fault("jam")
    busy_host.run(2.5)
    busy_host.board.fault("none")
    busy_host.is_talking = False
    busy_host.run(1.5)
    assert busy_host.state.fault == LINK_LOST
    busy_host.is_talking = True
    busy_host.log.clear()
    busy_host.run(2.0)
    assert all(seen.lift_duty == 0 for seen in busy_host.log) and busy_host.state.fault == GIVEN_UP


@pytest.mark.parametrize("fault", ["drop", "corrupt"])
def test_bad_line_neither_stops_nor_moves_anything(busy_host, fault):
    busy_host.board.fault(fault, 100)
    busy_host.run(4.0)
    assert busy_host.board.probe().servo_us[0] > 1999
    busy_host.height_m = 0.3
    busy_host.run(6.0)
    assert busy_host.board.probe().lift_m == pytest.approx(0.3, abs=0.002)
    assert busy_host.healths[-1].checksum_errors + busy_host.healths[-1].skipped_frames > 5


def test_no_press_is_lost_or_doubled_over_a_bad_line(mcu):
    with running_host(mcu) as host:
        host.run(0.5)
        host.board.fault("corrupt", 100)
        presses = 0
        for id in range(1, PRESSES + 1):
            host.log.clear()
            host.order_press(id, servos=1 + id % 2, hold_ms=40)
            for _ in range(40):
                host.run(0.1, step_us=20_000)
                if (host.state.press_id, host.state.press_state) == (id, DONE):
                    break
            assert host.state.press_id == id
            pressed = [max(seen.servo_us) > 1999 for seen in host.log]
            presses += sum(later and not earlier for earlier, later in zip([False, *pressed], pressed))
        assert presses == PRESSES
        assert host.healths[-1].checksum_errors > 20


def test_damaged_calibration_is_repaired_from_its_copy(mcu, tmp_path):
    file = tmp_path / "eeprom"
    options = ["--eeprom", str(file)]
    record = bytes.fromhex("bc02 2823 2003")  # 700, 9000, 800 mm
    crc = binascii.crc_hqx(record, 0xFFFF).to_bytes(2, "little")
    file.write_bytes(b"\xff" * 8 + record + crc)
    for copies in (1, 2):
        with running_host(mcu, options=options) as host:
            host.run(1.0)
            assert (host.healths[-1].calibration_copies, host.healths[-1].stroke_mm) == (copies, 800)


