"""Mapping again after the position was lost."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest
from state_machine_seen import ALL_WELL, COLLECTING, LOCATED, LOST, MAP_PLACE, WANTS, WAYPOINT, seen

from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL
from mtr_core.states import CarState, State
from mtr_state_machine.core import POSITION_AWAITED_S
from mtr_state_machine.observation import Car, Part

ORDER = replace(WANTS, map_car_id=4)
NO_MAP = Car(CarState.FAILED, message=Problem("surface_map.not_closed", "The way round was not closed."))


def lost(now_s, **changes):
    return seen(complaint=LOST, is_position_lost=True, now_s=now_s, **changes)


@pytest.mark.parametrize("before, car", [("mapping", COLLECTING), ("mapping", NO_MAP), ("following", LOCATED)])
def test_map_can_be_ordered_where_the_position_is_lost(request, before, car):
    machine = request.getfixturevalue(before)
    assert machine.step(lost(10.0, car=car)).state is State.FAULT
    decision = machine.step(lost(12.0, car=car, desired=ORDER))
    assert (decision.state, decision.map_car_id, decision.mapping) == (State.MAPPING_CAR, 4, True)
    assert not decision.lock_reason
    begun = Car(CarState.COLLECTING, MAP_PLACE, 4)
    decision = machine.step(seen(car=begun, desired=ORDER, now_s=12.3))
    assert decision.state is State.MAPPING_CAR and decision.goal.waypoint == MAP_PLACE


def test_robot_does_not_move_before_the_new_map_has_given_it_a_position(mapping):
    mapping.step(lost(10.0, car=COLLECTING))
    for tenths in range(int(10.0 * POSITION_AWAITED_S)):
        decision = mapping.step(lost(12.0 + 0.1 * tenths, car=COLLECTING, desired=ORDER))
        assert (decision.state, decision.goal) == (State.MAPPING_CAR, NO_GOAL)


def test_position_that_does_not_come_is_a_fault_again_until_it_is_ordered_anew(mapping):
    mapping.step(lost(10.0, car=COLLECTING))
    mapping.step(lost(12.0, car=COLLECTING, desired=ORDER))
    decision = mapping.step(lost(12.0 + POSITION_AWAITED_S, car=COLLECTING, desired=ORDER))
    assert decision.state is State.FAULT and decision.lock_reason == LOST[Part.LOCALIZATION]
    assert mapping.step(lost(16.0, car=COLLECTING, desired=ORDER)).state is State.FAULT
    assert mapping.step(lost(17.0, car=COLLECTING, desired=replace(ORDER, map_car_id=5))).state is State.MAPPING_CAR


def test_position_that_is_lost_on_the_new_way_round_is_a_fault_at_once(mapping):
    mapping.step(lost(10.0, car=COLLECTING))
    mapping.step(lost(12.0, car=COLLECTING, desired=ORDER))
    mapping.step(seen(car=COLLECTING, desired=ORDER, now_s=12.3))
    assert mapping.step(lost(12.4, car=COLLECTING, desired=ORDER)).state is State.FAULT


@pytest.mark.parametrize("also", [{"age_s": {**ALL_WELL, Part.PERIPHERALS: 0.6}},
                                  {"age_s": {**ALL_WELL, Part.LOCALIZATION: 0.6}},
                                  {"complaint": {**LOST, Part.DRIVE_CONTROL: Problem(text="Silent.")}},
                                  {"is_position_lost": False}],
                         ids=["peripherals-silent", "localization-silent", "drive-control-unwell", "sensor-missing"])
def test_with_anything_else_wrong_no_map_begins(following, also):
    following.step(replace(lost(10.0, car=LOCATED), **also))
    decision = following.step(replace(lost(12.0, car=LOCATED, desired=ORDER), **also))
    assert (decision.state, decision.map_car_id) == (State.FAULT, 0)


def test_part_that_fails_while_the_position_is_awaited_is_a_fault(mapping):
    mapping.step(lost(10.0, car=COLLECTING))
    mapping.step(lost(12.0, car=COLLECTING, desired=ORDER))
    ill = replace(lost(12.1, car=COLLECTING, desired=ORDER), age_s={**ALL_WELL, Part.PERIPHERALS: 0.6})
    assert mapping.step(ill).state is State.FAULT


def test_new_waypoint_tries_again_where_the_map_was_refused_and_the_position_lost_with_it(mapping):
    assert mapping.step(lost(10.0, car=NO_MAP)).state is State.FAULT
    another = replace(WANTS, waypoint=replace(WAYPOINT, id=8))
    decision = mapping.step(lost(12.0, car=NO_MAP, desired=another))
    assert (decision.state, decision.mapping, decision.goal) == (State.MAPPING_CAR, True, NO_GOAL)
    assert mapping.step(seen(car=COLLECTING, desired=another, now_s=12.3)).goal.waypoint == MAP_PLACE


def test_new_waypoint_does_not_begin_a_map_anew_while_the_position_may_come_back(mapping):
    mapping.step(lost(10.0, car=COLLECTING))
    another = replace(WANTS, waypoint=replace(WAYPOINT, id=8))
    assert mapping.step(lost(12.0, car=COLLECTING, desired=another)).state is State.FAULT
