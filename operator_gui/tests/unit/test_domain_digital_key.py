"""The Digital key scenario on a kinematic robot and a phone that ranges to the Car's outline with a bias."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.distance import distance_to_outline, gap_to_outline
from mtr_operator.domain.distance_feed import DistanceFeed, Reported
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter, LinkLost
from mtr_operator.domain.exchange.run_context import Assistance
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.digital_key import SCENARIO
from mtr_operator.domain.scenarios.digital_key.parameters import DigitalKeyParameters
from mtr_operator.domain.scenarios.digital_key.places import places_around
from mtr_operator.domain.scenarios.digital_key.result import DigitalKeyResult

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = DigitalKeyParameters(minimum_distance_m=1.0, maximum_distance_m=3.0, angle_between_radials_rad=math.pi / 2,
                                  reading_time_s=1.0, stand_time_s=0.2, self_check=False)


class FakeFeed(DistanceFeed):
    """Tells what `figure` makes of the phone's place at each Status; None for nothing."""

    name = "fake"

    def __init__(self, figure):
        self.figure, self.trouble, self.count = figure, lambda time_s: "", 0

    def connect(self):
        pass

    def observe(self, status):
        self.count += 1
        figure_m = self.figure(status, self.count)
        return [] if figure_m is None else [Reported(status.stamp_s, figure_m, status.stamp_s)]

    @property
    def problem(self):
        return self.trouble(self.count)

    def close(self):
        pass


def biased(status, count):
    return gap_to_outline(status.key_place, CAR) + 0.3 + 0.01 * (count % 2)


@pytest.fixture
def measured(robot_link, car_link):
    """Progress of a whole test with a feed."""
    def run(feed, parameters=PARAMETERS):
        progress = Progress(SCENARIO.name, parameters.to_mapping())
        loop = ControlLoop(robot_link, car_link, assistance=Assistance(phone=feed))
        Runner(SCENARIO, parameters, loop, progress, lambda _: None).run()
        return progress
    return run


def test_places_go_in_and_out_on_the_radials_and_keep_the_clearance():
    places = places_around(DigitalKeyParameters(minimum_distance_m=0.3, spacing_m=1.0), CAR)
    assert [place.number for place in places] == list(range(1, len(places) + 1))
    assert places[0].distance_m > places[1].distance_m
    assert min(distance_to_outline(place.ray, place.distance_m, CAR) for place in places) >= 0.3
    steps_m = [math.dist(a.ray.point(a.distance_m), b.ray.point(b.distance_m)) for a, b in zip(places, places[1:])]
    assert max(steps_m) < 5.0


def test_the_error_is_the_bias_at_each_place_and_its_interval_holds_it(measured):
    results = measured(FakeFeed(biased)).results
    assert len(results) == 12
    assert all(each.status is LineStatus.OK and each.samples >= 9 for each in results)
    for each in results:
        assert each.error_m == pytest.approx(0.305, abs=0.02)
        assert each.error_low_m < 0.3 < each.error_high_m
        assert each.reference_m == pytest.approx(gap_to_outline((each.x_m, each.y_m), CAR), abs=1e-6)
        assert each.uncertainty_m >= 0.03


def test_the_car_may_unlock_as_the_phone_comes_near(measured, world):
    world.unlock_m = 2.0
    results = measured(FakeFeed(biased)).results
    assert all(each.status is LineStatus.OK for each in results)


def test_an_anchor_is_compared_with_along_the_straight_way(measured):
    parameters = DigitalKeyParameters.from_mapping({
        **PARAMETERS.to_mapping(), "reference": "anchor", "anchor_x_m": 1.0, "anchor_y_m": -0.5,
        "anchor_height_m": 1.6})

    def slant(status, count):
        x, y = status.key_place
        return math.hypot(x - 1.0, y + 0.5, status.key_height_m - 1.6) + 0.001 * (count % 3)

    for each in measured(FakeFeed(slant), parameters).results:
        assert each.error_m == pytest.approx(0.001, abs=0.0015)
        assert each.reference_m == pytest.approx(math.hypot(each.x_m - 1.0, each.y_m + 0.5, 0.6), abs=1e-4)


def test_a_place_without_an_answer_is_invalid_and_measured_again(measured):
    def deaf_in_front(status, count):
        return None if status.key_place[0] > 3.0 else biased(status, count)

    progress = measured(FakeFeed(deaf_in_front))
    silent = [each for each in progress.results if each.is_unanswered]
    assert silent
    assert all(each.status is LineStatus.INVALID and each.answer == "none" and "0 times" in each.reason
               and each.error_m is None and each.x_m > 3.0 for each in silent)
    assert progress.retried
    assert dict(SCENARIO.summary(progress.results))["places without answer"].startswith(f"{len(silent)} / 12")


def test_a_frozen_feed_leaves_no_valid_place(measured):
    results = measured(FakeFeed(lambda status, count: 2.0)).results
    assert {(each.status, each.answer) for each in results} == {(LineStatus.INVALID, "constant")}


def test_without_a_feed_the_robot_does_not_move(measured, robot_link):
    with pytest.raises(ConnectionFailed, match="phone_distance"):
        measured(None)
    assert all(desired.waypoint is None for _, desired in robot_link.answers)


def test_a_feed_that_is_gone_for_good_ends_the_test(measured):
    feed = FakeFeed(biased)
    feed.trouble = lambda count: "The feed has closed the connection." if count > 40 else ""
    with pytest.raises(LinkLost, match="closed the connection"):
        measured(feed)


def test_a_feed_that_is_gone_for_a_moment_costs_a_place_at_most(measured):
    feed = FakeFeed(biased)
    feed.trouble = lambda count: "The feed has closed the connection." if 40 < count < 60 else ""
    assert all(each.status is LineStatus.OK for each in measured(feed).results)


def test_a_robot_that_is_pushed_makes_the_place_invalid(measured, world):
    pushed = []

    def push(status):
        if status.waypoint_id == 3 and not pushed and status.stamp_s - first.setdefault("s", status.stamp_s) > 0.8:
            pushed.append(status)
            return replace(status, speed_mps=0.4)
        return status

    first = {}
    world.spoil = push
    assert measured(FakeFeed(biased)).retried


def test_a_result_is_read_back_from_its_document(measured):
    def partly(status, count):
        return None if status.key_place[1] > 2.0 else biased(status, count)

    for each in measured(FakeFeed(partly)).results:
        assert result_from_document(DigitalKeyResult, each.to_document()) == each


def test_a_result_whose_error_is_not_that_of_its_distances_is_refused(measured):
    document = measured(FakeFeed(biased)).results[0].to_document()
    with pytest.raises(ValueError):
        result_from_document(DigitalKeyResult, {**document, "error_m": document["error_m"] + 0.1})


def test_the_picture_tells_errors_and_places_without_an_answer(measured):
    def partly(status, count):
        return None if status.key_place[1] > 2.0 else biased(status, count)

    results = measured(FakeFeed(partly)).results
    error, silent, invalid = SCENARIO.picture(PARAMETERS, CAR, results).point_sets
    assert len(error.points) == len(error.errors_m) > 0
    assert len(silent.points) == sum(each.is_unanswered for each in results) > 0
    assert len(error.points) + len(silent.points) == len(results)
    assert not invalid.points


@pytest.mark.parametrize("values", [{"minimum_distance_m": 6.0}, {"minimum_distance_m": 0.2}, {"reading_time_s": 0.5},
                                    {"reference": "mirror"}])
def test_parameters_that_contradict_are_refused(values):
    with pytest.raises(InvalidParameter):
        DigitalKeyParameters(**values)
