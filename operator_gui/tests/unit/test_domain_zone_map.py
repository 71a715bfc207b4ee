"""The Zone map scenario on a kinematic robot and a Car that obeys within 5.2 m of its centre."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.distance import distance_to_outline
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.results.figure import Figure, Kind, figure_of
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.zone_map import SCENARIO
from mtr_operator.domain.scenarios.zone_map.parameters import ZoneMapParameters
from mtr_operator.domain.scenarios.zone_map.result import ZoneMapResult
from mtr_operator.domain.scenarios.zone_map.zones import zones_around

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = ZoneMapParameters(maximum_distance_m=6.0, presses_limit=10, self_check=False)


@pytest.fixture
def measured(robot_link, car_link):
    """Progress of a whole test."""
    def run(parameters=PARAMETERS):
        progress = Progress(SCENARIO.name, parameters.to_mapping())
        Runner(SCENARIO, parameters, ControlLoop(robot_link, car_link), progress, lambda _: None).run()
        return progress
    return run


def test_no_place_is_nearer_to_the_car_than_the_clearance():
    parameters = ZoneMapParameters(minimum_distance_m=0.3, clearance_m=0.3, heights=3)
    zones = zones_around(parameters, CAR)
    assert [zone.number for zone in zones] == list(range(1, 25))
    assert sorted({round(zone.height_m, 6) for zone in zones}) == [1.0, 1.2, 1.4]
    gaps = [distance_to_outline(place.ray, place.distance_m, CAR) for zone in zones for place in zone.places]
    assert min(gaps) >= 0.3
    assert len({zone.side for zone in zones}) == 8


def test_map_of_a_robot_that_does_not_say_how_well_it_knows_its_place_has_no_interval(measured, spoil):
    spoil(lambda status: status.id % 7 == 0, position_sigma_m=math.nan)
    for result in measured().results:
        assert result.distance_m is not None and result.uncertainty_m is result.low_m is result.high_m is None


def test_the_map_finds_where_the_car_obeys(measured, world):
    results = measured().results
    assert [result.number for result in results] == list(range(1, 9))
    assert all(result.status is LineStatus.OK and result.presses <= 10 for result in results)
    middles = {zone.number: zone.ray for zone in zones_around(PARAMETERS, CAR)}
    for result in results:
        truth_m = world.press_range_m - math.hypot(middles[result.number].origin_x, middles[result.number].origin_y)
        low_m, high_m = (end if end is not None else beyond for end, beyond in
                         ((result.low_m, 0.0), (result.high_m, 99.0)))
        assert low_m <= truth_m <= high_m
        assert result.coverage_low <= result.coverage <= result.coverage_high
    for result in results:
        assert all(math.hypot(*place) <= world.press_range_m + 0.01 for place in result.worked)
        assert all(math.hypot(*place) >= world.press_range_m - 0.01 for place in result.failed)


def test_heights_are_taken_one_after_the_other(measured, world):
    results = measured(ZoneMapParameters(heights=2, presses_limit=6, self_check=False)).results
    assert [result.height_m for result in results] == 8 * [1.0] + 8 * [1.4]
    assert world.height_m == 1.4


def test_a_zone_whose_presses_are_disturbed_is_invalid_and_measured_again(measured, world):
    refused = []

    def refuse_three(waypoint):
        refused.append(waypoint)
        return "Blocked." if len(refused) <= 3 else ""

    world.refuses = refuse_three
    progress = measured()
    assert progress.retried
    assert all(result.status is not LineStatus.INVALID for result in progress.results)


def test_a_result_is_read_back_from_its_document(measured):
    for result in measured().results:
        assert result_from_document(ZoneMapResult, result.to_document()) == result


def test_the_picture_has_nested_outlines_and_all_presses(measured):
    results = measured().results
    picture = SCENARIO.picture(PARAMETERS, CAR, results)
    sets = {points.label: points for points in picture.point_sets}
    sure, half, perhaps = (sets[name].points for name in ("Covered for sure", "Half of the presses work",
                                                          "Covered perhaps"))
    assert all(math.hypot(*near) <= math.hypot(*middle) + 1e-9 <= math.hypot(*far) + 2e-9
               for near, middle, far in zip(sure, half, perhaps))
    assert len(sets["Press worked"].points) + len(sets["Press failed"].points) == sum(r.presses for r in results)
    assert all(None not in points for points in (sure, half, perhaps))


def test_zone_that_works_everywhere_from_unknown_places_is_not_said_to_end_near_the_car():
    everywhere = ZoneMapResult(1, "front", 1.0, LineStatus.NOT_REACHED, 10, worked_x_m=(6.0,), worked_y_m=(0.0,))
    assert figure_of(everywhere.distances[0], SCENARIO.unreached(PARAMETERS, everywhere, "reach")) == Figure(
        Kind.NOT_REACHED)


@pytest.mark.parametrize("values", [{"minimum_distance_m": 6.0}, {"minimum_distance_m": 0.2},
                                    {"heights": 2, "highest_key_height_m": 0.9}])
def test_parameters_that_contradict_are_refused(values):
    with pytest.raises(InvalidParameter):
        ZoneMapParameters(**values)
