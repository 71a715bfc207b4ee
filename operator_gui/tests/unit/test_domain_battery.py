"""Charge of the robot's battery in a test: low, critical, unknown."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.battery.levels import CRITICAL_BATTERY_PERCENT, is_critical, is_low
from mtr_operator.domain.battery.watch import CRITICAL_FOR_S, RECHARGED_PERCENT, BatteryWatch
from mtr_operator.domain.errors import BatteryCritical
from mtr_operator.domain.geometry.heights import LOWEST_KEY_M
from mtr_operator.domain.results.session_record import ENDED_BY
from mtr_operator.domain.scenarios.autolock import SCENARIO
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters

PARAMETERS = AutolockParameters(measurements_distance_m=10.0, self_check=False)
FALLS_AT_S = 20.0
# Sums of it are exact.
TICK_S = 0.25


class Actions(RunObserver):
    """Keeps the announced actions."""

    def __init__(self):
        self.said = []

    def on_action(self, text):
        self.said.append(text)


def falling(world, percent=CRITICAL_BATTERY_PERCENT - 1, **changes):
    """Have the charge fall at FALLS_AT_S; the other changes of a Status begin then, too."""
    world.spoil = lambda status: (status if status.stamp_s < FALLS_AT_S
                                  else replace(status, battery_percent=percent, **changes))


@pytest.mark.parametrize(("percent", "low", "critical"), [
    (None, False, False), (100, False, False), (25, False, False), (24, True, False), (10, True, False),
    (9, True, True), (0, True, True)])
def test_levels(percent, low, critical):
    assert (is_low(percent), is_critical(percent)) == (low, critical)


def due_times(*charges):
    """Times at which the watch reports, of (charge, duration) one after the other."""
    watch, ticks, due = BatteryWatch(), 0, []
    for percent, duration_s in charges:
        for _ in range(round(duration_s / TICK_S)):
            if watch.is_due(percent, ticks * TICK_S):
                due.append(ticks * TICK_S)
            ticks += 1
    return due


@pytest.mark.parametrize(("charges", "expected"), [
    ([(9, 30.0)], [CRITICAL_FOR_S]),
    ([(10, 60.0)], []),
    ([(9, 10.0), (10, 0.25), (9, 10.0)], []),
    ([(9, 5.0), (None, 30.0)], [CRITICAL_FOR_S]),
    ([(None, 60.0)], []),
    ([(9, 11.0), (10 + RECHARGED_PERCENT - 1, 5.0), (9, 60.0)], [CRITICAL_FOR_S]),
    ([(9, 11.0), (10 + RECHARGED_PERCENT, 5.0), (9, 60.0)], [CRITICAL_FOR_S, 16.0 + CRITICAL_FOR_S]),
    ([(9, 11.0), (None, 5.0), (9, 60.0)], [CRITICAL_FOR_S]),
], ids=["stays critical", "at the level", "load steps", "falls silent", "unknown", "recovers under no load", "charged",
        "silent afterwards"])
def test_critical_charge_is_reported_once(charges, expected):
    assert due_times(*charges) == expected


def test_robot_at_a_critical_charge_lowers_the_key_returns_and_the_test_is_kept(world, robot_link, run_scenario):
    begins = world.x, world.y, world.heading
    falling(world)
    actions = Actions()
    with pytest.raises(BatteryCritical, match="^The robot's battery is critical; charge the robot, then continue"):
        run_scenario(SCENARIO, PARAMETERS, observer=actions)
    assert actions.said[-3:] == ["the battery is critical: lower the key", "return to the start place",
                                 "the robot stands still"]
    assert (world.x, world.y, world.heading) == pytest.approx(begins) and world.height_m == LOWEST_KEY_M
    assert robot_link.answers[-1][1].stop and run_scenario.progress.results
    first = next(number for number, (_, desired) in enumerate(robot_link.answers)
                 if desired.key_height_m == LOWEST_KEY_M)
    assert robot_link.answers[first][1].waypoint is None
    assert run_scenario.progress.session[ENDED_BY].startswith("The robot's battery is critical")


def test_test_is_continued_after_charging(world, run_scenario):
    falling(world)
    with pytest.raises(BatteryCritical):
        run_scenario(SCENARIO, PARAMETERS)
    kept = run_scenario.progress.results
    world.spoil = lambda status: status
    results = run_scenario(SCENARIO, PARAMETERS, progress=run_scenario.progress)
    assert len(results) == 8 and results[:len(kept)] == kept


def test_robot_whose_key_stays_up_stays_where_it_is(world, run_scenario):
    falling(world, key_height_m=1.0)
    actions = Actions()
    with pytest.raises(BatteryCritical):
        run_scenario(SCENARIO, PARAMETERS, observer=actions)
    assert "return to the start place" not in actions.said
    assert actions.said[-2].startswith("the robot stays here: The Remote key did not reach the height of 35 cm")


def test_robot_that_refuses_to_return_stays_where_it_is(world, run_scenario):
    falling(world)
    world.refuses = lambda waypoint: "Something is there." if world.height_m == LOWEST_KEY_M else ""
    actions = Actions()
    with pytest.raises(BatteryCritical):
        run_scenario(SCENARIO, PARAMETERS, observer=actions)
    assert actions.said[-2] == "the robot stays here: The robot refused the waypoint: Something is there."


def test_robot_that_did_not_know_its_position_at_the_start_stays_where_it_is(world, run_scenario):
    falling(world)
    spoil = world.spoil
    world.spoil = lambda status: replace(spoil(status), x=float("nan")) if status.stamp_s < 5.0 else spoil(status)
    actions = Actions()
    with pytest.raises(BatteryCritical):
        run_scenario(SCENARIO, PARAMETERS, observer=actions)
    assert actions.said[-2] == "the robot stays here: its start place is not known"


def test_operator_stops_the_return(world, run_scenario):
    falling(world)
    with pytest.raises(Cancelled):
        run_scenario(SCENARIO, PARAMETERS, is_cancelled=lambda: world.height_m == LOWEST_KEY_M
                     and world.time_s > FALLS_AT_S)


@pytest.mark.parametrize("percent", [None, CRITICAL_BATTERY_PERCENT, 24])
def test_test_goes_on_with_a_low_or_unknown_charge(world, run_scenario, percent):
    falling(world, percent)
    assert len(run_scenario(SCENARIO, PARAMETERS)) == 8


def test_charge_of_a_robot_that_another_application_has_ends_nothing(robot_link, car_link, world):
    world.spoil = lambda status: replace(status, battery_percent=0, controlled_by_other=True)
    loop = ControlLoop(robot_link, car_link)
    for _ in range(round(2.0 * CRITICAL_FOR_S / 0.1)):
        loop.step()


def test_held_robot_is_not_moved_by_its_charge(robot_link, car_link, world):
    """A person may be at a robot on hold; the key is lowered after the hold."""
    held_until_s = 3.0 * CRITICAL_FOR_S
    world.spoil = lambda status: replace(status, battery_percent=5, hold_id=int(status.stamp_s < held_until_s))
    loop = ControlLoop(robot_link, car_link)
    with pytest.raises(BatteryCritical):
        while loop.waited_s < 6.0 * CRITICAL_FOR_S:
            loop.step()
    assert world.time_s >= held_until_s
