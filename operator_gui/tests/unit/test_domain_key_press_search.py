"""Key press by search against a kinematic robot and a Car whose presses work by a probability."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.special import expit

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import InvalidParameter, RobotFailed
from mtr_operator.domain.estimation.press.transition import WIDTH_PER_SCALE
from mtr_operator.domain.ports import PASSIVE_ENTRY
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.journal import LINE, LINE_RESUMED, POINT, SUPERSEDED
from mtr_operator.domain.results.line_result import result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions, CarFrame, WaypointResult
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.key_press import SCENARIO
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.storage.progress_file import load_progress
from mtr_operator.storage.store import Store

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = KeyPressParameters.from_mapping(
    {"method": "adaptive", "angle_between_radials_deg": 90.0, "maximum_distance_m": 10.0, "interval_m": 0.3})


@pytest.fixture(autouse=True)
def passive_entry_off(world):
    world.unlock_m, world.lock_m = -1.0, -1.0


@pytest.fixture
def soften(world, robot_link):
    """soften(d50, width) draws the range anew for each press, so that p falls from 90 to 10 % over a width."""
    def arrange(d50_m, width_m, seed=1):
        rng, take = np.random.default_rng(seed), world.take

        def draw(desired):
            distance_m = math.hypot(*world.key())
            works = expit((d50_m - distance_m) * WIDTH_PER_SCALE / width_m)
            world.press_range_m = 99.0 if rng.random() < works else 0.0
            take(desired)
        world.take = draw
    return arrange


def places(robot_link):
    """Waypoints of the first radial, by distance of the key from the Car's centre, with their direction."""
    waypoints = {desired.waypoint.id: desired.waypoint for _, desired in robot_link.answers if desired.waypoint}
    return [(waypoint.pose.x - 0.25, waypoint.direction) for waypoint in waypoints.values()
            if waypoint.pose.x > 0.5 and abs(waypoint.pose.y) < 1e-6]


def restart(world):
    """The next run is a session of its own, whose presses count from 1 again."""
    world.pressed, world.presses = set(), []


def test_sharp_border_is_found_within_the_interval_wanted_on_every_radial(run_scenario):
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.status.value for result in results] == 4 * ["ok"]
    for result in results:
        assert result.d50_low_m <= 5.2 <= result.d50_high_m and result.d50_low_m < result.d50_m < result.d50_high_m
        assert result.d50_high_m - result.d50_low_m <= 0.7
        # That one of them may be soft leaves the first radial without a lower end within the places.
        assert result.d95_low_m is None or 3.0 <= result.d95_low_m <= result.d95_m
        assert result.d95_m < result.d50_m and result.d95_m <= result.d95_high_m
        assert result.distance_m <= 5.2 < result.failed_distance_m and result.nearest_failure_m > 5.2
        assert (result.method, result.reach, result.holes_m) == ("adaptive", "measured", "")
        assert result.attempts == len(result.worked_at_m) + len(result.failed_at_m) <= 24
        assert result.distance_m == max(result.worked_at_m)
        assert [(distance.distance_m, distance.low_m) for distance in result.distances] == [
            (result.d50_m, result.d50_low_m)]


def test_interval_includes_what_the_keys_place_is_not_known_to(run_scenario, spoil, world):
    narrow = run_scenario(SCENARIO, PARAMETERS)[0]
    restart(world)
    spoil(lambda status: True, position_sigma_m=0.5)
    wide = run_scenario(SCENARIO, PARAMETERS)[0]
    assert wide.d50_sigma_m == pytest.approx(math.hypot(0.5, narrow.d50_sigma_m), abs=0.1)
    assert wide.d50_high_m - wide.d50_low_m > 1.9 > narrow.d50_high_m - narrow.d50_low_m


