"""Each side of the Car has its own uncertainty: what it does to budgets, cautions and the start of a test."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car_size import missing_measures, nearness_of, size_cautions, size_excess
from mtr_operator.domain.errors import RobotFailed
from mtr_operator.domain.geometry.axes import axes_around
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.journal import plain_fields
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress, car_document, car_from
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.domain.verdict.assessment import Assessor
from mtr_operator.station.checks.finding import Check, Finding, State
from mtr_operator.station.checks.robot_checks import size
from mtr_operator.station.estimate import plan_of
from mtr_operator.storage.given_files import load_calibration


def car(front, rear, side=0.003, length_sigma=None, width_sigma=0.005):
    """A Car whose ends are known to these sigmas in m; without the length they are independent."""
    length_sigma = math.hypot(front, rear) if length_sigma is None else length_sigma
    return CarDimensions(4.5, 1.8, length_sigma, width_sigma, (), front, rear, side, side)


# As the Car locator publishes them: data sheet with axles; length alone; no data sheet; wheels alone.
EXACT, LENGTH_ALONE = car(0.006, 0.007, length_sigma=0.005), car(0.034, 0.034, length_sigma=0.005)
NO_SHEET, WHEELS = car(0.11, 0.075, 0.035, width_sigma=0.07), car(0.17, 0.25, 0.041, width_sigma=0.082)
NO_LENGTH = car(0.006, 0.22)
FRONT, REAR, LEFT = Ray(2.25, 0.0, 1.0, 0.0), Ray(-2.25, 0.0, -1.0, 0.0), Ray(0.0, 0.9, 0.0, 1.0)
FROM_CENTRE = Ray(0.0, 0.0, 1.0, 0.0)
AXLES = ("front_overhang_m", "wheelbase_m")


@pytest.mark.parametrize(("known", "keys"), [
    (EXACT, ()), (LENGTH_ALONE, AXLES), (NO_SHEET, ("known_length_m", *AXLES, "known_width_m")),
    (WHEELS, ("known_length_m", *AXLES, "known_width_m")), (NO_LENGTH, ("known_length_m",)),
    (car(0.009, 0.0106, length_sigma=0.005), AXLES)])
def test_measures_that_help_are_those_that_are_missing(known, keys):
    assert missing_measures(known) == keys
    assert bool(size_excess(known)) is bool(keys)


@pytest.mark.parametrize(("rays", "known", "words"), [
    ((FRONT,), EXACT, None), ((FROM_CENTRE,), WHEELS, None), ((LEFT,), NO_LENGTH, None), ((FRONT,), NO_LENGTH, None),
    ((REAR,), NO_LENGTH, "rear 43 cm"), ((FRONT, REAR), LENGTH_ALONE, "front 7 cm, rear 7 cm"),
    ((FRONT, LEFT), NO_SHEET, "front 22 cm, left 7 cm")])
def test_cautions_name_the_sides_where_lines_begin(rays, known, words):
    cautions = size_cautions(rays, known)
    assert len(cautions) == (words is not None)
    assert all(words in caution and "car_file" in caution for caution in cautions)


@pytest.mark.parametrize(("rays", "nearest_m", "known", "side"), [
    ((FRONT,), 0.5, EXACT, None), ((FRONT,), 0.12, EXACT, None), ((FRONT, REAR), 0.5, NO_SHEET, None),
    ((FRONT, REAR), 0.4, NO_SHEET, "front"), ((REAR,), 0.3, NO_SHEET, "rear"), ((REAR,), 0.34, NO_SHEET, None),
    ((FRONT, REAR), 0.5, WHEELS, "rear"), ((FRONT, REAR), 0.9, WHEELS, None), ((LEFT,), 0.5, WHEELS, None),
    ((LEFT,), 0.2, WHEELS, "left"), ((FRONT,), 0.5, NO_LENGTH, None), ((REAR,), 0.5, NO_LENGTH, "rear"),
    ((FRONT,), 0.3, CarDimensions(4.5, 1.8, 0.36, 0.09), None), ((FROM_CENTRE,), 2.4, WHEELS, None)])
def test_key_is_not_carried_where_the_car_may_be(rays, nearest_m, known, side):
    nearness = nearness_of(rays, nearest_m, known)
    assert (nearness.sides[0] if nearness else None) == side
    if nearness:
        assert nearest_m < nearness.least_m
        assert nearness.keys and all(key in nearness.sentence for key in nearness.keys)


@pytest.mark.parametrize(("known", "state", "finding"), [
    (EXACT, State.GOOD, Finding.SIZE_KNOWN), (NO_SHEET, State.NOTE, Finding.SIZE_VAGUE),
    (LENGTH_ALONE, State.NOTE, Finding.SIZE_VAGUE), (WHEELS, State.BAD, Finding.SIZE_TOO_VAGUE)])
def test_checklist_asks_for_the_measures_before_the_robot_moves(known, state, finding):
    scenario = SCENARIOS["autolock"]
    item = size(known, plan_of(scenario, scenario.parameters_type(), known, True))
    assert (item.check, item.state, item.finding) == (Check.SIZE, state, finding)
    sides = ("front", "rear") if known is WHEELS else ("front", "rear", "left", "right")
    assert item.said == ", ".join(missing_measures(known, sides))


def test_test_does_not_begin_at_a_car_whose_rear_may_be_where_the_key_goes(run_scenario, world):
    world.car = WHEELS
    scenario = SCENARIOS["autolock"]
    with pytest.raises(RobotFailed, match=r"The test does not begin\. The Car's rear is known to 49 cm only"):
        run_scenario(scenario, scenario.parameters_type())


def test_axes_of_the_usual_car_are_measured_without_a_data_sheet():
    lines = [axis.ray for axis in axes_around(NO_SHEET, 0.5)]
    assert nearness_of(lines, SCENARIOS["autolock"].parameters_type().minimum_distance_m, NO_SHEET) is None


def test_budget_counts_the_side_once_and_as_common_to_its_lines():
    """The recorded uncertainty of 0.111 m holds the front of 0.11 m; what is left is this line's own."""
    scenario = SCENARIOS["autolock"]
    parameters = scenario.parameters_type()
    number = next(axis.number for axis in axes_around(NO_SHEET, parameters.measurements_distance_m)
                  if (axis.side, axis.ray.origin_y) == ("front", 0.0))
    result = AutolockResult(number, "front", 2.25, 0.0, 1.0, 0.0, LineStatus.OK, 1.5, 0.111, 12.0,
                            LineStatus.NOT_REACHED, None, None, None, "")
    progress = Progress("autolock", parameters.to_mapping(), {}, NO_SHEET, [result])
    assessor = Assessor(scenario, parameters, NO_SHEET, load_calibration())
    terms = {term.name: term for term in assessor.assess(progress).budget(number, "unlock").terms}
    assert terms["front of the Car"].contribution_m == pytest.approx(0.11) and terms["front of the Car"].is_common
    assert terms["place and instant of the key"].sigma == pytest.approx(math.sqrt(0.111 ** 2 - 0.11 ** 2))
    assert "length of the Car" not in terms and "rear of the Car" not in terms
    lasting = assessor.lasting_sigmas(result, "unlock")
    assert (lasting.outline_m, lasting.outline_in_place_m) == (pytest.approx(0.11), 0.0)


@pytest.mark.parametrize("known", [WHEELS, CarDimensions(4.5, 1.8, 0.07, 0.07, ((1.0, 0.0), (0.0, 1.0), (0.0, 0.0)))])
def test_sides_survive_in_a_file_and_may_be_missing(known):
    document = {name: plain_fields(value) for name, value in car_document(known).items()}
    assert ("front_sigma" in document) is known.knows_sides
    assert plain_fields(car_from(document)) == plain_fields(known)
    assert plain_fields(car_from({**document, "left_sigma": None})) == plain_fields(replace(known, left_sigma=math.nan))
    with pytest.raises(ValueError, match="size"):
        car_from({**document, "rear_sigma": -0.1})
