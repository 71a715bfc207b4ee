"""Reports of the peripherals: liveness of the firmware, its faults, the LEDs."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest
from peripherals_under_test import FAULT, LIVE, MS, READY, START, TICK, desired

from mtr_peripherals.core import Inputs
from mtr_peripherals.firmware import FirmwareReport, Led


def test_silent_firmware_is_not_alive_and_says_so_when_the_next_tick_would_be_too_late(core):
    report, limit_ns = FirmwareReport(START), 1_000 * MS
    told_before_ns = 2 * TICK + 20 * MS + 60 * MS
    assert core.step(LIVE, report, START + limit_ns - told_before_ns - MS).alive
    assert not core.step(LIVE, report, START - limit_ns - MS).alive, "A10: a report of the future is not alive"
    assert not core.step(LIVE, report, START + limit_ns - told_before_ns + MS).alive, \
        "a tick here, one of the state machine, one of drive control, and what the wheels take to brake"
    outcome = core.step(LIVE, report, START + limit_ns)
    assert not outcome.alive and "silent for 1.0 s" in outcome.message.text and outcome.led is Led.ERROR


def test_firmware_that_never_reported_is_not_alive(core):
    outcome = core.step(LIVE, None, START)
    assert not outcome.alive and math.isnan(outcome.key_height_m) and outcome.message


def test_fault_of_the_firmware_is_a_sentence(core):
    assert core.step(LIVE, FirmwareReport(START, fault=1), START).message.text == "The lift is jammed."


@pytest.mark.parametrize("inputs, led", [
    (Inputs(), Led.STARTING),
    (Inputs(mode=READY), Led.READY),
    (replace(LIVE, mode=3), Led.MAPPING),
    (replace(LIVE, has_goal=True), Led.MOVING),
    (replace(LIVE, has_goal=True, linear_mps=-0.2), Led.WARNING),
    (replace(LIVE, mode=FAULT, linear_mps=-0.2), Led.ERROR),
    (replace(LIVE, has_goal=True, linear_mps=0.2), Led.MOVING),
    (replace(LIVE, sets_off=True), Led.SETS_OFF),
    (replace(LIVE, mode=FAULT, sets_off=True), Led.ERROR),
    (LIVE, Led.READY),
    (desired(stop=True), Led.PAUSED),
    (desired(link_alive=False, stop=True), Led.LINK_LOST),
    (replace(LIVE, mode=FAULT), Led.ERROR),
])
def test_leds_show_what_the_robot_does(core, inputs, led):
    assert core.step(inputs, FirmwareReport(START), START).led is led
