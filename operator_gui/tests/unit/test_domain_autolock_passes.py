"""Passes of the Autolock scenario at several speeds: their course, what is kept, the static boundary, bad speeds."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import PASSIVE_ENTRY, LockFacts
from mtr_operator.domain.results.journal import POINT
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.autolock import SCENARIO
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.domain.scenarios.autolock_speeds import pass_speeds, speed_cautions
from mtr_operator.storage.progress_file import load_progress
from mtr_operator.storage.store import Store

ONE = AutolockParameters(measurements_distance_m=10.0, measuring_speed_mps=0.4)
TWO = replace(ONE, passes=2, measuring_speed_mps=None, measuring_speeds_mps=(0.4, 0.1))
REACTION_S = 0.5


class Actions(RunObserver):
    """What was done; raises at an action that begins so, in the second axis."""

    def __init__(self, last=None):
        self.said, self._last = [], last

    def on_action(self, text):
        self.said.append(text)
        if self._last and text.startswith(self._last) and any(said.startswith("axis 2 ") for said in self.said):
            raise Cancelled("The test was interrupted.")


@pytest.fixture
def late_world(world):
    """A Car that reacts half a second after the key has passed its boundary, told every 20 ms."""
    at_once = world.turn_locks

    def later(locked, time_s, source):
        if source == "late":
            at_once(locked, time_s, PASSIVE_ENTRY)
        else:
            world.foreign.append((time_s + REACTION_S, locked, "late"))
    world.turn_locks = later
    world.facts = replace(world.facts, told_every_s=0.02)
    return world


def test_two_passes_find_the_static_boundary_that_one_misses_by_its_reaction_time(run_scenario, late_world):
    results = run_scenario(SCENARIO, TWO)
    for result in results:
        assert result.unlock_distance_m == pytest.approx(1.3, abs=0.02)
        assert result.unlock_pass_distances_m == pytest.approx((1.3, 1.45), abs=0.02)
        assert result.lock_pass_distances_m == pytest.approx((2.7, 2.55), abs=0.02)
        assert result.unlock_pass_speeds_mps == result.lock_pass_speeds_mps == pytest.approx((0.4, 0.1))
        assert (result.unlock_passes, result.lock_passes) == (2, 2)
        assert result.unlock_static_low_m < 1.5 < result.unlock_static_high_m
        assert result.lock_static_low_m < 2.5 < result.lock_static_high_m
        assert result.unlock_reaction_low_s < REACTION_S < result.unlock_reaction_high_s
        assert result.unlock_static_sigma_m > 0.03
        assert 0.0 <= result.unlock_static_shared_sigma_m <= result.unlock_static_common_sigma_m
        assert 0.0 < result.lock_static_common_sigma_m < result.lock_static_sigma_m
        assert result.distances[0].common_sigma_m == result.unlock_static_common_sigma_m
        unlock, _ = result.distances
        assert unlock.distance_m == result.unlock_static_m
        assert (unlock.low_m, unlock.high_m) == (result.unlock_static_low_m, result.unlock_static_high_m)


def test_one_pass_has_no_static_boundary(run_scenario, late_world):
    for result in run_scenario(SCENARIO, ONE):
        assert (result.unlock_passes, result.unlock_static_m, result.lock_reaction_s) == (1, None, None)
        assert result.distances[0].distance_m == result.unlock_distance_m == pytest.approx(1.3, abs=0.02)
        assert result.distances[0].low_m is None


def test_all_axes_are_read_with_what_the_last_one_says(run_scenario, late_world):
    results = run_scenario(SCENARIO, TWO)
    live = run_scenario.saved[0][0]
    assert live.unlock_static_m is not None
    # The first axis alone knows less of the Car than all of them.
    assert (results[0].unlock_static_high_m - results[0].unlock_static_low_m
            < live.unlock_static_high_m - live.unlock_static_low_m)
    assert SCENARIO.concluded(TWO, results) == []


def test_second_pass_is_slow_only_about_the_boundary(run_scenario, robot_link, late_world):
    run_scenario(SCENARIO, TWO)
    ways = {}
    for _, desired in robot_link.answers:
        if desired.waypoint is not None:
            ways.setdefault(desired.waypoint.id, desired)
    first = [(round(ways[number].waypoint.pose.x - 2.0, 2), ways[number].max_speed_mps) for number in range(1, 9)]
    assert first[:4] == [(4.5, 1.0), (4.0, 1.0), (1.0, 0.4), (4.0, 0.4)]
    # Back to behind where it locked, on to where it is slow, then the approach and the retreat.
    assert [speed for _, speed in first[4:]] == [1.0, 1.0, 0.1, 0.1]
    assert first[5][0] == pytest.approx(1.3 + 1.3 * 0.4 + 0.25 + 0.5, abs=0.03)


def test_pass_in_steps_brackets_the_boundary(run_scenario, late_world):
    stepped = replace(ONE, last_step_m=0.05)
    for result in run_scenario(SCENARIO, stepped):
        assert result.unlock_pass_speeds_mps == pytest.approx((0.4, 0.0))
        assert 1.44 < result.unlock_pass_distances_m[1] <= 1.5
        assert result.unlock_static_low_m < 1.5 < result.unlock_static_high_m
        assert result.unlock_static_high_m - result.unlock_static_low_m < 0.25


def test_pass_that_fails_is_tried_again_and_takes_nothing_from_the_first(run_scenario, late_world):
    actions = Actions()
    late_world.car_problem = lambda time_s: (
        "The bus is off." if actions.said[-1:] == ["pass 2: approach until the Car unlocks"] else "")
    results = run_scenario(SCENARIO, TWO, observer=actions)
    assert [result.unlock_pass_distances_m for result in results] == 8 * [(pytest.approx(1.3, abs=0.02),)]
    assert all(result.unlock_status is LineStatus.OK and not result.reason for result in results)
    assert actions.said.count("warning: pass 2 of this axis was not measured. The bus is off.") == 16


def test_boundary_out_of_reach_is_not_passed_again(run_scenario, late_world):
    late_world.unlock_m = 0.3
    actions = Actions()
    results = run_scenario(SCENARIO, TWO, observer=actions)
    assert {result.unlock_status for result in results} == {LineStatus.NOT_REACHED}
    assert not any(text.startswith("pass 2") for text in actions.said)


def test_one_more_pass_of_an_inconclusive_axis_makes_its_interval_narrower(robot_link, car_link, late_world):
    late_world.facts = replace(late_world.facts, told_every_s=0.2)
    progress = Progress("autolock", TWO.to_mapping())
    loop = ControlLoop(robot_link, car_link)
    Runner(SCENARIO, TWO, loop, progress, lambda _: None).run()
    before, car = progress.results[3], Car(loop)
    result = SCENARIO.measure_further(SCENARIO.lines(TWO, car.dimensions())[3], TWO, Robot(loop, progress.results), car,
                                      before)
    assert result.unlock_pass_distances_m[:2] == before.unlock_pass_distances_m
    assert result.unlock_pass_speeds_mps == pytest.approx((0.4, 0.1, 0.1)) and result.lock_passes == 3
    assert (result.unlock_static_high_m - result.unlock_static_low_m
            < before.unlock_static_high_m - before.unlock_static_low_m)
    assert SCENARIO.measure_further(SCENARIO.lines(ONE, car.dimensions())[3], ONE, Robot(loop), car, before) is None


def test_limits_may_ask_for_the_static_boundary_where_passes_tell_it():
    assert SCENARIO.judged_shares(TWO) == SCENARIO.judged_shares(replace(ONE, last_step_m=0.05)) == (50,)
    assert SCENARIO.judged_shares(ONE) == SCENARIO.judged_shares(replace(TWO, measuring_speeds_mps=(0.4,))) == ()


def test_picture_shows_the_intervals_of_the_static_boundaries(run_scenario, late_world):
    results = run_scenario(SCENARIO, TWO)
    unlocked, locked = SCENARIO.picture(TWO, late_world.car, results).point_sets[:2]
    assert len(unlocked.intervals) == len(locked.intervals) == 8 and not unlocked.bars
    (near_x, _), (far_x, _) = unlocked.intervals[0]
    assert (near_x, far_x) == pytest.approx((2.25 + results[0].unlock_static_low_m,
                                             2.25 + results[0].unlock_static_high_m))


def test_result_with_passes_survives_its_file(run_scenario, late_world):
    result = run_scenario(SCENARIO, TWO)[0]
    assert result_from_document(AutolockResult, result.to_document()) == result


@pytest.mark.parametrize(("last", "kept"), [("pass 2: approach", 2), ("retreat", 1)])
@pytest.mark.usefixtures("late_world")
def test_interrupted_axis_goes_on_with_its_points_of_all_passes(tmp_path, robot_link, car_link, last, kept):
    path, points = tmp_path / "progress.json", []
    progress = Progress("autolock", TWO.to_mapping())

    def run(actions):
        with Store(path, progress) as store:
            add = store.add
            store.add = lambda kind, values: (points.append(values) if kind == POINT else None, add(kind, values))
            Runner(SCENARIO, TWO, ControlLoop(robot_link, car_link, actions), progress, lambda _: store.save(),
                   journal=store).run()
    with pytest.raises(Cancelled):
        run(Actions(last))
    before = points[4:]
    assert [point["word"] for point in before] == ["unlock", "lock"][:kept]
    progress = load_progress(path.with_suffix(".journal"), SCENARIO, TWO.to_mapping())
    points.clear()
    run(Actions())
    assert [point["word"] for point in points[:4 - kept]] == ["unlock", "lock", "unlock 2", "lock 2"][kept:]
    result = progress.results[1]
    assert result.unlock_pass_distances_m == pytest.approx((1.3, 1.45), abs=0.02)
    assert result.unlock_robot_time_s == pytest.approx(before[0]["distance"]["robot_time_s"])
    assert not progress.retried


def test_proposed_speeds_hold_the_budget():
    parameters = AutolockParameters(passes=3, boundary_sigma_m=0.03)
    assert pass_speeds(parameters, 0.2) == pytest.approx((0.4, 0.135, 0.4), abs=0.001)
    assert not list(speed_cautions(parameters, 0.2))
    assert pass_speeds(replace(parameters, measuring_speed_mps=0.2), 0.2)[0] == 0.2


def test_speeds_that_the_cars_cycle_makes_meaningless_are_told_with_their_sigma(run_scenario, world):
    world.facts = LockFacts(frozenset({PASSIVE_ENTRY}), told_every_s=0.8)
    actions = Actions()
    run_scenario(SCENARIO, replace(TWO, measuring_speeds_mps=(0.4, 0.3)), observer=actions)
    assert [said for said in actions.said if said.startswith("warning: At")] == [
        "warning: At 0.30 m/s, with a message of the Car every 0.80 s, the static boundary of an axis has a sigma of "
        "0.419 m; boundary_sigma_m asks for 0.030 m. Pass at 0.07 m/s."]


def test_passes_at_one_speed_are_told_to_leave_the_reaction_time_inside():
    parameters = AutolockParameters(passes=2, measuring_speeds_mps=(0.3,))
    assert "one speed" not in "".join(speed_cautions(AutolockParameters(), 0.2))
    assert "reaction time stays inside" in next(speed_cautions(parameters, 0.2))


@pytest.mark.parametrize(("values", "words"), [
    ({"measuring_speeds_mps": [0.4, 0.1]}, "passes is 1; allowed is at least one for each of the 2 speeds"),
    ({"passes": 2, "measuring_speeds_mps": [0.4, 1.5]}, "measuring_speeds_mps is 1.5 m/s; allowed is at most"),
    ({"measuring_speeds_mps": [0.4], "measuring_speed_mps": 0.4}, "are both given; give one"),
    ({"passes": 2, "measuring_speeds_mps": [0.01]}, "measuring_speeds_mps is 0.01 m/s; allowed is 0.05 to 2 m/s"),
    ({"passes": 2, "measuring_speeds_mps": 0.4}, "allowed is a list of numbers"),
    ({"passes": 2, "measuring_speeds_mps": []}, "allowed is a list of numbers"),
    ({"passes": 2, "measuring_speeds_mps": [0.4, "slow"]}, "'slow'; allowed is a number"),
    ({"passes": 2, "measuring_speeds_mps": [0.4, float("nan")]}, "measuring_speeds_mps is nan"),
])
def test_bad_speeds_are_told_with_what_is_allowed(values, words):
    with pytest.raises(InvalidParameter, match=words):
        AutolockParameters.from_mapping(values)


def test_list_of_speeds_survives_a_file():
    mapping = TWO.to_mapping()
    assert mapping["measuring_speeds_mps"] == [0.4, 0.1]
    assert AutolockParameters.from_mapping(mapping) == TWO
