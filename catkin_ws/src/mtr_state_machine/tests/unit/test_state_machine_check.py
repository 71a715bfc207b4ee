"""Self-checks: orders, poses and reports."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

from state_machine_seen import (
    CHECK_PLACE,
    COLLECTING,
    LOCATED,
    LOOKING,
    NOT_PASSED,
    ORDERS_CHECK,
    PASSED,
    ROUND_IT,
    WANTS,
    WAYPOINT,
    reported,
    seen,
)

from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL, NO_WAYPOINT
from mtr_core.states import Check, Result, State
from mtr_state_machine.observation import CheckReport


def test_check_order_leads_to_the_places_of_the_locator(following):
    decision = following.step(seen(car=LOOKING, desired=ORDERS_CHECK))
    assert (decision.state, decision.check_car_id, decision.mapping) == (State.CHECKING_CAR, 4, False)
    assert decision.goal.waypoint == CHECK_PLACE
    second = following.step(seen(car=replace(LOOKING, next_waypoint=replace(CHECK_PLACE, id=6)), desired=ORDERS_CHECK))
    assert second.goal.id not in (NO_GOAL.id, decision.goal.id)


def test_check_needs_no_waypoint(following):
    order = replace(ORDERS_CHECK, waypoint=NO_WAYPOINT)
    assert following.step(seen(car=LOOKING, desired=order)).goal.waypoint.frame == "map"


def test_check_can_be_stopped_and_resumed(checking):
    first = checking.step(seen(car=LOOKING, desired=ORDERS_CHECK)).goal
    stopped = checking.step(seen(car=LOOKING, desired=replace(ORDERS_CHECK, stop=True)))
    assert stopped.state is State.CHECKING_CAR and stopped.goal == NO_GOAL
    resumed = checking.step(seen(car=LOOKING, desired=ORDERS_CHECK)).goal
    assert resumed.id not in (NO_GOAL.id, first.id) and resumed.waypoint == first.waypoint


def test_passed_check_leads_back_to_the_waypoint(checking):
    running = CheckReport(4, Check.RUNNING, Problem(text="Looks."))
    assert checking.step(seen(car=LOOKING, desired=ORDERS_CHECK, check=running)).state is State.CHECKING_CAR
    decision = checking.step(seen(car=LOCATED, desired=ORDERS_CHECK, check=PASSED))
    assert decision.state is State.FOLLOWING_WAYPOINT and decision.goal.waypoint.frame == "car"
    assert checking.step(seen(car=LOCATED, desired=ORDERS_CHECK, check=PASSED)).state is State.FOLLOWING_WAYPOINT


def test_answer_to_an_earlier_check_counts_for_nothing(checking):
    for answer in (PASSED, NOT_PASSED):
        earlier = seen(car=LOOKING, desired=ORDERS_CHECK, check=replace(answer, id=3))
        assert checking.step(earlier).state is State.CHECKING_CAR


def test_failed_check_is_a_fault_that_only_another_check_or_map_ends(checking):
    ill = seen(car=LOCATED, desired=ORDERS_CHECK, check=NOT_PASSED)
    decision = checking.step(ill)
    assert (decision.state, decision.lock_reason) == (State.FAULT, NOT_PASSED.message)
    for change in ({"stop": True}, {"waypoint": replace(WAYPOINT, id=8)}, {"session_id": 10}, {"check_car_id": 0}):
        assert checking.step(replace(ill, desired=replace(ORDERS_CHECK, **change))).state is State.FAULT
    again = replace(ORDERS_CHECK, check_car_id=5)
    assert checking.step(replace(ill, desired=again)).state is State.CHECKING_CAR
    passed = replace(ill, desired=again, check=replace(PASSED, id=5))
    assert checking.step(passed).state is State.FOLLOWING_WAYPOINT


def test_failed_check_can_be_followed_by_mapping(checking):
    checking.step(seen(car=LOCATED, desired=ORDERS_CHECK, check=NOT_PASSED))
    order = replace(ORDERS_CHECK, map_car_id=3)
    assert checking.step(seen(car=LOCATED, desired=order, check=NOT_PASSED)).state is State.MAPPING_CAR
    located = replace(LOCATED, map_car_id=3)
    assert checking.step(seen(car=located, desired=order, check=NOT_PASSED)).state is State.FOLLOWING_WAYPOINT


def test_check_that_is_no_longer_wanted_ends(checking):
    silent = replace(WANTS, link_alive=False, stop=True)
    assert checking.step(seen(car=LOOKING, desired=silent)).state is State.CHECKING_CAR
    assert checking.step(seen(car=LOOKING)).state is State.FOLLOWING_WAYPOINT


def test_check_ordered_while_mapping_waits_for_the_car(mapping):
    assert mapping.step(seen(car=COLLECTING, desired=ORDERS_CHECK)).state is State.MAPPING_CAR
    assert mapping.step(seen(car=LOCATED, desired=ORDERS_CHECK)).state is State.CHECKING_CAR


def test_waypoint_that_a_check_led_away_from_is_to_be_reached_again(following):
    decision = following.step(seen(car=LOCATED))
    reached = seen(car=LOCATED, motion=reported(decision, Result.REACHED))
    assert following.step(reached).waypoint_result is Result.REACHED
    assert following.step(seen(car=LOOKING, desired=ORDERS_CHECK)).waypoint_result is Result.PENDING


def test_first_check_of_a_session_is_taken(following):
    decision = following.step(seen(car=LOOKING, desired=replace(WANTS, check_car_id=1)))
    assert (decision.state, decision.check_car_id) == (State.CHECKING_CAR, 1)


def test_while_checking_the_operator_reads_of_this_check_only(checking):
    running = CheckReport(4, Check.RUNNING, ROUND_IT)
    assert checking.step(seen(car=LOOKING, desired=ORDERS_CHECK, check=running)).message == ROUND_IT
    earlier = checking.step(seen(car=LOOKING, desired=ORDERS_CHECK, check=replace(running, id=3)))
    assert earlier.message and earlier.message != ROUND_IT
