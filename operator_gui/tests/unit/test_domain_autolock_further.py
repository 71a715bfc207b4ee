"""Autolock: one more pass of an axis that the limits leave open, steps, and what a trouble takes from the passes."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.standstill import Standstill
from mtr_operator.domain.exchange.exchange import SILENCE_LIMIT_S
from mtr_operator.domain.ports import PASSIVE_ENTRY
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarFrame, Interventions
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.autolock import SCENARIO
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters

TWO = AutolockParameters(measurements_distance_m=10.0, passes=2, measuring_speeds_mps=(0.4, 0.1))
ANY, FORWARD, BACKWARD = Direction.ANY, Direction.FORWARD, Direction.BACKWARD
# Distance of base_link from the Car's centre when the key touches its front.
FRONT_M = 2.5


def ways(answers):
    """Of the robot in front of the Car: distance of the key, direction and speed of each waypoint."""
    first = {}
    for _, desired in answers:
        if desired.waypoint is not None:
            first.setdefault(desired.waypoint.id, desired)
    return [(round(each.waypoint.pose.x - FRONT_M, 2), each.waypoint.direction, each.max_speed_mps)
            for each in first.values()]


def since_the_run():
    """A run ends with the last estimate, which may take as long as it likes: the robot has stopped before."""
    return Standstill(SILENCE_LIMIT_S)


@pytest.fixture
def further(robot_link, car_link):
    """further(**changes) measures all axes, and the one in front once more with its result so changed; the result
    before and after, and the ways of the one more pass. The robot stands on the axis, where the straightening ends."""
    def run(**changes):
        progress, loop = Progress("autolock", TWO.to_mapping()), ControlLoop(robot_link, car_link)
        Runner(SCENARIO, TWO, loop, progress, lambda _: None).run()
        loop.exchange.standstill = since_the_run()
        robot, car = Robot(loop, progress.results), Car(loop)
        line = SCENARIO.lines(TWO, car.dimensions())[0]
        robot.go_to(line.ray, TWO.straightened_distance_m)
        robot.wait_until_reached()
        done, before = len(robot_link.answers), replace(progress.results[0], **changes)
        after = SCENARIO.measure_further(line, TWO, robot, car, before)
        return before, after, ways(robot_link.answers[done:])
    return run


def test_one_more_pass_is_slow_only_about_where_the_first_one_says_that_the_car_reacts(further):
    before, after, driven = further()
    slow_m = before.unlock_distance_m + 1.3 * 0.4 + 0.25
    assert driven == [(pytest.approx(slow_m, abs=0.006), FORWARD, 1.0), (0.5, FORWARD, 0.1), (3.5, BACKWARD, 0.1)]
    assert after.unlock_pass_speeds_mps == after.lock_pass_speeds_mps == pytest.approx((0.4, 0.1, 0.1))
    assert after.unlock_distance_m == before.unlock_distance_m


@pytest.fixture
def measured(robot_link, car_link):
    """A runner that has measured all axes."""
    progress, loop = Progress("autolock", TWO.to_mapping()), ControlLoop(robot_link, car_link)
    runner = Runner(SCENARIO, TWO, loop, progress, lambda _: None)
    runner.run()
    loop.exchange.standstill = since_the_run()
    return runner, progress, SCENARIO.lines(TWO, loop.car_dimensions)[0]


def test_axis_of_the_present_frame_gets_one_more_pass(measured):
    runner, progress, line = measured
    assert runner._measure_line_further(line)
    assert len(progress.results[0].unlock_pass_distances_m) == 3


@pytest.mark.parametrize("when", ["before", "on the way"])
def test_axis_of_a_frame_before_gets_no_more_attempts_and_stays_as_it_is(measured, world, robot_link, when):
    runner, progress, line = measured
    before, lines, done = progress.results[0], dict(progress.frame_record.lines), len(robot_link.answers)

    def correct(status):
        world.frame = CarFrame(2, 0.08, 0.0, 0.0)
        return status
    if when == "before":
        correct(None)
        # As the robot stood: the frame of the next Status is the new one.
        runner._loop.step()
        done = len(robot_link.answers)
    else:
        world.spoil = correct
    assert not runner._measure_line_further(line)
    assert (progress.results[0], progress.frame_record.lines) == (before, lines)
    if when == "before":
        assert len(robot_link.answers) == done


def test_line_that_nobody_knows_the_frame_of_gets_no_more_attempts(measured):
    runner, progress, line = measured
    del progress.frame_record.lines["1"]
    assert not runner._measure_line_further(line)


@pytest.mark.parametrize("kept", ["lock", "unlock 2"])
def test_passes_of_two_frames_are_not_mixed_and_the_axis_stays_in_that_of_the_first(run_scenario, world, kept):
    """The frame is corrected between the passes, where nothing is watched, or in the middle of the second one."""
    def correct(status):
        if status.stamp_s > 5.0 and kept in run_scenario.progress.points:
            world.frame = CarFrame(2, 0.08, 0.0, 0.0)
        return status
    world.spoil = correct
    first, second, *_ = run_scenario(SCENARIO, TWO)
    record = run_scenario.progress.frame_record
    assert (len(first.unlock_pass_distances_m), len(second.unlock_pass_distances_m)) == (1, 2)
    assert (first.unlock_status.value, first.lock_status.value) == ("ok", "ok")
    assert [record.frames[record.lines[number]].revision for number in ("1", "2")] == [0, 2]


def test_axis_on_which_the_car_did_not_lock_again_has_no_more_pass(further):
    _, after, driven = further(lock_distance_m=None)
    assert after is None and driven == []


@pytest.mark.parametrize(("passes", "goes_on"), [(15, True), (16, False)])
def test_axis_that_nobody_can_decide_has_16_passes_at_most(further, passes, goes_on):
    _, after, driven = further(unlock_pass_distances_m=passes * (1.5,), unlock_pass_speeds_mps=passes * (0.1,))
    assert (after is not None) is goes_on is bool(driven)


def test_approach_in_steps_ends_where_the_car_reacts(run_scenario, robot_link):
    run_scenario(SCENARIO, replace(TWO, passes=1, measuring_speeds_mps=(0.4,), last_step_m=0.25))
    stepped = ways(robot_link.answers)[5:]
    forward = [distance_m for distance_m, direction, _ in stepped[:stepped.index((3.5, BACKWARD, 0.4))]]
    # To where the steps begin, 0.77 m before the boundary of 1.5 m, and on by 0.25 m.
    assert forward == pytest.approx([2.27, 2.02, 1.77, 1.52, 1.27], abs=0.011)


@pytest.mark.parametrize(("later_s", "kept"), [(0.9, "invalid"), (1.0, "invalid"), (1.1, "ok")])
def test_what_the_car_did_up_to_a_second_before_a_stop_was_told_is_doubtful(run_scenario, world, spoil, later_s, kept):
    unlocked_s = 5.0
    world.unlock_m, world.foreign = 0.0, [(unlocked_s, False, PASSIVE_ENTRY)]
    spoil(lambda status: status.stamp_s > unlocked_s + later_s - 0.05, interventions=Interventions(lock_stops=1))
    world.foreign.append((30.0, True, PASSIVE_ENTRY))
    run_scenario(SCENARIO, replace(TWO, passes=1, measuring_speeds_mps=(0.4,)))
    first = run_scenario.saved[0][0]
    assert (first.unlock_status.value, first.lock_status.value) == (kept, "invalid")
    assert "A motion lock stopped the robot" in first.reason
