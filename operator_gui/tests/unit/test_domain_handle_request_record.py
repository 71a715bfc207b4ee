"""What the Handle request scenario keeps, counts and expects."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.assistance import OUTPUT
from mtr_operator.domain.ports import HANDLE, KEY_BUTTON, PASSIVE_ENTRY, LockFacts
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.handle_request import SCENARIO
from mtr_operator.domain.scenarios.handle_request.axis_trial import AxisTrial, axes_of
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.domain.scenarios.handle_request.result import HandleRequestResult

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = HandleRequestParameters(side="left", measurements_distance_m=10.0, self_check=False)


@pytest.fixture(autouse=True)
def car_with_handle(world):
    """It unlocks by the handle only, and names its cause."""
    world.unlock_m, world.lock_m = -1.0, -1.0
    world.facts = LockFacts(frozenset({PASSIVE_ENTRY, KEY_BUTTON, HANDLE}))


@pytest.fixture
def measured(run_scenario, output):
    """An axis measured whole."""
    result, = run_scenario(SCENARIO, PARAMETERS)
    return result


def test_each_request_is_kept_with_what_came_of_it(run_scenario, output, monkeypatch):
    kept, keep = [], Robot.keep

    def spy(robot, word, status, distance=None):
        kept.append((status, distance.distance_m))
        keep(robot, word, status, distance)

    monkeypatch.setattr(Robot, "keep", spy)
    result, = run_scenario(SCENARIO, PARAMETERS)
    worked = [distance_m for status, distance_m in kept if status is LineStatus.OK]
    failed = [distance_m for status, distance_m in kept if status is LineStatus.NOT_REACHED]
    assert worked == pytest.approx(result.worked_at_m, abs=1e-3)
    assert failed == pytest.approx(result.failed_at_m, abs=1e-3)
    assert len(kept) == result.requests


def joined(before, after):
    line, = axes_of(PARAMETERS, CAR)
    return AxisTrial(line, PARAMETERS, None).joined(before, after)


def test_more_requests_that_were_all_outside_leave_the_farthest_one_inside(measured):
    outside = replace(measured, inside=0, outside=2, requests=2, worked_at_m=(), failed_at_m=(1.7, 1.8),
                      distance_m=None, uncertainty_m=None, robot_time_s=None, requested_by="")
    both = joined(measured, outside)
    assert (both.distance_m, both.robot_time_s) == (measured.distance_m, measured.robot_time_s)
    assert (both.inside, both.outside) == (measured.inside, measured.outside + 2)


def test_farther_one_of_more_requests_is_the_farthest(measured):
    farther = replace(measured, distance_m=measured.distance_m + 0.1, robot_time_s=measured.robot_time_s + 60.0)
    assert joined(measured, farther).distance_m == farther.distance_m
    assert joined(measured, replace(farther, distance_m=0.1)).robot_time_s == measured.robot_time_s


def test_who_took_the_handle_first_is_told_when_nobody_had_to_again(measured):
    assert measured.requested_by == OUTPUT
    assert joined(measured, replace(measured, requested_by="")).requested_by == OUTPUT
    assert joined(replace(measured, requested_by=""), measured).requested_by == OUTPUT


def test_axis_is_expected_to_take_the_middle_of_what_the_planner_says():
    shortest_s, longest_s = SCENARIO.forecast(PARAMETERS, LockFacts(), ()).line_s
    assert shortest_s < SCENARIO.expected_line_s(PARAMETERS) < longest_s
    assert SCENARIO.expected_line_s(PARAMETERS) - shortest_s == pytest.approx(
        longest_s - SCENARIO.expected_line_s(PARAMETERS))


def test_request_that_was_not_confirmed_counts_as_one_inside(measured):
    with_one = replace(measured, unconfirmed_m="2.50", inside=measured.inside + 1, requests=measured.requests + 1)
    assert result_from_document(HandleRequestResult, with_one.to_document()) == with_one
    with pytest.raises(ValueError, match="none of the scenario's"):
        result_from_document(HandleRequestResult, {**with_one.to_document(), "inside": measured.inside})


@pytest.mark.parametrize("count", ["inside_at_border", "outside_at_border"])
@pytest.mark.parametrize("change", [-1, 1])
def test_no_more_requests_at_the_border_than_on_the_axis_and_no_fewer_than_none(measured, count, change):
    impossible = -1 if change < 0 else measured.requests + 1
    with pytest.raises(ValueError, match="none of the scenario's"):
        result_from_document(HandleRequestResult, {**measured.to_document(), count: impossible})
