"""The flashed firmware on an emulated board, in lock-step: stop input, buzzer and beacon."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from conftest import running_host
from serial_host import CUT_SHORT, REFUSED

UNUSED, CLOSED, OPEN = 0, 1, 2
SETS_OFF, REVERSES = 1, 2
LED_SETS_OFF = 10
USED = {"stop_input": 1}


@pytest.fixture
def busy_host(host):
    """A closed stop chain; the lift is on its way to 0.8 m and the lock button is held."""
    host.board.set_stop_contact("closed")
    host.signals = dict(USED)
    host.run(0.3)
    host.height_m = 0.8
    host.order_press(1, hold_ms=10_000)
    seen = host.run(1.0)
    assert seen.lift_duty > 0.5 and seen.servo_us[0] > 1999 and host.inputs[-1].stop == CLOSED
    host.inputs.clear()
    yield host


@pytest.mark.parametrize("contact", ["open", "bouncing"])
def test_open_or_bouncing_contact_stops_lift_and_servos_whatever_the_host_orders(busy_host, contact):
    before_m = busy_host.board.probe().lift_m
    busy_host.board.set_stop_contact(contact)
    busy_host.run(0.05)
    assert busy_host.inputs[-1].stop == OPEN
    seen = busy_host.run(1.5)
    assert seen.lift_duty == 0 and seen.servo_us[0] < 1001 and before_m < seen.lift_m < before_m + 0.06
    assert (busy_host.state.press_id, busy_host.state.press_state) == (1, CUT_SHORT)
    busy_host.order_press(2)
    busy_host.height_m = 0.1
    busy_host.log.clear()
    busy_host.run(2.0)
    assert all(each.lift_duty == 0 and each.servo_us[0] < 1001 for each in busy_host.log)
    assert (busy_host.state.press_id, busy_host.state.press_state) == (2, REFUSED)
    assert {each.stop for each in busy_host.inputs[3:]} == {OPEN}


def test_stop_is_reported_within_20_milliseconds_even_if_the_contact_closes_at_once(busy_host):
    busy_host.run(0.01)
    busy_host.inputs.clear()
    busy_host.board.set_stop_contact("open")
    busy_host.run(0.002, step_us=1000)
    busy_host.board.set_stop_contact("closed")
    busy_host.run(0.018, step_us=1000)
    assert [each.stop for each in busy_host.inputs] == [OPEN] and busy_host.inputs[-1].stops == 1
    busy_host.run(0.2)
    assert busy_host.inputs[-1].stop == CLOSED


def test_released_stop_lets_the_order_of_the_host_hold_again(busy_host):
    busy_host.board.set_stop_contact("open")
    busy_host.run(1.0)
    busy_host.board.set_stop_contact("closed")
    before_m = busy_host.board.probe().lift_m
    assert busy_host.run(1.0).lift_m > before_m + 0.05


def test_board_without_a_stop_chain_works_and_a_declared_one_that_is_missing_stops(mcu):
    with running_host(mcu) as host:
        host.signals = {}
        host.height_m = 0.5
        host.run(1.5)
        assert host.inputs[-1].stop == UNUSED and host.board.probe().lift_m > 0.05
        host.signals = dict(USED)
        host.run(2.0)
        assert host.inputs[-1].stop == OPEN and host.board.probe().lift_duty == 0


def test_stop_holds_over_a_reset_of_the_board(busy_host):
    busy_host.board.set_stop_contact("open")
    busy_host.run(0.5)
    busy_host.board.fault("reset")
    busy_host.log.clear()
    busy_host.run(1.0)
    assert all(abs(seen.lift_duty) == 0 for seen in busy_host.log) and busy_host.inputs[-1].stop == OPEN


def test_signals_sound_and_show_and_end_with_their_orders(host):
    host.signals = {"signal": SETS_OFF, "beacon": 1}
    host.log.clear()
    host.run(2.0)
    sounding = [seen.buzzer for seen in host.log]
    beeps = sum(later and not earlier for earlier, later in zip(sounding, sounding[1:]))
    assert beeps in (7, 8, 9) and host.log[-1].beacon
    assert {seen.led for seen in host.log[10:]} == {(True, False, False), (False, True, False)}
    assert (host.state.led_pattern, host.inputs[-1].signal, host.inputs[-1].beacon) == (LED_SETS_OFF, SETS_OFF, 1)
    host.signals = {"signal": REVERSES, "beacon": 1}
    host.log.clear()
    host.run(2.0)
    assert 90 <= sum(seen.buzzer for seen in host.log) <= 110 and host.inputs[-1].signal == REVERSES
    host.signals = None
    host.run(1.5)
    host.log.clear()
    host.run(1.0)
    assert not any(seen.buzzer for seen in host.log) and host.log[-1].beacon and host.inputs[-1].signal == 0


def test_lost_host_ends_the_signal(host):
    host.signals = {"signal": SETS_OFF}
    host.run(1.0)
    host.is_talking = False
    host.run(1.3)
    host.log.clear()
    host.run(1.0)
    assert not any(seen.buzzer for seen in host.log)
