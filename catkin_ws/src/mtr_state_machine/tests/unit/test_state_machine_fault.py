"""Faults: causes, sentences for the Operator, and ends."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest
from state_machine_seen import ALL_WELL, COLLECTING, LOCATED, LOOKING, LOST, ORDERS_CHECK, WANTS, WAYPOINT, seen

from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL, NO_WAYPOINT
from mtr_core.states import CarState, State
from mtr_state_machine.core import StateMachine
from mtr_state_machine.observation import Car, Part
from mtr_state_machine.parameters import Parameters


@pytest.mark.parametrize("part", Part)
@pytest.mark.parametrize("trouble", ["silent", "unwell"])
@pytest.mark.parametrize("before, car", [(State.READY_TO_MAP_CAR, Car()), (State.MAPPING_CAR, COLLECTING),
                                         (State.FOLLOWING_WAYPOINT, LOCATED), (State.CHECKING_CAR, LOOKING)])
def test_failed_part_is_a_fault_with_its_sentence_and_ends_where_it_began(machine, part, trouble, before, car):
    desired = replace(WANTS, waypoint=NO_WAYPOINT) if before is State.READY_TO_MAP_CAR else WANTS
    desired = ORDERS_CHECK if before is State.CHECKING_CAR else desired
    machine.step(seen(desired=desired, car=Car() if before is State.READY_TO_MAP_CAR else COLLECTING))
    well = seen(desired=desired, car=car)
    assert machine.step(well).state is before
    silent, unwell = {**ALL_WELL, part: 0.51}, {part: Problem(text=f"The {part.value} is unwell.")}
    ill = replace(well, age_s=silent) if trouble == "silent" else replace(well, complaint=unwell)
    decision = machine.step(ill)
    assert decision.state is State.FAULT and decision.goal == NO_GOAL and not decision.mapping
    assert part.value in decision.message.text and decision.lock_reason == decision.message
    assert machine.step(ill).state is State.FAULT
    assert machine.step(well).state is before


def lost_position(now_s, **changes):
    return seen(car=LOCATED, complaint=LOST, is_position_lost=True, now_s=now_s, **changes)


def test_lost_position_stops_the_robot_and_then_it_can_be_driven_by_hand_but_has_no_goal(following):
    assert following.step(lost_position(10.0)).lock_reason
    assert following.step(lost_position(10.99)).lock_reason
    decision = following.step(lost_position(11.0))
    assert not decision.lock_reason and decision.state is State.FAULT and decision.goal == NO_GOAL
    assert decision.message == LOST[Part.LOCALIZATION]


def test_position_that_is_lost_anew_stops_the_robot_anew(following):
    following.step(lost_position(10.0))
    following.step(seen(car=LOCATED, now_s=12.0))
    assert following.step(lost_position(12.1)).lock_reason


@pytest.mark.parametrize("also", [{"age_s": {**ALL_WELL, Part.PERIPHERALS: 0.6}},
                                  {"age_s": {**ALL_WELL, Part.LOCALIZATION: 0.6}},
                                  {"complaint": {**LOST, Part.PERIPHERALS: Problem(text="Silent.")}},
                                  {"is_position_lost": False}],
                         ids=["peripherals-silent", "localization-silent", "firmware-silent", "sensor-missing"])
def test_with_anything_else_wrong_a_robot_that_lost_its_position_stays_locked(following, also):
    following.step(replace(lost_position(10.0), **also))
    assert following.step(replace(lost_position(20.0), **also)).lock_reason


def test_lost_car_is_a_fault(following):
    decision = following.step(seen(car=Car()))
    assert decision.state is State.FAULT and "map the Car again" in decision.message.text


def test_mapping_order_does_not_end_a_fault_of_a_part(following):
    order = replace(WANTS, map_car_id=4)
    ill = seen(car=LOCATED, desired=order, complaint=LOST)
    assert following.step(ill).state is State.FAULT
    assert following.step(ill).state is State.FAULT
    assert following.step(seen(car=LOCATED, desired=order)).state is State.MAPPING_CAR


def test_localization_that_comes_back_in_its_map_goes_on(following):
    lost = seen(car=LOCATED, complaint=LOST)
    assert following.step(lost).state is State.FAULT
    assert following.step(seen(car=LOCATED)).state is State.FOLLOWING_WAYPOINT


@pytest.mark.parametrize("desired", [WANTS, ORDERS_CHECK])
def test_localization_in_another_map_asks_to_map_again(following, desired):
    lost = seen(car=LOCATED, desired=desired, complaint=LOST)
    assert following.step(lost).state is State.FAULT
    decision = following.step(seen(car=LOCATED, desired=desired, map_revision=1))
    assert decision.state is State.FAULT and "map the Car again" in decision.message.text
    order = replace(desired, map_car_id=3)
    assert following.step(seen(car=LOCATED, desired=order, map_revision=1)).state is State.MAPPING_CAR
    located = seen(car=replace(LOCATED, map_car_id=3), desired=replace(order, check_car_id=0), map_revision=2)
    assert following.step(located).state is State.FOLLOWING_WAYPOINT
    assert following.step(located).state is State.FOLLOWING_WAYPOINT


def test_car_that_was_moved_stops_the_robot_with_the_locators_sentence(following):
    moved = Problem("car_locator.moved", "The Car was moved, by 15 cm.", (("shift_cm", "15"),))
    decision = following.step(seen(car=Car(CarState.FAILED, message=moved)))
    assert (decision.state, decision.lock_reason) == (State.FAULT, moved)


def test_part_that_is_as_old_as_allowed_is_well(machine):
    assert machine.step(seen(age_s={part: 0.4 for part in Part})).state is not State.STARTING


def test_part_whose_limit_is_over_at_the_next_tick_has_failed_at_this_one(following):
    assert following.step(seen(age_s={**dict.fromkeys(Part, 0.1), Part.PERIPHERALS: 0.48})).state is State.FAULT


@pytest.mark.parametrize("age_s", [-60.0, -0.6, 0.6, float("nan"), float("inf")])
def test_message_of_the_future_or_of_no_time_is_a_silent_part(machine, age_s):  # A10
    assert machine.step(seen(age_s={part: age_s for part in Part})).state is State.STARTING


def test_car_locator_that_had_failed_before_the_first_tick_is_a_fault(machine):
    assert machine.step(seen(car=Car(CarState.FAILED))).state is State.FAULT


def test_mapping_order_during_the_fault_of_a_part_is_not_confirmed(following):
    ill = seen(car=LOCATED, desired=replace(WANTS, map_car_id=4), complaint=LOST)
    assert following.step(ill).map_car_id == 0


def test_new_waypoint_given_while_a_part_has_failed_is_not_yet_another_attempt_to_map(mapping):
    failed, another = Car(CarState.FAILED), replace(WANTS, waypoint=replace(WAYPOINT, id=8))
    assert mapping.step(seen(car=failed)).state is State.FAULT
    assert mapping.step(seen(car=failed, desired=another, complaint=LOST)).state is State.FAULT
    assert mapping.step(seen(car=failed, desired=replace(another, stop=True))).state is State.FAULT
    assert mapping.step(seen(car=failed, desired=another)).state is State.MAPPING_CAR


@pytest.mark.parametrize("car", [Car(CarState.UNKNOWN, message=Problem("car_locator.looks", "Looks.")),
                                 Car(CarState.FAILED)])
def test_car_that_is_lost_without_a_reason_is_a_fault_that_says_what_to_do(following, car):
    assert "map the Car again" in following.step(seen(car=car)).message.text


INTRUSION = Problem("state_machine.second_publisher", "Node /play_1 also publishes on /dispatcher/desired.")


@pytest.mark.parametrize("also", [{}, {"complaint": LOST, "is_position_lost": True},
                                  {"age_s": {**ALL_WELL, Part.DISPATCHER: 0.6}},
                                  {"desired": replace(WANTS, map_car_id=5)}, {"desired": ORDERS_CHECK}],
                         ids=["well", "position-lost", "dispatcher-silent", "map-ordered", "check-ordered"])
def test_second_publisher_locks_the_robot_whatever_it_orders(following, also):
    for now_s in (10.0, 11.0, 20.0):
        decision = following.step(seen(car=LOCATED, now_s=now_s, intrusion=INTRUSION, **also))
        assert decision.state is State.FAULT and decision.goal == NO_GOAL
        assert decision.lock_reason == decision.message == INTRUSION
    assert following.step(seen(car=LOCATED, now_s=21.0)).state is State.FOLLOWING_WAYPOINT


def test_robot_is_held_after_a_second_publisher_until_it_is_told_to_resume():
    machine = StateMachine(Parameters(resume_by_operator=True, silent_after_s=5.0, signal_s=0.0))
    for car in (COLLECTING, LOCATED):
        machine.step(seen(car=car))
    held = machine.step(seen(car=LOCATED))
    resumed = machine.step(seen(car=LOCATED, desired=replace(WANTS, resume_hold_id=held.hold_id)))
    assert resumed.goal != NO_GOAL
    machine.step(seen(car=LOCATED, intrusion=INTRUSION))
    decision = machine.step(seen(car=LOCATED))
    assert decision.hold_id and decision.message.cause == INTRUSION and decision.goal == NO_GOAL
