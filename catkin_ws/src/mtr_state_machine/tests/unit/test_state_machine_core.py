"""The state machine's decisions: mapping, goals and results."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest
from state_machine_seen import COLLECTING, LOCATED, MAP_PLACE, NO_WAY, ROUND_IT, WANTS, WAYPOINT, reported, seen

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_GOAL, NO_WAYPOINT, DesiredState, GoalReport
from mtr_core.states import CarState, Result, State
from mtr_state_machine.observation import Car, Part


@pytest.mark.parametrize("part", Part)
def test_starting_waits_for_each_part(machine, part):
    decision = machine.step(seen(age_s={other: 0.1 for other in Part if other is not part}))
    assert decision.state is State.STARTING and decision.goal == NO_GOAL
    assert part.value in decision.message.text and decision.lock_reason == decision.message


def test_ready_waits_for_a_waypoint(machine):
    decision = machine.step(seen(desired=replace(WANTS, waypoint=NO_WAYPOINT)))
    assert decision.state is State.READY_TO_MAP_CAR and not decision.mapping and not decision.lock_reason


@pytest.mark.parametrize("change", [{"stop": True}, {"link_alive": False, "stop": True}])
def test_stopped_robot_does_not_begin_to_map(machine, change):
    assert machine.step(seen(desired=replace(WANTS, **change))).state is State.READY_TO_MAP_CAR


def test_first_waypoint_starts_mapping_and_stays_pending(machine):
    decision = machine.step(seen(car=COLLECTING))
    assert decision.state is State.MAPPING_CAR and decision.mapping
    assert (decision.goal.waypoint, decision.max_speed_mps) == (MAP_PLACE, 0.8)
    assert (decision.session_id, decision.waypoint_id, decision.waypoint_result) == (9, 7, Result.PENDING)


def test_result_of_a_mapping_goal_is_not_the_waypoints(mapping):
    decision = mapping.step(seen(car=COLLECTING))
    decision = mapping.step(seen(car=COLLECTING, motion=reported(decision, Result.REACHED)))
    assert decision.waypoint_result is Result.PENDING


def test_each_place_of_the_locator_is_a_new_goal(mapping):
    first = mapping.step(seen(car=COLLECTING)).goal
    assert mapping.step(seen(car=COLLECTING)).goal == first
    second = mapping.step(seen(car=replace(COLLECTING, next_waypoint=replace(MAP_PLACE, id=2)))).goal
    assert second.id not in (NO_GOAL.id, first.id) and second.waypoint.id == 2


def test_stop_pauses_mapping_and_resuming_is_a_new_goal(mapping):
    first = mapping.step(seen(car=COLLECTING)).goal
    paused = mapping.step(seen(car=COLLECTING, desired=replace(WANTS, stop=True)))
    assert paused.state is State.MAPPING_CAR and paused.goal == NO_GOAL and not paused.lock_reason
    resumed = mapping.step(seen(car=COLLECTING)).goal
    assert resumed.id not in (NO_GOAL.id, first.id) and resumed.waypoint == first.waypoint


def test_located_car_leads_to_the_waypoint(mapping):
    goal = mapping.step(seen(car=LOCATED)).goal
    assert goal.waypoint == WAYPOINT


@pytest.mark.parametrize("result", [Result.PENDING, Result.REFUSED, Result.BLOCKED])
def test_result_follows_the_planner(following, result):
    decision = following.step(seen(car=LOCATED))
    decision = following.step(seen(car=LOCATED, motion=reported(decision, result, Problem(text="Why."))))
    assert decision.waypoint_result is result
    assert decision.message == (NO_PROBLEM if result is Result.PENDING else Problem(text="Why."))
    decision = following.step(seen(car=LOCATED, motion=reported(decision, Result.PENDING)))
    assert decision.waypoint_result is Result.PENDING


def test_report_on_another_goal_counts_for_nothing(following):
    decision = following.step(seen(car=LOCATED))
    old = GoalReport(replace(decision.goal, attempt=decision.goal.attempt - 1).id, Result.REACHED)
    assert following.step(seen(car=LOCATED, motion=old)).waypoint_result is Result.PENDING


def test_reached_stays_until_the_next_waypoint(following):
    decision = following.step(seen(car=LOCATED))
    decision = following.step(seen(car=LOCATED, motion=reported(decision, Result.REACHED)))
    assert decision.waypoint_result is Result.REACHED
    stopped = following.step(seen(car=LOCATED, desired=replace(WANTS, stop=True)))
    assert stopped.waypoint_result is Result.REACHED
    assert following.step(seen(car=LOCATED)).waypoint_result is Result.REACHED
    following_one = replace(WANTS, waypoint=replace(WAYPOINT, id=8))
    assert following.step(seen(car=LOCATED, desired=following_one)).waypoint_result is Result.PENDING


def test_same_waypoint_id_of_another_session_is_another_goal(following):
    first = following.step(seen(car=LOCATED))
    second = following.step(seen(car=LOCATED, desired=replace(WANTS, session_id=10)))
    assert second.goal.id not in (NO_GOAL.id, first.goal.id) and second.session_id == 10


@pytest.mark.parametrize("change", [{"stop": True}, {"link_alive": False, "stop": True}, {"waypoint": NO_WAYPOINT}])
def test_without_a_live_order_there_is_no_goal(following, change):
    assert following.step(seen(car=LOCATED, desired=replace(WANTS, **change))).goal == NO_GOAL


def test_waypoint_withdrawn_by_a_live_session_has_no_result(following):
    decision = following.step(seen(car=LOCATED, desired=replace(WANTS, waypoint=NO_WAYPOINT)))
    assert (decision.waypoint_id, decision.waypoint_result) == (0, Result.IDLE)


@pytest.mark.parametrize("order_stopped", [True, False])
def test_mapping_order_maps_again_until_its_own_answer(following, order_stopped):
    order = replace(WANTS, map_car_id=3, stop=order_stopped)
    decision = following.step(seen(car=LOCATED, desired=order))
    assert decision.state is State.MAPPING_CAR and decision.map_car_id == 3
    assert following.step(seen(car=LOCATED, desired=order)).state is State.MAPPING_CAR
    answer = replace(LOCATED, map_car_id=3)
    assert following.step(seen(car=answer, desired=order)).state is State.FOLLOWING_WAYPOINT
    assert following.step(seen(car=answer, desired=order)).state is State.FOLLOWING_WAYPOINT


def test_mapping_order_maps_without_a_waypoint(machine):
    order = replace(WANTS, waypoint=NO_WAYPOINT, map_car_id=1)
    decision = machine.step(seen(desired=order, car=replace(COLLECTING)))
    assert decision.state is State.MAPPING_CAR and decision.goal.waypoint.frame == "map"


def test_failed_mapping_is_a_fault_until_the_next_order(mapping):
    not_found = Problem(text="No Car was found.")
    failed = Car(CarState.FAILED, message=not_found)
    decision = mapping.step(seen(car=failed))
    assert (decision.state, decision.message, decision.goal) == (State.FAULT, not_found, NO_GOAL)
    assert mapping.step(seen(car=failed)).state is State.FAULT
    decision = mapping.step(seen(car=failed, desired=replace(WANTS, map_car_id=2)))
    assert decision.state is State.MAPPING_CAR and not decision.lock_reason


@pytest.mark.parametrize("change", [{"session_id": 10}, {"waypoint": replace(WAYPOINT, id=8)}])
def test_new_waypoint_tries_a_failed_mapping_again(mapping, change):
    failed, again = Car(CarState.FAILED, message=Problem(text="No Car was found.")), replace(WANTS, **change)
    assert mapping.step(seen(car=failed)).state is State.FAULT
    assert mapping.step(seen(car=failed, desired=replace(again, stop=True))).state is State.FAULT
    assert mapping.step(seen(car=failed, desired=again)).state is State.MAPPING_CAR
    assert mapping.step(seen(car=failed, desired=again)).state is State.MAPPING_CAR
    assert mapping.step(seen(car=COLLECTING, desired=again)).state is State.MAPPING_CAR
    assert mapping.step(seen(car=failed, desired=again)).state is State.FAULT


def test_machine_that_has_done_nothing_confirms_nothing(machine):
    decision = machine.step(seen(desired=DesiredState()))
    assert (decision.session_id, decision.waypoint_id, decision.map_car_id, decision.check_car_id) == (0, 0, 0, 0)


def test_mapping_order_that_is_withdrawn_is_no_new_one(following):
    order = replace(WANTS, map_car_id=3)
    following.step(seen(car=LOCATED, desired=order))
    following.step(seen(car=replace(LOCATED, map_car_id=3), desired=order))
    assert following.step(seen(car=replace(LOCATED, map_car_id=3))).state is State.FOLLOWING_WAYPOINT


@pytest.mark.parametrize("result, shown", [(Result.REFUSED, NO_WAY), (Result.BLOCKED, NO_WAY),
                                           (Result.PENDING, ROUND_IT)])
def test_while_mapping_the_operator_reads_what_keeps_the_robot_from_its_goal_or_what_the_locator_does(
        mapping, result, shown):
    car = replace(COLLECTING, message=ROUND_IT)
    decision = mapping.step(seen(car=car))
    assert mapping.step(seen(car=car, motion=reported(decision, result, NO_WAY))).message == shown
    other = GoalReport(replace(decision.goal, attempt=99).id, result, NO_WAY)
    assert mapping.step(seen(car=car, motion=other)).message == ROUND_IT


def test_while_following_what_the_locator_says_is_not_shown(following):
    assert not following.step(seen(car=replace(LOCATED, message=ROUND_IT))).message
