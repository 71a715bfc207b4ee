"""Presses, lift and LEDs against a fake firmware."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_core.problems import NO_PROBLEM
from mtr_core.requests import NO_PRESS, DesiredState, Press
from mtr_description.shipped import shipped_geometry
from mtr_peripherals import problems
from mtr_peripherals.core import Inputs, Peripherals
from mtr_peripherals.firmware import FirmwareReport, Led, PressState
from mtr_peripherals.key_lift import KeyLift
from mtr_peripherals.parameters import Parameters
from mtr_peripherals.presses import PRESS_MARGIN_NS, firmware_id_of

MS = 1_000_000
TICK = 100 * MS
START = 1_000 * MS
STARTING, READY, FOLLOWING, FAULT = 1, 2, 4, 5
LIVE = Inputs(DesiredState(session_id=3, link_alive=True, stop=False), FOLLOWING)
PRESS = Press(1, 3, (2,), 0.8, 0.25)


def desired(inputs=LIVE, **changes):
    return replace(inputs, desired=replace(inputs.desired, **changes))


PRESSING_LIVE = desired(press=PRESS)


class FakeFirmware:
    """Carries out one press at a time, as the firmware does, in whole ticks.

    Attributes:
        pressed: ids that were pressed, in order.
        deaf: how many press messages get lost.
        refuses: every press is refused.
    """

    def __init__(self, last_id=0):
        self.pressed, self.deaf, self.refuses = [], 0, False
        self.report = FirmwareReport(START, press_id=last_id,
                                     press_state=PressState.DONE if last_id else PressState.NONE)

    def step(self, order, now_ns):
        report = replace(self.report, stamp_ns=now_ns)
        if report.press_state is PressState.PRESSING and now_ns >= report.press_end_ns:
            report = replace(report, press_state=PressState.DONE)
        if order and self.deaf:
            self.deaf -= 1
        elif order and order.id != report.press_id:
            self.pressed.append(order)
            state = PressState.REFUSED if self.refuses else PressState.PRESSING
            report = replace(report, press_id=order.id, press_state=state, press_start_ns=now_ns,
                             press_end_ns=now_ns + order.hold_ms * MS)
        self.report = report


@pytest.fixture
def core():
    """One that has heard of an application that wants no press."""
    found = Peripherals(Parameters(), KeyLift(shipped_geometry().key()))
    found.step(LIVE, FirmwareReport(START), START)
    return found


def run(core, inputs, firmware, ticks, first=0):
    for i in range(first, first + ticks):
        outcome = core.step(inputs, firmware.report, START + i * TICK)
        firmware.step(outcome.press, START + i * TICK)
    return outcome


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


def restarted():
    return Peripherals(Parameters(), KeyLift(shipped_geometry().key()))


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


ENGAGED = problems.EMERGENCY_ENGAGED(owner="controller_input")


@pytest.mark.parametrize("inputs", [desired(key_height_m=1.0), replace(LIVE, manual_lift_mps=0.1),
                                    Inputs(calibrates=True)], ids=["operator", "manual", "calibration"])
def test_emergency_stop_holds_the_lift_whoever_moves_it_and_releases_the_servos(core, inputs):  # A3
    report = FirmwareReport(START, is_calibrating=inputs.calibrates)
    assert not math.isnan(core.step(inputs, report, START).lift_height_m)
    outcome = core.step(replace(inputs, emergency=ENGAGED), report, START)
    assert math.isnan(outcome.lift_height_m) and outcome.stop and outcome.message == ENGAGED
    after = core.step(inputs, report, START)
    assert not after.stop and not math.isnan(after.lift_height_m), "the order still holds"


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


def test_silent_firmware_is_not_alive_and_says_so_when_the_next_tick_would_be_too_late(core):
    report, limit_ns = FirmwareReport(START), 1_000 * MS
    assert core.step(LIVE, report, START + limit_ns - 2 * TICK).alive
    assert not core.step(LIVE, report, START - limit_ns - MS).alive, "A10: a report of the future is not alive"
    assert not core.step(LIVE, report, START + limit_ns - 2 * TICK + MS).alive, "a tick here, one of the state machine"
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
    (replace(LIVE, has_goal=True, backs_unseen=True), Led.WARNING),
    (replace(LIVE, mode=FAULT, backs_unseen=True), Led.ERROR),
    (LIVE, Led.READY),
    (desired(stop=True), Led.PAUSED),
    (desired(link_alive=False, stop=True), Led.LINK_LOST),
    (replace(LIVE, mode=FAULT), Led.ERROR),
])
def test_leds_show_what_the_robot_does(core, inputs, led):
    assert core.step(inputs, FirmwareReport(START), START).led is led


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


def test_press_fails_later_than_its_time_to_hold_and_three_seconds(core):
    firmware = FakeFirmware()
    firmware.deaf = 1000
    inputs = desired(press=replace(PRESS, duration_s=0.2))
    assert not run(core, inputs, firmware, 33).results
    assert run(core, inputs, firmware, 1, 33).results