@pytest.mark.parametrize("every", [1, 7])
def test_pose_without_sigma_leaves_no_interval(run_scenario, spoil, every):
    spoil(lambda status: status.id % every == 0, position_sigma_m=math.nan)
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert result.status.value == "ok" and result.d50_m is not None
    assert (result.d50_sigma_m, result.d50_low_m, result.d50_high_m, result.d95_low_m) == (None, None, None, None)


def test_soft_border_lies_within_the_intervals_of_most_radials(run_scenario, soften):
    soften(6.0, 1.0)
    parameters = replace(PARAMETERS, angle_between_radials_rad=math.radians(30.0))
    results = run_scenario(SCENARIO, parameters)
    assert sum(result.d50_low_m <= 6.0 <= result.d50_high_m for result in results) >= 10
    assert abs(np.mean([result.d50_m for result in results]) - 6.0) < 0.15


def test_robot_drives_forwards_and_backwards_on_the_radial(run_scenario, robot_link):
    run_scenario(SCENARIO, PARAMETERS)
    start, *way = places(robot_link)
    assert start == (pytest.approx(10.0), Direction.ANY)
    for (before_m, _), (after_m, direction) in zip([start, *way], way):
        assert direction is (Direction.FORWARD if after_m < before_m else Direction.BACKWARD)
    assert {direction for _, direction in way} == {Direction.FORWARD, Direction.BACKWARD}
    assert all(3.0 <= place_m <= 9.5 + 1e-6 for place_m, _ in way)


def test_buttons_alternate_with_the_lock_state(run_scenario, robot_link):
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    pressed = {desired.press.id: desired.press.buttons[0] for _, desired in robot_link.answers if desired.press}
    assert pressed[1] == 2 and {pressed[number] for number in range(1, result.attempts + 1)} == {1, 2}


def test_attempts_limit_ends_a_radial_with_the_interval_that_it_has(run_scenario, soften):
    soften(6.0, 2.0)
    results = run_scenario(SCENARIO, replace(PARAMETERS, attempts_limit=8, interval_m=0.1))
    assert [result.attempts for result in results] == 4 * [8]
    assert all(result.d50_high_m - result.d50_low_m > 0.4 for result in results if result.reach == "measured")


def test_car_that_answers_everywhere_is_not_reached_with_a_lower_bound(run_scenario, world):
    world.press_range_m = 99.0
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert (result.status.value, result.reach, result.reason) == ("not_reached", "farther", "")
    assert (result.d50_m, result.d50_high_m, result.d95_m) == (None, None, None)
    assert result.d50_low_m > 8.0 and result.distance_m == pytest.approx(9.5, abs=0.4)
    assert result.distances[0].distance_m is None


def test_key_that_answers_nowhere_is_asked_for_and_the_test_waits(run_scenario, world, robot_link):
    world.press_range_m = 0.0
    with pytest.raises(RobotFailed, match="answered nowhere on 3 radials .* sleeps, whether its battery"):
        run_scenario(SCENARIO, PARAMETERS)
    results = run_scenario.progress.results
    assert [(result.status.value, result.reach, result.distances[0].distance_m) for result in results] == 2 * [
        ("invalid", "no_answer", None)]
    assert "No press worked, and none of 3 at 3.00 m either: the key sleeps" in results[0].reason
    assert robot_link.answers[-1][1].stop


def test_key_that_slept_on_one_radial_is_measured_there_again(run_scenario, world):
    take, world.press_range_m = world.take, 0.0

    def wake_later(desired):
        if world.y < -1.0:
            world.press_range_m = 5.2
        take(desired)
    world.take = wake_later
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.status.value for result in run_scenario.saved[0]] == ["invalid"]
    assert [result.status.value for result in results] == 4 * ["ok"]


def test_hole_is_told_and_pressed_in_again(run_scenario, world):
    take = world.take

    def draw(desired):
        distance_m = math.hypot(*world.key())
        world.press_range_m = 0.0 if 3.85 < distance_m < 4.25 else 6.6
        take(desired)
    world.take = draw
    results = run_scenario(SCENARIO, replace(PARAMETERS, angle_between_radials_rad=math.radians(30.0)))
    assert all(result.d50_low_m <= 6.6 <= result.d50_high_m for result in results)
    pressed = [result for result in results if any(3.85 < place < 4.25 for place in result.failed_at_m)]
    assert all(sum(3.85 < place < 4.25 for place in result.failed_at_m) >= 3 for result in pressed)


