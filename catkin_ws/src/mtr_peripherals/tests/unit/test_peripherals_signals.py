"""Warning signals, the stop input, and the count of jams."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest
from peripherals_under_test import ENGAGED, FAULT, LIVE, MS, START, TICK

from mtr_core.requests import DesiredState
from mtr_description.shipped import shipped_geometry
from mtr_msgs.msg import FirmwareInputs
from mtr_peripherals.conversions import inputs_report
from mtr_peripherals.core import Inputs, Peripherals
from mtr_peripherals.firmware import (
    GIVEN_UP,
    STOP_LATE_S,
    FirmwareReport,
    InputsReport,
    Signal,
    SignalOrder,
    StopInput,
    given_signal,
    is_stop,
    signal_order,
)
from mtr_peripherals.firmware_clock import FirmwareClock
from mtr_peripherals.key_lift import KeyLift
from mtr_peripherals.parameters import Parameters

JAMMED = 1


def outcome_of(core, inputs, now_ns=START, fault=0):
    return core.step(inputs, FirmwareReport(now_ns, fault=fault), now_ns)


@pytest.mark.parametrize("sets_off, linear_mps, signal", [
    (False, 0.0, Signal.NONE), (False, 0.3, Signal.NONE), (True, 0.0, Signal.SETS_OFF), (False, -0.01, Signal.REVERSES),
    (True, -0.3, Signal.SETS_OFF), (False, math.nan, Signal.NONE)])
def test_signal_follows_from_order_and_wheels(sets_off, linear_mps, signal):
    assert signal_order(sets_off, linear_mps, True, False).signal is signal


@pytest.mark.parametrize("sets_off, linear_mps, is_controlled, beacon", [
    (False, 0.0, False, False), (True, 0.0, False, True), (False, 0.1, False, True), (False, -0.1, False, True),
    (False, 0.0, True, True), (False, math.nan, False, True)])
def test_beacon_is_on_while_the_robot_moves_or_may_move(sets_off, linear_mps, is_controlled, beacon):
    assert signal_order(sets_off, linear_mps, is_controlled, False).has_beacon is beacon


def test_reversing_sounds_whoever_drives_and_in_a_fault(core):
    for inputs in (LIVE, Inputs(), replace(LIVE, mode=FAULT), replace(LIVE, desired=DesiredState())):
        assert outcome_of(core, replace(inputs, linear_mps=-0.1)).signals.signal is Signal.REVERSES


@pytest.mark.parametrize("used", [False, True])
def test_board_is_told_whether_a_stop_chain_is_connected(used):
    core = Peripherals(Parameters(stop_input=used), KeyLift(shipped_geometry().key()))
    for inputs in (LIVE, Inputs(), replace(LIVE, emergency=ENGAGED)):
        assert outcome_of(core, inputs).signals.uses_stop_input is used


def test_stop_input_is_not_expected_by_default():
    assert Parameters().stop_input is False and SignalOrder().uses_stop_input is False


@pytest.mark.parametrize("state", [StopInput.UNUSED.value, StopInput.OPEN.value, 3, 255])
@pytest.mark.parametrize("age_s", [0.0, STOP_LATE_S + 0.01, -1.0, 10.0, math.nan])
def test_every_state_but_closed_is_a_stop_however_old_its_report_is(state, age_s):
    assert is_stop(state, age_s) is True


@pytest.mark.parametrize("age_s, stop", [(0.0, False), (STOP_LATE_S - 0.01, False), (STOP_LATE_S + 0.01, None),
                                         (-1.0, None), (math.nan, None)])
def test_closed_input_counts_only_when_its_report_is_new(age_s, stop):
    assert is_stop(StopInput.CLOSED.value, age_s) is stop


@pytest.mark.parametrize("age_ms, signal", [(0, 1), (400, 1), (501, 0), (-600, 0)])
def test_signal_counts_as_given_while_the_board_reports_it(age_ms, signal):
    assert given_signal(InputsReport(START - age_ms * MS, Signal.SETS_OFF.value), START) == signal


def test_silent_board_gives_no_signal(core):
    assert given_signal(None, START) == 0 and outcome_of(core, LIVE).signal_given == 0
    given = outcome_of(core, replace(LIVE, board=InputsReport(START, Signal.SETS_OFF.value)))
    assert given.signal_given == Signal.SETS_OFF.value


def test_report_is_dated_by_the_firmwares_clock_without_changing_it():
    clock = FirmwareClock()
    clock.observe(1_000_000, START)
    report = inputs_report(FirmwareInputs(time_us=990_000, signal=2), START + 5 * MS, clock)
    assert report == InputsReport(START - 10 * MS, 2)
    assert clock.restarts == 0 and clock.observe(1_040_000, START + 40 * MS) == START + 40 * MS
    assert clock.restarts == 0


def test_lift_that_gave_up_is_counted_once_and_told(core):
    faults = [0, JAMMED, JAMMED, GIVEN_UP, GIVEN_UP, 0, JAMMED, 0, GIVEN_UP]
    jams = [outcome_of(core, LIVE, START + i * TICK, fault).lift_jams for i, fault in enumerate(faults)]
    assert jams == [0, 0, 0, 1, 1, 1, 1, 1, 2]
    assert outcome_of(core, LIVE, START, GIVEN_UP).message.code == "peripherals.lift_gave_up"


def test_held_robot_orders_its_lift_to_hold_and_the_resumed_one_moves_it(core):
    wanted = replace(LIVE, desired=replace(LIVE.desired, key_height_m=1.0))
    assert math.isnan(outcome_of(core, replace(wanted, is_held=True), fault=GIVEN_UP).lift_height_m)
    assert outcome_of(core, wanted).lift_height_m > 0.0
