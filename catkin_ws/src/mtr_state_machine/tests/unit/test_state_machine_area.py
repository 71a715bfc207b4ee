"""A robot that needs a test area neither maps nor drives by itself without one, and reports the reason."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest
from state_machine_seen import ALL_WELL, COLLECTING, LOCATED, WANTS, WAYPOINT

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_GOAL, Waypoint
from mtr_core.states import State
from mtr_msgs.msg import DesiredState as DesiredMessage
from mtr_msgs.msg import Problem as ProblemMessage
from mtr_state_machine.conversions import observation
from mtr_state_machine.core import StateMachine
from mtr_state_machine.observation import Car, Observation, Part
from mtr_state_machine.parameters import Parameters

NO_AREA = Problem("dispatcher.no_area", "No test area is set.")
MAPS = replace(WANTS, waypoint=Waypoint(), map_car_id=3)


@pytest.fixture
def machine():
    started = StateMachine(Parameters(resume_by_operator=False, signal_s=0.0))
    started.step(Observation(desired=replace(WANTS, waypoint=Waypoint()), age_s=ALL_WELL))
    return started


def step(machine, desired, area_problem=NO_PROBLEM, car=COLLECTING):
    return machine.step(Observation(desired=replace(desired, area_problem=area_problem), car=car, age_s=ALL_WELL))


@pytest.mark.parametrize("desired", [WANTS, MAPS])
def test_mapping_does_not_begin_without_an_area_and_begins_with_it(machine, desired):
    for _ in range(5):
        decision = step(machine, desired, NO_AREA, Car())
        assert decision.state is State.READY_TO_MAP_CAR and decision.goal == NO_GOAL and not decision.mapping
        assert decision.message == NO_AREA
        # Manual driving is allowed: a person unloads the robot and drives it into its area.
        assert not decision.lock_reason
    assert step(machine, desired).state is State.MAPPING_CAR
    assert step(machine, desired).goal.waypoint == COLLECTING.next_waypoint


def test_area_that_ends_pauses_mapping_and_test(machine):
    step(machine, WANTS)
    assert step(machine, WANTS).goal != NO_GOAL
    assert step(machine, WANTS, NO_AREA).goal == NO_GOAL
    assert step(machine, WANTS).goal.waypoint == COLLECTING.next_waypoint
    step(machine, WANTS, car=LOCATED)
    assert step(machine, WANTS, car=LOCATED).goal.waypoint == WAYPOINT
    paused = step(machine, WANTS, NO_AREA, LOCATED)
    assert paused.goal == NO_GOAL and paused.state is State.FOLLOWING_WAYPOINT and paused.message == NO_AREA
    assert step(machine, WANTS, car=LOCATED).goal.waypoint == WAYPOINT


def test_car_is_not_mapped_again_without_an_area(machine):
    step(machine, WANTS)
    step(machine, WANTS, car=LOCATED)
    again = replace(WANTS, map_car_id=8)
    assert step(machine, again, NO_AREA, LOCATED).state is State.FOLLOWING_WAYPOINT
    assert step(machine, again, car=LOCATED).state is State.MAPPING_CAR


def test_problem_of_the_dispatcher_arrives():
    message = DesiredMessage(area_problems=[ProblemMessage(code="dispatcher.no_area", text="No test area is set.")])
    seen = observation({Part.DISPATCHER: message}, None, {Part.DISPATCHER: 0.0}, 1.0)
    assert seen.desired.area_problem == NO_AREA
    assert not observation({Part.DISPATCHER: DesiredMessage()}, None, {Part.DISPATCHER: 0.0}, 1.0).desired.area_problem