def test_key_at_rest_is_moved_before_it_is_pressed(run_scenario, world):
    pressed_at, held, said = [], [], []

    def hold(status):
        """The Operator keeps the robot standing for a minute when it has reached the fourth place."""
        if len(world.presses) == 3 and not pressed_at:
            pressed_at.append(status.waypoint_id)
        if pressed_at and status.waypoint_id != pressed_at[0] and world.result is WaypointResult.REACHED and not held:
            held.append(status.stamp_s)
        return replace(status, hold_id=1) if held and status.stamp_s < held[0] + 60.0 else status
    world.spoil = hold
    observer = RunObserver()
    observer.on_action = said.append
    results = run_scenario(SCENARIO, PARAMETERS, observer=observer)
    assert said.count("move the key so that it does not sleep") == 1
    assert results[0].status.value == "ok"


def test_change_by_the_keys_vicinity_spoils_a_search_too(run_scenario, world):
    world.source_of = lambda source: PASSIVE_ENTRY
    result = run_scenario(SCENARIO, PARAMETERS)[0]
    assert result.status.value == "invalid" and "by the vicinity of a key, not by the press at" in result.reason
    assert (result.d50_m, result.distance_m, result.d50_low_m) == (None, None, None)


def test_earlier_radials_read_with_what_later_ones_say_and_the_same_again(run_scenario, soften):
    soften(6.0, 1.0)
    results = run_scenario(SCENARIO, PARAMETERS)
    assert [result.d50_m for result in run_scenario.saved[0]] != [results[0].d50_m]
    assert SCENARIO.concluded(PARAMETERS, results) == []
    assert run_scenario.progress.retried == []


def test_result_survives_its_file(run_scenario):
    for result in run_scenario(SCENARIO, PARAMETERS):
        assert result_from_document(SCENARIO.result_type, result.to_document()) == result


@pytest.mark.parametrize("change", [
    {"worked_at_m": ["5.0"]}, {"worked_at_m": 5.0}, {"worked_at_m": [math.nan]}, {"failed_at_m": [1e9]},
    {"worked_at_m": [5.0] * 1001}, {"place_sigma_m": -1.0}, {"d50_low_m": 7.0}, {"d50_m": 1e9}, {"method": 5},
    {"method": "guess"}, {"reach": "moon"}])
def test_spoilt_result_is_refused(run_scenario, change):
    document = run_scenario(SCENARIO, PARAMETERS)[0].to_document()
    with pytest.raises((KeyError, TypeError, ValueError)):
        result_from_document(SCENARIO.result_type, {**document, **change})


def test_range_too_short_for_a_search_is_told_with_what_is_needed():
    with pytest.raises(InvalidParameter, match=r"leaves 0\.50 m up to the first press at 3\.5 m; .* needs 1\.04 m"):
        KeyPressParameters.from_mapping({"method": "adaptive", "maximum_distance_m": 4.0})
    KeyPressParameters.from_mapping({"method": "scan", "maximum_distance_m": 4.0})


