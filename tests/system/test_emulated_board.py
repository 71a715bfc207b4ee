"""The flashed firmware under every fault of its line, with the lift moving and a button held."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from emulated_board import NS, RELEASED_US, SESSION, EmulatedBoard

from mtr_core.requests import Press
from mtr_peripherals.problems import EMERGENCY_ENGAGED

LOW_M, HIGH_M = 0.4, 1.3
HEIGHT_TOLERANCE_M = 2e-3
SAFE_WITHIN_S = 1.2
WORKING_WITHIN_S = 2.0
PRESSES = 200
HOLD_S = 0.15
LONG_HOLD_S = 8.0
ENGAGED = EMERGENCY_ENGAGED(owner="controller_input")


def press(number, hold_s=HOLD_S):
    """Press of the lock button."""
    return Press(number, SESSION, (1,), 1.0, hold_s)


@pytest.fixture
def board():
    with EmulatedBoard() as emulated:
        emulated.run(2.0, LOW_M)
        yield emulated


def test_lift_reaches_the_ordered_height(board):
    for height_m in (1.0, 0.45, 1.55, 0.35):
        board.run(10.0, height_m)
        assert board.outcome.key_height_m == pytest.approx(height_m, abs=HEIGHT_TOLERANCE_M)
        assert board.heights[-1][1] + 0.35 == pytest.approx(height_m, abs=2 * HEIGHT_TOLERANCE_M)


def test_times_of_a_press_are_those_of_the_servos_pulse(board):
    board.run(1.5, LOW_M, press(1, 0.5))
    (result,) = board.results
    full = [time_ns for time_ns, pulse in board.pulses if pulse > 1990.0]
    assert result.start_ns * NS == pytest.approx(full[0] * NS, abs=0.025)
    assert result.end_ns * NS == pytest.approx(full[-1] * NS, abs=0.045)


# Faults of the line and of the board: what is done to it, and what then makes it whole.
@pytest.mark.parametrize("fault, one_in", [("cut", 0), ("drop", 3), ("corrupt", 3)])
def test_moving_lift_and_held_button_are_safe_under_a_fault_and_work_again_after_it(board, fault, one_in):
    board.run(1.0, HIGH_M, press(1, LONG_HOLD_S))
    assert board.pulses[-1][1] > 1900.0
    moving_m = board.heights[-1][1]
    assert moving_m > board.heights[-10][1]
    board.board.fault(fault, one_in)
    board.run(SAFE_WITHIN_S, HIGH_M, press(1, LONG_HOLD_S))
    safe_m = board.heights[-1][1]
    board.run(2.0, HIGH_M, press(1, LONG_HOLD_S))
    assert max(pulse for _, pulse in board.pulses[-100:]) <= RELEASED_US + 1
    assert board.heights[-1][1] == pytest.approx(safe_m, abs=0.02), "the lift stands still"
    board.board.fault("none")
    board.run(WORKING_WITHIN_S, LOW_M)
    assert board.outcome.alive and not board.outcome.message
    assert board.heights[-1][1] < safe_m, "the lift obeys again"
    assert board.results[0].id == 1 and board.results[0].error
    board.run(1.5, LOW_M, press(2))
    assert [(result.id, result.error.text) for result in board.results[1:]] == [(2, "")]
    assert board.closings() == 2, "each press happened once"


# A program that hangs is reset by the watchdog within 0.25 s.
@pytest.mark.parametrize("fault, safe_within_s", [("reset", 0.1), ("hang", 0.4)])
def test_board_that_starts_again_is_safe_at_once_and_back_within_two_seconds(board, fault, safe_within_s):
    board.run(1.0, HIGH_M, press(1, LONG_HOLD_S))
    board.board.fault(fault)
    board.run(safe_within_s, HIGH_M)
    assert board.pulses[-1][1] <= RELEASED_US + 1
    board.run(WORKING_WITHIN_S, LOW_M)
    assert board.outcome.alive
    board.run(1.5, LOW_M, press(2))
    assert board.results[0].error and (board.results[-1].id, board.results[-1].error.text) == (2, "")
    assert board.closings() == 2


# A3: today it goes on for 0.703 m in 5 s. Braking from 0.15 m/s with 0.3 m/s2 takes 38 mm.
@pytest.mark.parametrize("stop", [{"emergency": ENGAGED}, {"stop": True}], ids=["emergency", "operator"])
def test_rising_lift_stands_within_six_centimetres_of_a_stop_and_goes_on_after_it(board, stop):
    board.run(2.0, HIGH_M)
    moving_m = board.heights[-1][1]
    board.run(SAFE_WITHIN_S, HIGH_M, **stop)
    held_m = board.heights[-1][1]
    assert held_m - moving_m < 0.06
    board.run(5.0, HIGH_M, **stop)
    assert board.heights[-1][1] == pytest.approx(held_m, abs=1e-3)
    board.run(1.0, HIGH_M)
    assert board.heights[-1][1] > held_m + 0.05


def test_held_button_is_released_by_an_emergency_stop_within_a_tenth_of_a_second_and_no_press_begins(board):  # A3
    board.run(1.0, LOW_M, press(1, LONG_HOLD_S))
    assert board.pulses[-1][1] > 1900.0
    board.run(0.1, LOW_M, press(1, LONG_HOLD_S), emergency=ENGAGED)
    assert board.pulses[-1][1] <= RELEASED_US + 1
    board.run(1.0, LOW_M, press(2), emergency=ENGAGED)
    board.run(1.0, LOW_M, press(2))
    assert board.closings() == 1
    codes = [result.error.code for result in board.results]
    assert codes == ["peripherals.press_cut_short", "peripherals.press_stopped"]


def test_press_still_ordered_after_a_restart_of_the_node_is_made_once_and_reported(board):  # A9c
    board.run(0.5, LOW_M, press(1, 1.0))
    board.restart_node()
    board.run(3.0, LOW_M, press(1, 1.0))
    assert board.closings() == 1
    assert [(result.id, result.error.text) for result in board.results] == [(1, "")]
    pressed = [time_ns for time_ns, pulse in board.pulses if pulse > 1990.0]
    assert board.results[0].start_ns * NS == pytest.approx(pressed[0] * NS, abs=0.025)


@pytest.mark.parametrize("topic", [b"/firmware/press", b"/firmware/command"])
def test_press_is_made_though_the_description_of_a_topic_was_damaged_on_the_way(board, topic):  # N1
    """Today a press ordered each 100 ms for 60 s is never made."""
    board.run(1.0, LOW_M)
    board.ask_again(topic)
    board.run(3.0, LOW_M, press(1))
    assert board.closings() == 1 and [result.error.text for result in board.results] == [""]


def test_orders_that_waited_eight_seconds_in_the_host_reach_nothing(board):  # B8
    """Today the press of 8 s ago is made."""
    board.hold_line()
    board.run(8.0, HIGH_M, press(1))
    before_m = board.heights[-1][1]
    board.release_line()
    board.run(1.0, LOW_M)
    assert board.closings() == 0 and board.results[0].error.code == "peripherals.press_late"
    assert board.heights[-1][1] == pytest.approx(before_m, abs=1e-3)


@pytest.mark.parametrize("fault, says", [("wire_break", "sensor of the lift is broken"), ("jam", "lift is jammed")])
def test_broken_sensor_and_jam_stop_the_lift_and_are_told(board, fault, says):
    board.run(0.6, HIGH_M)
    board.board.fault(fault)
    board.run(SAFE_WITHIN_S, HIGH_M)
    assert says in board.outcome.message.text
    assert abs(board.board.probe().lift_duty) == 0.0
    board.board.fault("none")
    board.run(6.0, LOW_M)
    assert not board.outcome.message
    assert board.outcome.key_height_m == pytest.approx(LOW_M, abs=HEIGHT_TOLERANCE_M)


def test_no_press_is_lost_or_doubled_while_one_byte_in_a_hundred_is_corrupted(board):
    board.board.fault("corrupt", 100)
    for number in range(1, PRESSES + 1):
        for _ in range(50):
            board.run(0.1, LOW_M, press(number))
            if board.results and board.results[-1].id == number:
                break
    assert [result.id for result in board.results] == list(range(1, PRESSES + 1))
    assert not any(result.error for result in board.results)
    assert board.closings() == PRESSES
