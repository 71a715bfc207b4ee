"""Precedence of the orders that move the lift, and the causes that stop it for all of them."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest
from peripherals_under_test import (
    ENGAGED,
    FAULT,
    FOLLOWING,
    LIVE,
    START,
    STARTING,
    TICK,
    FakeFirmware,
    desired,
    run,
)

from mtr_peripherals.core import Inputs
from mtr_peripherals.firmware import FirmwareReport


def test_lift_follows_the_live_order_and_holds_while_the_operator_stops_the_robot_or_is_silent(core):  # A3
    firmware = FakeFirmware()
    assert run(core, desired(key_height_m=1.0), firmware, 1).lift_height_m == pytest.approx(0.65)
    for changes in ({"stop": True}, {"link_alive": False}):
        assert math.isnan(run(core, desired(key_height_m=1.0, **changes), firmware, 1).lift_height_m)


def test_lift_of_a_robot_that_is_held_stands_for_the_application_and_moves_by_hand(core):  # F5
    held, firmware = replace(desired(key_height_m=1.0), is_held=True), FakeFirmware()
    assert math.isnan(run(core, held, firmware, 1).lift_height_m)
    assert not math.isnan(run(core, replace(held, manual_lift_mps=0.1), firmware, 1).lift_height_m)
    assert run(core, replace(held, is_held=False), firmware, 1).lift_height_m == pytest.approx(0.65)


@pytest.mark.parametrize("mode", [STARTING, FAULT])
def test_lift_stands_where_the_state_of_the_robot_is_a_fault_or_not_known_and_moves_by_hand(core, mode):
    faulty, firmware = replace(desired(key_height_m=1.0), mode=mode), FakeFirmware()
    assert math.isnan(run(core, faulty, firmware, 1).lift_height_m)
    assert not math.isnan(run(core, replace(faulty, manual_lift_mps=0.1), firmware, 1).lift_height_m)
    assert run(core, replace(faulty, mode=FOLLOWING), firmware, 1).lift_height_m == pytest.approx(0.65)


def test_lift_stands_while_its_board_is_silent(core):
    wanted, report = desired(key_height_m=1.0), FirmwareReport(START)
    assert not math.isnan(core.step(wanted, report, START + 5 * TICK).lift_height_m)
    for inputs in (wanted, replace(wanted, manual_lift_mps=0.1)):
        outcome = core.step(inputs, report, START + 12 * TICK)
        assert math.isnan(outcome.lift_height_m) and not outcome.alive


@pytest.mark.parametrize("inputs", [desired(key_height_m=1.0), replace(LIVE, manual_lift_mps=0.1),
                                    Inputs(calibrates=True)], ids=["operator", "manual", "calibration"])
def test_emergency_stop_holds_the_lift_whoever_moves_it_and_releases_the_servos(core, inputs):  # A3
    report = FirmwareReport(START, is_calibrating=inputs.calibrates)
    assert not math.isnan(core.step(inputs, report, START).lift_height_m)
    outcome = core.step(replace(inputs, emergency=ENGAGED), report, START)
    assert math.isnan(outcome.lift_height_m) and outcome.stop and outcome.message == ENGAGED
    after = core.step(inputs, report, START)
    assert not after.stop and not math.isnan(after.lift_height_m), "the order still holds"


def test_times_that_the_manual_controller_takes_the_lift_are_counted(core):
    manual = replace(LIVE, manual_lift_mps=0.1)
    counts = [core.step(inputs, FirmwareReport(START), START).manual_lifts
              for inputs in (LIVE, manual, manual, LIVE, manual)]
    assert counts == [0, 1, 1, 1, 2]


def test_height_out_of_range_holds_the_lift_and_says_why(core):
    outcome = run(core, desired(key_height_m=2.0), FakeFirmware(), 1)
    assert math.isnan(outcome.lift_height_m) and "2 m" in outcome.message.text and outcome.alive


def test_reported_height_is_above_ground(core):
    outcome = core.step(LIVE, FirmwareReport(START, lift_height_m=0.5), START)
    assert outcome.key_height_m == pytest.approx(0.85) and outcome.lift_now_m == 0.5


@pytest.mark.parametrize("rate_mps, wanted_m", [(0.1, 0.43), (-0.1, 0.37)])
def test_manual_controller_moves_the_lift_from_where_it_is_though_the_operator_wants_another_height(
        core, rate_mps, wanted_m):
    report = FirmwareReport(START, lift_height_m=0.4)
    inputs = replace(desired(key_height_m=1.5), manual_lift_mps=rate_mps)
    assert core.step(inputs, report, START).lift_height_m == pytest.approx(wanted_m)


def test_manual_controller_does_not_move_the_lift_beyond_its_stops(core):
    inputs = Inputs(manual_lift_mps=0.5)
    assert core.step(inputs, FirmwareReport(START, lift_height_m=1.19), START).lift_height_m == pytest.approx(1.2)
    assert core.step(replace(inputs, manual_lift_mps=-0.5), FirmwareReport(START), START).lift_height_m == 0.0


CALIBRATING = FirmwareReport(START, lift_height_m=0.3, is_calibrating=True)


@pytest.mark.parametrize("is_under_way", [False, True])
def test_calibration_goes_on_while_its_person_is_heard_and_nobody_else_is_in_control(core, is_under_way):
    outcome = core.step(Inputs(calibrates=True), replace(CALIBRATING, is_calibrating=is_under_way), START)
    assert outcome.lift_height_m == 0.3


@pytest.mark.parametrize("inputs, word", [
    (Inputs(), "calibrate_lift is silent"),
    (replace(desired(key_height_m=0.8), calibrates=True), "in control"),
    (Inputs(calibrates=True, manual_lift_mps=0.1), "in control")])
def test_calibration_is_ended_when_its_person_is_silent_or_another_is_in_control(core, inputs, word):
    outcome = core.step(inputs, CALIBRATING, START)
    assert math.isnan(outcome.lift_height_m)
    assert word in outcome.message.text


def test_without_a_report_the_lift_is_shown_at_its_lower_stop(core):
    assert core.step(LIVE, None, START).lift_now_m == 0.0


def test_calibration_below_the_nominal_stop_asks_for_no_negative_height(core):
    outcome = core.step(Inputs(calibrates=True), replace(CALIBRATING, lift_height_m=-0.02), START)
    assert outcome.lift_height_m == 0.0