class Laptop:
    """Runs the test on the world's links, with files; `entries` are those of the journal."""

    def __init__(self, path, robot_link, car_link):
        self.path, self.links, self.entries = path, (robot_link, car_link), []
        self.progress = Progress("key_press", PARAMETERS.to_mapping())

    def run(self, cancel_after=None):
        """cancel_after: presses on the second radial."""
        def is_cancelled():
            ends = [index for index, (kind, _) in enumerate(self.entries) if kind == LINE]
            return bool(cancel_after and ends) and len(self.presses(ends[0])) >= cancel_after
        restart(self.links[0].world)
        with Store(self.path, self.progress) as store:
            add = store.add
            store.add = lambda kind, values: (self.entries.append((kind, values)), add(kind, values))
            loop = ControlLoop(*self.links, is_cancelled=is_cancelled)
            Runner(SCENARIO, PARAMETERS, loop, self.progress, lambda _: store.save(), journal=store).run()

    def reload(self):
        """As after a kill."""
        self.progress = load_progress(self.path.with_suffix(".journal"), SCENARIO, PARAMETERS.to_mapping())

    def presses(self, since=0):
        return [round(values["distance"]["distance_m"], 6) for kind, values in self.entries[since:] if kind == POINT]

    def kinds(self):
        return [kind for kind, _ in self.entries]


@pytest.fixture
def laptop(tmp_path, robot_link, car_link):
    return Laptop(tmp_path / "progress.json", robot_link, car_link)


def test_interrupted_radial_goes_on_with_its_presses_and_the_campaigns_evidence(laptop):
    with pytest.raises(Cancelled):
        laptop.run(cancel_after=4)
    kept = laptop.presses()[laptop.progress.results[0].attempts:]
    assert len(kept) == 4
    laptop.reload()
    laptop.run()
    assert laptop.kinds().count(LINE_RESUMED) == 1 and laptop.kinds().count(SUPERSEDED) == 0
    second = laptop.progress.results[1]
    assert {*kept} <= {*second.worked_at_m, *second.failed_at_m}
    assert sum(result.attempts for result in laptop.progress.results) == len(laptop.presses())
    assert second.attempts < 14


def test_interrupted_radial_is_measured_anew_in_another_car_frame(laptop, world):
    with pytest.raises(Cancelled):
        laptop.run(cancel_after=4)
    laptop.reload()
    world.frame = CarFrame(2, 0.03)
    laptop.run()
    assert laptop.kinds().count(LINE_RESUMED) == 0 and laptop.kinds().count(SUPERSEDED) == 1
    assert [result.status.value for result in laptop.progress.results] == 4 * ["ok"]


def test_silent_key_is_tried_anew_when_the_test_is_continued(laptop, world):
    world.press_range_m = 0.0
    with pytest.raises(RobotFailed):
        laptop.run()
    laptop.reload()
    world.press_range_m = 5.2
    laptop.run()
    assert [result.status.value for result in laptop.progress.results] == 4 * ["ok"]


def test_radial_is_measured_further_with_all_its_presses(run_scenario, soften, world, robot_link, car_link):
    soften(6.0, 1.0)
    parameters = replace(PARAMETERS, attempts_limit=10)
    first, *_ = run_scenario(SCENARIO, parameters)
    restart(world)
    loop = ControlLoop(robot_link, car_link)
    robot, line = Robot(loop, run_scenario.progress.results), SCENARIO.lines(parameters, CAR)[0]
    robot.set_maximum_speed(1.0)
    further = SCENARIO.measure_further(line, parameters, robot, Car(loop), first)
    assert further.attempts == first.attempts + 8 == len(further.worked_at_m) + len(further.failed_at_m)
    assert further.worked_at_m[:len(first.worked_at_m)] == first.worked_at_m
    assert further.distance_m == max(further.worked_at_m)
    assert further.d50_high_m - further.d50_low_m < first.d50_high_m - first.d50_low_m


def test_radial_is_not_measured_further_for_ever(run_scenario):
    first, *_ = run_scenario(SCENARIO, PARAMETERS)
    line, *_ = SCENARIO.lines(PARAMETERS, CAR)
    spent = replace(first, worked_at_m=first.worked_at_m * 20)
    assert SCENARIO.measure_further(line, PARAMETERS, None, None, spent) is None
    assert SCENARIO.judged_shares(PARAMETERS) == (5, 50, 95)
    scan = replace(PARAMETERS, method="scan")
    assert SCENARIO.judged_shares(scan) == ()
    assert SCENARIO.measure_further(line, scan, None, None, replace(first, method="scan")) is None
