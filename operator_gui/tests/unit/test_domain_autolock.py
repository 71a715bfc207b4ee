"""The Autolock scenario against a kinematic robot and a Car with two radii."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import LinkLost, RobotFailed
from mtr_operator.domain.ports import KEY_BUTTON
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarCheck, CarDimensions, CheckState, Mode, WaypointResult
from mtr_operator.domain.scenarios.autolock import SCENARIO
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.autolock_result import AutolockResult

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = AutolockParameters(measurements_distance_m=10.0, measuring_speed_mps=0.4)
# The key moves 4 mm while the Car looks once.
TOLERANCE_M = 0.005


def statuses(results, name):
    return [distance.status.value for result in results for distance in result.distances if distance.word == name]


def test_all_axes_are_measured_at_the_instant_of_the_event(run_scenario, world):
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.axis for result in results] == list(range(1, 9))
    for result in results:
        assert result.unlock_status.value == result.lock_status.value == "ok"
        assert result.unlock_distance_m == pytest.approx(world.unlock_m, abs=TOLERANCE_M)
        assert result.lock_distance_m == pytest.approx(world.lock_m, abs=TOLERANCE_M)
        assert result.unlock_robot_time_s < result.lock_robot_time_s
        assert 0.03 < result.unlock_uncertainty_m < 0.035
        assert result.reason == ""


def test_way_on_an_axis_is_that_of_the_algorithm(run_scenario, robot_link):
    run_scenario(SCENARIO, PARAMETERS)
    ways = {}
    for _, desired in robot_link.answers:
        ways.setdefault(desired.waypoint and desired.waypoint.id, desired)
    first = [ways[number] for number in (1, 2, 3, 4, 5)]
    assert [desired.waypoint.pose.x for desired in first[:4]] == pytest.approx([6.5, 6.0, 3.0, 6.0])
    assert [desired.waypoint.direction for desired in first] == [
        Direction.ANY, Direction.FORWARD, Direction.FORWARD, Direction.BACKWARD, Direction.ANY]
    assert [desired.max_speed_mps for desired in first] == [1.0, 1.0, 0.4, 0.4, 1.0]


def test_car_that_stays_locked_is_not_reached(run_scenario, world):
    world.unlock_m = 0.3
    results = run_scenario(SCENARIO, PARAMETERS)
    assert set(statuses(results, "unlock") + statuses(results, "lock")) == {"not_reached"}
    assert results[0].unlock_distance_m is None
    assert results[0].reason == ""


def test_car_that_reacts_late_at_the_end_of_the_approach_is_measured_there(run_scenario, world):
    parameters = replace(PARAMETERS, minimum_distance_m=1.499)
    results = run_scenario(SCENARIO, parameters)
    assert results[0].unlock_status.value == "ok"
    assert results[0].unlock_distance_m == pytest.approx(1.5, abs=TOLERANCE_M)


def test_car_that_never_locks_again_is_not_reached_and_then_invalid(run_scenario, world):
    world.lock_m = 99.0
    results = run_scenario(SCENARIO, PARAMETERS)
    assert (results[0].unlock_status.value, results[0].lock_status.value) == ("ok", "not_reached")
    assert set(statuses(results[1:], "unlock")) == {"invalid"}
    assert "still unlocked 10 s after" in results[1].reason


def test_car_found_unlocked_is_invalid_and_says_what_to_do(run_scenario, world):
    world.locked, world.near, world.lock_m = False, True, 99.0
    results = run_scenario(SCENARIO, PARAMETERS)
    assert set(statuses(results, "unlock")) == set(statuses(results, "lock")) == {"invalid"}
    assert "lock it with its key, or increase maximum_distance_m" in results[0].reason


@pytest.mark.parametrize("spoilt", ["unlock", "lock"])
def test_change_by_a_button_is_no_answer_to_the_keys_vicinity(run_scenario, world, spoilt):
    pressed_when_locked = spoilt == "lock"
    world.source_of = lambda source: KEY_BUTTON if world.locked is pressed_when_locked else source
    results = run_scenario(SCENARIO, PARAMETERS)
    assert statuses(results, spoilt) == 8 * ["invalid"]
    assert "by the button of a key" in results[0].reason


def test_unlocking_on_the_way_of_straightening_counts(run_scenario, world):
    world.unlock_m, world.lock_m = 3.8, 3.9
    results = run_scenario(SCENARIO, PARAMETERS)
    assert results[0].unlock_distance_m == pytest.approx(3.8, abs=0.011)
    assert results[0].lock_status.value == "not_reached"


def test_line_spoilt_once_is_measured_again_at_the_end(run_scenario, world):
    world.car_problem = lambda time_s: "The bus is off." if 12.0 < time_s < 12.5 else ""
    results = run_scenario(SCENARIO, PARAMETERS)
    saved = run_scenario.saved
    assert len(saved) == 9
    spoilt = [result for result in saved[-2] if result.unlock_status.value == "invalid" or
              result.lock_status.value == "invalid"]
    assert len(spoilt) == 1
    assert spoilt[0].reason == "The bus is off."
    assert statuses(results, "unlock") == statuses(results, "lock") == 8 * ["ok"]


def test_measured_half_of_a_spoilt_line_is_kept(run_scenario, world):
    world.car_problem = lambda time_s: "The bus is off." if not world.locked and world.result.name == "PENDING" and \
        world.waypoint.direction is Direction.BACKWARD else ""
    results = run_scenario(SCENARIO, PARAMETERS)
    assert (results[0].unlock_status.value, results[0].lock_status.value) == ("ok", "invalid")
    assert results[0].unlock_distance_m == pytest.approx(1.5, abs=TOLERANCE_M)
    assert results[0].lock_distance_m is None


def is_right_of_car(pose):
    return pose.y < -4.5 and abs(pose.x) < 0.01


def test_refused_waypoint_makes_its_line_invalid_with_the_robots_reason(run_scenario, world):
    world.refuses = lambda waypoint: "A wall is in the way." if is_right_of_car(waypoint.pose) else ""
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.side for result in results if result.unlock_status.value == "invalid"] == ["right"]
    assert "A wall is in the way." in results[2].reason
    assert len(run_scenario.saved) == 9


def test_lost_position_makes_the_line_invalid(run_scenario, spoil):
    spoil(lambda status: 5.0 < status.stamp_s < 5.3, pose_valid=False)
    run_scenario(SCENARIO, PARAMETERS)
    assert "position" in run_scenario.saved[0][0].reason
    assert statuses(run_scenario.progress.results, "unlock") == 8 * ["ok"]


def test_interrupted_link_makes_the_line_invalid(run_scenario, world):
    world.spoil = lambda status: None if 5.0 < status.stamp_s < 6.5 else status
    run_scenario(SCENARIO, PARAMETERS)
    assert "interrupted for 1.5 s" in run_scenario.saved[0][0].reason
    assert statuses(run_scenario.progress.results, "unlock") == 8 * ["ok"]


def test_car_that_falls_silent_ends_the_test_and_keeps_what_was_measured(run_scenario, world):
    world.car_problem = lambda time_s: "No frame for 1 s." if time_s > 30.0 else ""
    with pytest.raises(LinkLost, match="No frame for 1 s"):
        run_scenario(SCENARIO, PARAMETERS)
    assert run_scenario.saved[-1]
    assert world.desired.stop


def test_wish_to_end_stops_the_robot_and_keeps_what_was_measured(run_scenario, world, robot_link):
    with pytest.raises(Cancelled):
        run_scenario(SCENARIO, PARAMETERS, is_cancelled=lambda: world.time_s > 30.0)
    assert len(run_scenario.saved[-1]) >= 1
    assert robot_link.answers[-1][1].stop
    assert world.speed_mps == 0.0


def test_continued_test_measures_the_rest_and_keeps_the_former(run_scenario, world):
    with pytest.raises(Cancelled):
        run_scenario(SCENARIO, PARAMETERS, is_cancelled=lambda: world.time_s > 30.0)
    former = list(run_scenario.progress.results)
    world.unlock_m = 1.2
    results = run_scenario(SCENARIO, PARAMETERS, progress=run_scenario.progress)
    assert results[:len(former)] == former
    assert len(results) == 8
    assert results[-1].unlock_distance_m == pytest.approx(1.2, abs=TOLERANCE_M)


def test_every_line_is_saved_before_the_robot_goes_on(run_scenario):
    run_scenario(SCENARIO, PARAMETERS)
    assert [len(results) for results in run_scenario.saved] == list(range(1, 9))


def test_new_robot_is_led_through_mapping_and_self_check(run_scenario, world):
    world.car, world.mode, world.check = None, Mode.STARTING, CarCheck(state=CheckState.PASSED)

    def grow_up(status):
        if status.stamp_s > 3.0:
            world.mode = Mode.READY_TO_MAP_CAR
        if world.mode is Mode.READY_TO_MAP_CAR and world.waypoint is not None:
            world.mode = Mode.FOLLOWING_WAYPOINT
            world.car = CAR
        return status
    world.spoil = grow_up
    actions = []

    class Listener(RunObserver):
        def on_action(self, text):
            actions.append(text)

    assert len(run_scenario(SCENARIO, PARAMETERS, observer=Listener())) == 8
    assert actions[:5] == ["wait for robot and Car", "move the key to 100 cm", "map the Car",
                           "check where the Car stands", "axis 1 (front): go to the start"]
    assert actions[-1] == "the robot stands still"


def test_robot_that_cannot_find_the_car_is_an_error(run_scenario, world):
    world.car, world.mode = None, Mode.READY_TO_MAP_CAR
    with pytest.raises(RobotFailed, match="did not find the Car within 600 s"):
        run_scenario(SCENARIO, PARAMETERS)


def test_better_measurement_of_a_line_wins():
    progress = Progress("autolock", {})
    bad = AutolockResult(1, "front", 2.25, 0.0, 1.0, 0.0, LineStatus.INVALID, None, None, None,
                         LineStatus.INVALID, None, None, None, "The bus is off.")
    good = replace(bad, unlock_status=LineStatus.OK, unlock_distance_m=1.5)
    progress.record(good)
    progress.record(bad)
    assert progress.results == [good]
    assert progress.to_retry() == []


def test_picture_shows_points_and_gaps_in_order(run_scenario, world):
    world.refuses = lambda waypoint: "No." if is_right_of_car(waypoint.pose) else ""
    results = run_scenario(SCENARIO, PARAMETERS)
    picture = SCENARIO.picture(PARAMETERS, CAR, results)
    unlocked, locked = picture.point_sets[:2]
    assert unlocked.label == "Unlocked"
    assert unlocked.points[2] is None
    assert unlocked.points[0] == pytest.approx((2.25 + 1.5, 0.0), abs=TOLERANCE_M)
    assert [is_known for _, _, is_known in locked.pieces()] == [True, False, True, True, True, True, True]
    invalid = next(points for points in picture.point_sets if points.label == "Invalid")
    assert len(invalid.known) == 1
    assert len(picture.stretches) == 8


def test_car_that_locks_a_while_after_the_start_was_reached_is_waited_for(run_scenario, world):
    world.locked, world.near, world.lock_m = False, True, 99.0
    reached_s = []

    def lock_after_two_seconds(status):
        if status.waypoint_result is WaypointResult.REACHED:
            reached_s.append(world.time_s)
        if reached_s and world.time_s > reached_s[0] + 2.0:
            world.lock_m = 2.5
        return status

    world.spoil = lock_after_two_seconds
    results = run_scenario(SCENARIO, PARAMETERS)
    assert (results[0].unlock_status.value, results[0].lock_status.value) == ("ok", "ok")
