"""Zone map: what the robot does in a zone, where it presses and when it ends, and what is recorded of it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.errors import RobotFailed
from mtr_operator.domain.estimation.field.zone_search import ZoneSearch
from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import CarDimensions, WaypointResult
from mtr_operator.domain.scenarios.zone_map import SCENARIO
from mtr_operator.domain.scenarios.zone_map.field import search_in
from mtr_operator.domain.scenarios.zone_map.parameters import ZoneMapParameters
from mtr_operator.domain.scenarios.zone_map.zones import areas_m2, from_outline, rows, zones_around

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
# The interval of a zone's coverage is never this narrow: each zone has all its presses.
PARAMETERS = ZoneMapParameters(presses_limit=6, coverage_percent=1.0, angle_between_radials_rad=math.radians(45.0),
                               self_check=False)


class Actions(RunObserver):
    """What the Operator was told."""

    def __init__(self):
        self.said = []

    def on_action(self, text):
        self.said.append(text)


@pytest.fixture(name="actions")
def actions_fixture():
    """Of a test not yet begun."""
    return Actions()


def places_of(robot_link, zone):
    """Where the key was sent to in a zone, as indices of its places, in order; each time is one."""
    waypoints = {desired.waypoint.id: desired.waypoint for _, desired in robot_link.answers if desired.waypoint}
    keys = [(waypoint.pose.x + 0.25 * math.cos(waypoint.pose.heading),
             waypoint.pose.y + 0.25 * math.sin(waypoint.pose.heading)) for waypoint in waypoints.values()]
    places = [place.ray.point(place.distance_m) for place in zone.places]
    return [index for key in keys for index, place in enumerate(places) if math.dist(key, place) < 1e-6]


def restart(world):
    """The next run is a session of its own, whose presses count from 1 again."""
    world.pressed, world.presses = set(), []


# The course of a zone


def test_operator_is_told_the_zone_and_the_place_of_each_press(run_scenario, actions, robot_link):
    results = run_scenario(SCENARIO, PARAMETERS, observer=actions)
    zone = zones_around(PARAMETERS, CAR)[1]
    begun = actions.said.index("zone 2 (front right)")
    told = actions.said[begun + 1:begun + 1 + results[1].presses]
    assert told == [f"press at {zone.places[index].distance_m:.2f} m" for index in places_of(robot_link, zone)]


def test_key_stands_for_its_time_before_each_press_is_ordered(run_scenario, world):
    reached_s, take = [], world.take

    def note(desired):
        if desired.press is not None and desired.press.id not in world.pressed:
            reached_s.append(world.time_s - arrived_s[-1])
        take(desired)
    arrived_s = [0.0]
    world.spoil = lambda status: (arrived_s.append(status.stamp_s) if status.speed_mps > 0.0 else None, status)[1]
    world.take = note
    run_scenario(SCENARIO, replace(PARAMETERS, settle_time_s=2.0))
    assert len(reached_s) == 8 * 6 and min(reached_s) >= 2.0 - 1e-6


def test_zone_ends_when_its_coverage_is_known_as_well_as_wanted(run_scenario, world):
    assert {result.presses for result in run_scenario(SCENARIO, PARAMETERS)} == {6}
    restart(world)
    ended = run_scenario(SCENARIO, replace(PARAMETERS, presses_limit=30, coverage_percent=25.0))
    assert all(6 <= result.presses < 30 for result in ended)
    assert all((result.coverage_high - result.coverage_low) / 2.0 <= 0.25 for result in ended)


def test_search_is_asked_for_the_interval_in_percent_and_for_the_presses_allowed(run_scenario, monkeypatch):
    asked, is_finished = set(), ZoneSearch.is_finished

    def note(search, interval, presses):
        asked.add((interval, presses))
        return is_finished(search, interval, presses)
    monkeypatch.setattr(ZoneSearch, "is_finished", note)
    run_scenario(SCENARIO, replace(PARAMETERS, coverage_percent=25.0))
    assert asked == {(0.25, 6)}


@pytest.mark.parametrize(("refusals", "retried"), [(2, []), (3, [1])])
def test_place_that_is_refused_is_left_out_and_the_third_one_ends_the_zone(run_scenario, world, robot_link, refusals,
                                                                         retried):
    refused = []

    def refuse(waypoint):
        if len(refused) >= refusals:
            return ""
        refused.append(waypoint.id)
        return "A wall is in the way."
    world.refuses = refuse
    run_scenario(SCENARIO, PARAMETERS)
    first, zone = run_scenario.saved[0][0], zones_around(PARAMETERS, CAR)[0]
    assert first.status is (LineStatus.INVALID if retried else LineStatus.OK)
    assert run_scenario.progress.retried == retried
    sent = places_of(robot_link, zone)
    assert not set(sent[:refusals]) & set(sent[refusals:first.presses + refusals])
    assert len(set(sent[:refusals])) == refusals
    assert ("A wall is in the way." in first.reason) is bool(retried)


def test_position_that_comes_back_while_the_car_may_react_does_not_spoil_the_zone(run_scenario, world):
    lost_s = []

    def lose(status):
        if world.result is WaypointResult.REACHED and len(world.presses) == 1 and not lost_s:
            lost_s.append(status.stamp_s)
        return replace(status, pose_valid=not lost_s or status.stamp_s > lost_s[0] + 0.5)
    world.spoil = lose
    run_scenario(SCENARIO, PARAMETERS)
    assert lost_s and run_scenario.saved[0][0].status is LineStatus.OK


def test_zone_that_cannot_be_finished_keeps_its_presses_and_tells_no_distance(run_scenario, world):
    world.refuses = lambda waypoint: "A wall is in the way." if len(world.presses) >= 3 else ""
    run_scenario(SCENARIO, PARAMETERS)
    first = run_scenario.saved[0][0]
    assert (first.status, first.presses) == (LineStatus.INVALID, 3)
    assert len(first.worked) + len(first.failed) == 3
    assert (first.distance_m, first.uncertainty_m, first.coverage, first.coverage_low, first.coverage_high) == (
        None, None, None, None, None)


def test_presses_of_a_zone_are_kept_with_their_numbers(run_scenario, world, monkeypatch):
    from mtr_operator.domain.actions.robot import Robot

    words, keep = [], Robot.keep
    monkeypatch.setattr(Robot, "keep", lambda self, word, *rest: (words.append(word), keep(self, word, *rest))[1])
    run_scenario(SCENARIO, PARAMETERS)
    assert words == 8 * [f"reach {number}" for number in range(1, 7)]


# What a press costs


def test_press_is_expected_to_take_its_way_and_the_cars_time(run_scenario, world, monkeypatch):
    asked, next_place = [], ZoneSearch.next_place

    def note(search, seconds):
        key_x, key_y = world.key()
        ways_m = np.hypot(search.places[:, 0] - key_x, search.places[:, 1] - key_y)
        asked.append((ways_m, seconds(search.places)))
        return next_place(search, seconds)
    monkeypatch.setattr(ZoneSearch, "next_place", note)
    parameters = replace(PARAMETERS, maximum_speed_mps=0.5, settle_time_s=0.4, press_duration_s=0.2,
                         response_timeout_s=0.7)
    run_scenario(SCENARIO, parameters)
    assert len(asked) == 8 * 6
    for ways_m, seconds in asked:
        # 3 s to turn, to speed up and to slow down, and nothing of it for a press where the key is.
        assert seconds == pytest.approx(ways_m / 0.5 + 3.0 * (ways_m > 0.0) + 1.3)


def test_a_zone_takes_the_time_of_its_presses_on_ways_of_a_quarter_of_the_maps_depth():
    parameters = replace(PARAMETERS, minimum_distance_m=0.5, maximum_distance_m=4.5, maximum_speed_mps=0.5,
                         settle_time_s=0.4, press_duration_s=0.2, response_timeout_s=1.0, presses_limit=10)
    assert SCENARIO.expected_line_s(parameters) == pytest.approx(10 * (1.0 / 0.5 + 3.0 + 0.4 + 0.2 + 0.5))


def test_limits_may_ask_for_the_distance_at_which_half_of_the_presses_work():
    assert SCENARIO.judged_shares(PARAMETERS) == (50,)


# What is recorded


def test_uncertainty_is_that_of_the_worst_place(run_scenario, spoil, world):
    assert {result.uncertainty_m for result in run_scenario(SCENARIO, PARAMETERS)} == {0.03}
    restart(world)
    spoil(lambda status: len(world.presses) == 2, position_sigma_m=0.07)
    assert [result.uncertainty_m for result in run_scenario(SCENARIO, PARAMETERS)] == [0.07, *7 * [0.03]]


def test_places_are_recorded_to_tenths_of_a_millimetre_where_the_key_was(run_scenario, robot_link):
    result = run_scenario(SCENARIO, PARAMETERS)[1]
    zone = zones_around(PARAMETERS, CAR)[1]
    sent = [zone.places[index].ray.point(zone.places[index].distance_m) for index in places_of(robot_link, zone)]
    expected = sorted((round(x, 4), round(y, 4)) for x, y in sent)
    assert sorted([*result.worked, *result.failed]) == expected


def test_coverage_is_recorded_to_a_millionth(run_scenario, monkeypatch):
    found, coverage = [], ZoneSearch.coverage
    monkeypatch.setattr(ZoneSearch, "coverage", lambda search: (found.append(coverage(search)), found[-1])[1])
    result = run_scenario(SCENARIO, PARAMETERS)[-1]
    assert (result.coverage, result.coverage_low, result.coverage_high) == tuple(
        round(part, 6) for part in (found[-1].value_m, found[-1].low_m, found[-1].high_m))


def test_key_that_answers_nowhere_is_asked_for_and_no_zone_is_on_record_as_not_covered(run_scenario, world):
    world.press_range_m = 0.0
    with pytest.raises(RobotFailed, match="answered nowhere in 3 zones one after the other; see whether it sleeps"):
        run_scenario(SCENARIO, PARAMETERS)
    first, second = run_scenario.progress.results
    for result in (first, second):
        assert (result.status, result.distance_m, result.high_m, result.coverage) == (
            LineStatus.INVALID, None, None, None)
        assert result.reason.startswith("No press worked in this zone, not at its nearest places either: ")
    # The front's only radial begins 2.25 m from the Car's centre.
    at_nearest = [place for place in first.failed if math.hypot(*place) < 2.25 + PARAMETERS.distances_m[0] + 0.05]
    assert len(at_nearest) >= 3 and first.presses == len(first.failed) <= PARAMETERS.presses_limit + 3


def test_zone_in_which_the_key_slept_says_nothing_of_the_others_and_is_measured_again(run_scenario, world):
    class Sleeper(RunObserver):
        """Its key answers from the second zone on."""

        def on_action(self, text):
            if text.startswith("zone "):
                world.press_range_m = 0.0 if not begun else 5.2
                begun.append(text)
    begun = []
    results = run_scenario(SCENARIO, PARAMETERS, observer=Sleeper())
    assert run_scenario.progress.retried == [1]
    assert all(result.worked and result.status is not LineStatus.INVALID for result in results)
    silent, second = run_scenario.saved[0][0], run_scenario.saved[1][1]
    assert silent.is_silent and not second.is_silent
    alone = search_in(zones_around(PARAMETERS, CAR)[1], PARAMETERS, CAR, [])
    beside = search_in(zones_around(PARAMETERS, CAR)[1], PARAMETERS, CAR, [silent])
    assert beside.field.presses == alone.field.presses == 0


def test_key_that_wakes_up_in_the_last_moment_leaves_no_doubt(run_scenario, world):
    world.press_range_m = 0.0
    take = world.take

    def wake(desired):
        world.press_range_m = 5.2 if len(world.presses) >= PARAMETERS.presses_limit else 0.0
        take(desired)
    world.take = wake
    first = run_scenario(SCENARIO, PARAMETERS)[0]
    assert first.status is not LineStatus.INVALID and len(first.worked) == 1


def test_car_that_obeys_everywhere_has_no_end(run_scenario, world):
    world.press_range_m = 99.0
    everywhere = run_scenario(SCENARIO, PARAMETERS)[-1]
    assert (everywhere.status, everywhere.distance_m, everywhere.high_m) == (LineStatus.NOT_REACHED, None, None)
    assert everywhere.coverage > 0.9 and everywhere.failed == ()


# Zones


def test_zones_go_clockwise_from_the_front_and_their_middles_begin_at_the_cars_outline():
    zones = zones_around(PARAMETERS, CAR)
    assert [zone.side for zone in zones] == ["front", "front_right", "right", "rear_right", "rear", "rear_left", "left",
                                             "front_left"]
    assert [(zones[index].ray.origin_x, zones[index].ray.origin_y) for index in (0, 1, 2, 4, 6)] == [
        pytest.approx(place, abs=1e-9) for place in ((2.25, 0.0), (0.9, -0.9), (0.0, -0.9), (-2.25, 0.0), (0.0, 0.9))]


def test_radial_leaves_the_car_where_it_first_meets_a_side():
    ahead, oblique = (from_outline(radial.ray, CAR).point(1.0) for radial in radials_around(math.radians(10.0))[:2])
    assert ahead == pytest.approx((3.25, 0.0), abs=1e-9)
    ten = math.radians(10.0)
    assert oblique == pytest.approx((2.25 + math.cos(ten), -2.25 * math.tan(ten) - math.sin(ten)))


def test_nearest_place_may_leave_exactly_the_clearance():
    front = zones_around(replace(PARAMETERS, clearance_m=0.5), CAR)[0]
    assert [place.distance_m for place in front.places] == PARAMETERS.distances_m


def test_place_stands_for_a_piece_of_the_ring_around_the_cars_centre():
    front = zones_around(PARAMETERS, CAR)[0]
    areas = areas_m2(front, PARAMETERS)
    radii_m = [2.25 + distance_m for distance_m in PARAMETERS.distances_m]
    assert areas == pytest.approx([radius_m * math.pi / 4.0 * 0.5 for radius_m in radii_m])
    places = rows(front, CAR)
    assert places[:, 0] == pytest.approx(radii_m) and set(places[:, 2]) == {1.0}
    assert places[:, 3] == pytest.approx(PARAMETERS.distances_m)


def test_robot_may_drive_any_way_between_two_places(run_scenario, robot_link):
    run_scenario(SCENARIO, PARAMETERS)
    assert {desired.waypoint.direction for _, desired in robot_link.answers if desired.waypoint} == {Direction.ANY}
