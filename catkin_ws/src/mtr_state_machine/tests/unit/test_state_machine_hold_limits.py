"""Limits of a hold to the last instant and count: the boundaries between a hold and continued motion."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest
from state_machine_seen import WANTS, WAYPOINT, seen

from mtr_core.requests import Goal
from mtr_state_machine.hold import EMPTY_FOR_S, RECHARGED, Hold
from mtr_state_machine.observation import Drive
from mtr_state_machine.parameters import Parameters

LONGEST_PAUSE_S, EMPTY = 0.5, 0.05
GOAL = Goal(WAYPOINT, 1)


@pytest.fixture
def hold():
    """Return a hold after one observation at time 0."""
    made = Hold(Parameters(silent_after_s=LONGEST_PAUSE_S, empty_battery=EMPTY))
    made.update(seen(now_s=0.0), GOAL)
    assert not made.id
    return made


def test_blockages_and_drives_from_before_the_start_hold_nobody():
    made = Hold(Parameters(silent_after_s=LONGEST_PAUSE_S, empty_battery=EMPTY))
    made.update(seen(now_s=0.0, drive=Drive(False, 4, 3), firmware_resets=2), GOAL)
    assert not made.id
    made.update(seen(now_s=0.1, drive=Drive(False, 4, 4), firmware_resets=2), GOAL)
    assert made.id


def test_first_blockage_of_a_drive_control_that_has_none_holds(hold):
    hold.update(seen(now_s=0.1, drive=Drive(blockages=1)), GOAL)
    assert hold.id


@pytest.mark.parametrize(("pause_s", "holds"), [(LONGEST_PAUSE_S, False), (LONGEST_PAUSE_S + 0.001, True)])
def test_pause_is_too_long_from_beyond_its_limit_on(hold, pause_s, holds):
    hold.update(seen(now_s=pause_s), GOAL)
    assert bool(hold.id) is holds


def charge(hold, charge_, from_s, until_s):
    """Apply this charge from one time to another, including both ends."""
    for tick in range(round((until_s - from_s) / 0.25) + 1):
        hold.update(seen(now_s=from_s + 0.25 * tick, battery=charge_), GOAL)


@pytest.mark.parametrize(("until_s", "holds"), [(EMPTY_FOR_S - 0.25, False), (EMPTY_FOR_S, True)])
def test_battery_is_empty_from_its_time_on(hold, until_s, holds):
    charge(hold, 0.04, 0.0, until_s)
    assert bool(hold.id) is holds


@pytest.mark.parametrize(("recharged", "holds"), [(EMPTY + RECHARGED, True), (EMPTY + RECHARGED - 0.001, False)])
def test_battery_counts_as_charged_from_its_limit_on(hold, recharged, holds):
    charge(hold, 0.04, 0.0, EMPTY_FOR_S)
    hold.update(seen(now_s=EMPTY_FOR_S + 0.25, battery=recharged, desired=replace(WANTS, resume_hold_id=hold.id)), GOAL)
    assert not hold.id
    charge(hold, 0.04, EMPTY_FOR_S + 0.5, 2.0 * EMPTY_FOR_S + 0.5)
    assert bool(hold.id) is holds


@pytest.mark.parametrize(("battery", "text"), [(0.0448, "at 4 %"), (0.0452, "at 5 %")])
def test_charge_is_told_in_whole_percent(hold, battery, text):
    charge(hold, battery, 0.0, EMPTY_FOR_S)
    assert text in hold.reason.text
