"""The state machine's decisions: mapping, goals, results and faults."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import CAR_LOCATOR, NO_GOAL, NO_WAYPOINT, DesiredState, GoalReport, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check, Result, State
from mtr_state_machine.core import StateMachine
from mtr_state_machine.observation import Car, CheckReport, Observation, Part
from mtr_state_machine.parameters import Parameters

ALL_WELL = {part: 0.1 for part in Part}
WAYPOINT = Waypoint(7, "application/9", "car", Pose2(3.0, 1.0, 0.5), 2)
MAP_PLACE = Waypoint(1, CAR_LOCATOR, "map", Pose2(5.0, 5.0, 0.0))
WANTS = DesiredState(session_id=9, link_alive=True, stop=False, waypoint=WAYPOINT, max_speed_mps=0.8)
COLLECTING = Car(CarState.COLLECTING, MAP_PLACE)
LOCATED = Car(CarState.LOCATED)
CHECK_PLACE = Waypoint(5, CAR_LOCATOR, "map", Pose2(6.0, 1.0, 2.0))
LOOKING = replace(LOCATED, next_waypoint=CHECK_PLACE)
ORDERS_CHECK = replace(WANTS, check_car_id=4)
PASSED = CheckReport(4, Check.PASSED, Problem(text="Passed."))
NOT_PASSED = CheckReport(4, Check.FAILED, Problem("car_locator.elsewhere", "The Car stands 3.0 cm off."))
LOST = {Part.LOCALIZATION: Problem(text="Localization is lost.")}


def seen(**changes):
    return replace(Observation(desired=WANTS, car=Car(), age_s=ALL_WELL), **changes)


@pytest.fixture
def machine():
    """One near which nobody comes; of holds see test_state_machine_hold.py."""
    return StateMachine(Parameters(resume_by_operator=False))


@pytest.fixture
def mapping(machine):
    machine.step(seen(car=COLLECTING))
    assert machine.state is State.MAPPING_CAR
    return machine


@pytest.fixture
def following(mapping):
    mapping.step(seen(car=LOCATED))
    assert mapping.state is State.FOLLOWING_WAYPOINT
    return mapping


@pytest.fixture
def checking(following):
    following.step(seen(car=LOCATED, desired=ORDERS_CHECK))
    assert following.state is State.CHECKING_CAR
    return following


def reported(decision, result, message=NO_PROBLEM):
    return GoalReport(decision.goal.id, result, message)


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


def test_machine_that_has_done_nothing_confirms_nothing(machine):
    decision = machine.step(seen(desired=DesiredState()))
    assert (decision.session_id, decision.waypoint_id, decision.map_car_id, decision.check_car_id) == (0, 0, 0, 0)


def test_part_that_is_as_old_as_allowed_is_well(machine):
    assert machine.step(seen(age_s={part: 0.4 for part in Part})).state is not State.STARTING


def test_part_whose_limit_is_over_at_the_next_tick_has_failed_at_this_one(following):
    assert following.step(seen(age_s={**dict.fromkeys(Part, 0.1), Part.PERIPHERALS: 0.48})).state is State.FAULT


@pytest.mark.parametrize("age_s", [-60.0, -0.6, 0.6, float("nan"), float("inf")])
def test_message_of_the_future_or_of_no_time_is_a_silent_part(machine, age_s):  # A10
    assert machine.step(seen(age_s={part: age_s for part in Part})).state is State.STARTING


def test_car_locator_that_had_failed_before_the_first_tick_is_a_fault(machine):
    assert machine.step(seen(car=Car(CarState.FAILED))).state is State.FAULT


def test_first_check_of_a_session_is_taken(following):
    decision = following.step(seen(car=LOOKING, desired=replace(WANTS, check_car_id=1)))
    assert (decision.state, decision.check_car_id) == (State.CHECKING_CAR, 1)


def test_mapping_order_that_is_withdrawn_is_no_new_one(following):
    order = replace(WANTS, map_car_id=3)
    following.step(seen(car=LOCATED, desired=order))
    following.step(seen(car=replace(LOCATED, map_car_id=3), desired=order))
    assert following.step(seen(car=replace(LOCATED, map_car_id=3))).state is State.FOLLOWING_WAYPOINT


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


ROUND_IT = Problem("car_locator.goes_round", "Goes round the Car.")
NO_WAY = Problem("motion_planner.no_way", "No way.")


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


def test_while_checking_the_operator_reads_of_this_check_only(checking):
    running = CheckReport(4, Check.RUNNING, ROUND_IT)
    assert checking.step(seen(car=LOOKING, desired=ORDERS_CHECK, check=running)).message == ROUND_IT
    earlier = checking.step(seen(car=LOOKING, desired=ORDERS_CHECK, check=replace(running, id=3)))
    assert earlier.message and earlier.message != ROUND_IT
