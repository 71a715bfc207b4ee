"""What is said of a Car whose size no data sheet has told, and distances from its outline."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_operator.domain.actions.car_size import size_cautions, size_excess
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.geometry.polygon import distance_to_polygon
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.estimate import USUAL_CAR, plan_of

# As the Car locator says it of an inset of up to 60 mm on each side.
UNSURE_M = 2.0 * 0.06 / math.sqrt(3.0)
PLANE = CarDimensions(4.5, 1.8, UNSURE_M, UNSURE_M)
SHEET = CarDimensions(4.5, 1.8, 0.005, 0.005)
WIDTH_ONLY = CarDimensions(4.5, 1.8, UNSURE_M, 0.005)
TO_THE_LEFT, AHEAD = Ray(0.0, 0.9, 0.0, 1.0), Ray(2.25, 0.0, 1.0, 0.0)
FROM_THE_CENTRE = Ray(0.0, 0.0, 0.0, 1.0)
SQUARE = ((1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0))


@pytest.mark.parametrize(("car", "excess_m"), [(PLANE, 0.06), (WIDTH_ONLY, 0.06), (SHEET, 0.0), (USUAL_CAR, 0.0)])
def test_distance_may_be_too_long_by_what_may_stand_out_above_the_plane(car, excess_m):
    assert size_excess(car) == pytest.approx(excess_m)


@pytest.mark.parametrize(("rays", "car", "is_told"), [
    ((TO_THE_LEFT,), PLANE, True), ((AHEAD,), WIDTH_ONLY, True), ((TO_THE_LEFT,), WIDTH_ONLY, False),
    ((TO_THE_LEFT, AHEAD), SHEET, False), ((FROM_THE_CENTRE,), PLANE, False), ((TO_THE_LEFT,), USUAL_CAR, False)])
def test_only_lines_that_begin_on_an_outline_nobody_told_are_cautioned_of(rays, car, is_told):
    cautions = size_cautions(rays, car)
    assert bool(cautions) is is_told
    assert all("up to 6 cm too long" in sentence and "car_file" in sentence for sentence in cautions)


def test_planner_asks_for_the_data_sheet():
    scenario = SCENARIOS["autolock"]
    parameters = scenario.parameters_type()
    with_plane, with_sheet = (plan_of(scenario, parameters, car, True).cautions for car in (PLANE, SHEET))
    added = [sentence for sentence in with_plane if sentence not in with_sheet]
    # At the corners both sizes count.
    assert [sentence[-1] for sentence in added] == ["."] and "up to 8 cm too long" in added[0]


@pytest.mark.parametrize(("point", "distance_m"), [
    ((0.2, -0.3), 0.0), ((1.0, 0.0), 0.0), ((1.5, 0.4), 0.5), ((0.0, -3.0), 2.0), ((-4.0, -5.0), 5.0)])
def test_distance_to_polygon(point, distance_m):
    assert distance_to_polygon(point, SQUARE) == pytest.approx(distance_m)


class Said(RunObserver):
    """Warnings of a test."""

    def __init__(self):
        self.warnings = []

    def on_action(self, text):
        self.warnings += [text] if "data sheet" in text else []


@pytest.mark.parametrize(("car", "count"), [(PLANE, 1), (SHEET, 0)])
def test_test_says_it_when_the_car_is_mapped(run_scenario, world, car, count):
    world.car, said, begun = car, Said(), []
    scenario = SCENARIOS["autolock"]
    # Ended at its first line: what is said before that is what matters.
    said.on_plan = lambda done, total: begun.append(total)
    with pytest.raises(Cancelled):
        run_scenario(scenario, scenario.parameters_type(), observer=said, is_cancelled=lambda: bool(begun))
    assert len(said.warnings) == count
    assert all(text.startswith("warning: Without length and width") for text in said.warnings)
