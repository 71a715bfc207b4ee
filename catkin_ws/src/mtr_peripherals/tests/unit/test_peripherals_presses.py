"""Presses with a fake firmware: each is executed once, none after a stop, and each result is reported."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest
from peripherals_under_test import (
    ENGAGED,
    FAULT,
    MS,
    PRESS,
    PRESSING_LIVE,
    START,
    STARTING,
    TICK,
    FakeFirmware,
    desired,
    restarted,
    run,
)

from mtr_core.problems import NO_PROBLEM
from mtr_core.requests import NO_PRESS
from mtr_peripherals.calibration import Calibration
from mtr_peripherals.firmware import FirmwareReport, Led
from mtr_peripherals.presses import PRESS_MARGIN_NS, REMEMBERED_SESSIONS, Presses, firmware_id_of


def test_press_is_carried_out_once_and_reported_with_its_times(core):
    firmware = FakeFirmware()
    outcome = run(core, PRESSING_LIVE, firmware, 20)
    assert [(order.servos, order.strength, order.hold_ms) for order in firmware.pressed] == [(2, 0.8, 250)]
    assert [(result.session_id, result.id, result.error) for result in outcome.results] == [(3, 1, NO_PROBLEM)]
    assert outcome.results[0].end_ns - outcome.results[0].start_ns == 250 * MS


def test_lost_press_message_is_repeated(core):
    firmware = FakeFirmware()
    firmware.deaf = 3
    outcome = run(core, PRESSING_LIVE, firmware, 20)
    assert len(firmware.pressed) == 1 and not outcome.results[0].error


def test_next_id_and_next_session_press_again(core):
    firmware = FakeFirmware()
    run(core, PRESSING_LIVE, firmware, 10)
    run(core, desired(press=replace(PRESS, id=2)), firmware, 10, 10)
    outcome = run(core, desired(session_id=4, press=replace(PRESS, session_id=4)), firmware, 10, 20)
    assert len({order.id for order in firmware.pressed}) == 3
    assert [(result.session_id, result.id) for result in outcome.results] == [(3, 1), (3, 2), (4, 1)]


def test_press_of_a_session_that_comes_back_is_not_made_again(core):
    firmware = FakeFirmware()
    run(core, PRESSING_LIVE, firmware, 10)
    run(core, desired(session_id=4, press=replace(PRESS, session_id=4)), firmware, 10, 10)
    run(core, PRESSING_LIVE, firmware, 10, 20)
    assert [order.id for order in firmware.pressed] == [firmware_id_of(replace(PRESS, session_id=session_id))
                                                        for session_id in (3, 4)]


def test_presses_of_countless_sessions_take_bounded_memory():
    presses, report = Presses(Calibration()), FirmwareReport(START)
    for session_id in range(1, 2 * REMEMBERED_SESSIONS):
        # With a stop, each press ends at once.
        presses.step(replace(PRESS, session_id=session_id), report, START, ENGAGED)
    assert len(presses._newest) == REMEMBERED_SESSIONS


def test_new_press_during_another_waits_for_it(core):
    firmware = FakeFirmware()
    run(core, PRESSING_LIVE, firmware, 2)
    outcome = run(core, desired(press=replace(PRESS, id=2)), firmware, 20, 2)
    assert [result.id for result in outcome.results] == [1, 2]
    assert outcome.results[0].end_ns <= outcome.results[1].start_ns


def test_ids_of_a_session_never_meet_and_another_session_begins_elsewhere():
    ids = {firmware_id_of(replace(PRESS, id=number)) for number in range(1, 10_001)}
    assert len(ids) == 10_000 and 0 not in ids
    assert firmware_id_of(replace(PRESS, session_id=2 ** 64 - 1)) not in ids
    assert 0 < firmware_id_of(replace(PRESS, id=2 ** 64 - 1)) < 2 ** 32


def test_press_still_ordered_after_a_restart_of_the_node_is_followed_and_not_made_twice(core):  # A9c
    firmware = FakeFirmware()
    run(core, PRESSING_LIVE, firmware, 3)
    outcome = run(restarted(), PRESSING_LIVE, firmware, 20, 3)
    assert len(firmware.pressed) == 1
    assert [(result.id, result.error) for result in outcome.results] == [(1, NO_PROBLEM)]
    assert outcome.results[0].start_ns == firmware.report.press_start_ns


def test_press_done_before_a_restart_of_the_node_is_reported_again_and_not_made_twice(core):  # A9c
    firmware = FakeFirmware()
    before = run(core, PRESSING_LIVE, firmware, 20)
    after = run(restarted(), PRESSING_LIVE, firmware, 20, 20)
    assert len(firmware.pressed) == 1 and after.results == before.results


@pytest.mark.parametrize("last_id", [0, 77], ids=["board-forgot", "board-knows-another"])
def test_press_that_the_firmware_does_not_know_after_a_restart_is_not_made_and_told(last_id):  # A9c
    firmware = FakeFirmware(last_id)
    after = restarted()
    outcome = run(after, PRESSING_LIVE, firmware, 20)
    assert not firmware.pressed and "may have pressed or not" in outcome.results[0].error.text
    run(after, desired(press=replace(PRESS, id=2)), firmware, 20, 20)
    assert len(firmware.pressed) == 1, "the next one is made"


def test_held_buttons_are_shown(core):
    firmware = FakeFirmware()
    during = run(core, PRESSING_LIVE, firmware, 3)
    assert during.pressed_buttons == (2,) and during.led is Led.PRESSING
    assert run(core, PRESSING_LIVE, firmware, 10, 3).pressed_buttons == ()


@pytest.mark.parametrize("press, word", [(replace(PRESS, buttons=(5,)), "Button 5"),
                                         (replace(PRESS, strength=math.nan), "Strength nan"),
                                         (replace(PRESS, duration_s=60.0), "Duration 60 s")])
def test_impossible_press_is_reported_with_the_reason_and_not_sent(core, press, word):
    firmware = FakeFirmware()
    outcome = run(core, desired(press=press), firmware, 5)
    assert not firmware.pressed and [result.id for result in outcome.results] == [1]
    assert word in outcome.results[0].error.text


def test_press_that_the_firmware_refuses_is_an_error(core):
    firmware = FakeFirmware()
    firmware.refuses = True
    outcome = run(core, PRESSING_LIVE, firmware, 5)
    assert [result.error.text for result in outcome.results] == ["The firmware refused the press."]


def test_press_that_is_never_reported_is_an_error(core):
    firmware = FakeFirmware()
    firmware.deaf = 1000
    outcome = run(core, PRESSING_LIVE, firmware, 40)
    assert len(outcome.results) == 1 and "in time" in outcome.results[0].error.text


def test_firmware_that_starts_again_during_a_press_is_an_error_and_presses_no_second_time(core):
    firmware = FakeFirmware()
    run(core, PRESSING_LIVE, firmware, 3)
    firmware.report = FirmwareReport(START)
    outcome = run(core, PRESSING_LIVE, firmware, 20, 3)
    assert len(firmware.pressed) == 1 and "started again" in outcome.results[0].error.text


@pytest.mark.parametrize("inputs", [desired(PRESSING_LIVE, link_alive=False), desired(press=NO_PRESS)])
def test_nothing_is_pressed_without_a_live_order(core, inputs):
    firmware = FakeFirmware()
    run(core, inputs, firmware, 5)
    assert not firmware.pressed


@pytest.mark.parametrize("stopped", [
    replace(PRESSING_LIVE, emergency=ENGAGED), desired(PRESSING_LIVE, stop=True), replace(PRESSING_LIVE, mode=FAULT),
    replace(PRESSING_LIVE, mode=STARTING), replace(PRESSING_LIVE, is_held=True)],
    ids=["emergency", "operator", "fault", "state unknown", "held"])
def test_press_ordered_during_a_stop_is_refused_and_not_made_after_it(core, stopped):  # A3
    firmware = FakeFirmware()
    outcome = run(core, stopped, firmware, 5)
    run(core, PRESSING_LIVE, firmware, 5, 5)
    assert not firmware.pressed
    assert [result.error.code for result in outcome.results] == ["peripherals.press_stopped"]


def test_press_that_the_firmware_has_not_taken_at_an_emergency_stop_is_sent_no_longer(core):  # A3
    firmware = FakeFirmware()
    firmware.deaf = 1000
    run(core, PRESSING_LIVE, firmware, 2)
    outcome = core.step(replace(PRESSING_LIVE, emergency=ENGAGED), firmware.report, START + 2 * TICK)
    assert outcome.press is None and outcome.results[0].error.code == "peripherals.press_cut_short"


def test_press_must_begin_before_it_is_given_up(core):  # B8
    order = core.step(PRESSING_LIVE, FirmwareReport(START), START).press
    later = core.step(PRESSING_LIVE, FirmwareReport(START), START + 10 * TICK).press
    assert order.latest_ns == START + 2_000 * MS and later == order
    assert order.latest_ns < START + order.hold_ms * MS + PRESS_MARGIN_NS


def test_press_fails_later_than_its_time_to_hold_and_three_seconds(core):
    firmware = FakeFirmware()
    firmware.deaf = 1000
    inputs = desired(press=replace(PRESS, duration_s=0.2))
    assert not run(core, inputs, firmware, 33).results
    assert run(core, inputs, firmware, 1, 33).results
