"""Colours of an error map, and what report and files say of a digital key."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import csv
from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.geometry.polygon import distance_to_polygon
from mtr_operator.domain.results.diverging import colour_of_error, scale_of
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.picture import PointRole, PointSet
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.digital_key.parameters import DigitalKeyParameters
from mtr_operator.domain.scenarios.digital_key.result import DigitalKeyResult
from mtr_operator.domain.verdict.assessment import Assessor
from mtr_operator.report.error_map.colours import draw_errors, draw_scale
from mtr_operator.report.protocol_rows import summary_rows
from mtr_operator.report.results_csv import results_csv
from mtr_operator.report.table import results_table
from mtr_operator.storage.calibration_file import load_calibration

SCENARIO = SCENARIOS["digital_key"]
CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
OK = DigitalKeyResult(1, "front", 4.5, 1.0, LineStatus.OK, "distance", 20, 4.8, 0.05, 0.02, 0.2, 4.5, 0.03, 0.3, 0.23,
                      0.37, 21.0, 6.75, 0.0, 4.5, 0.0, 0.0, figures_m=(4.8, 4.8))
SILENT = DigitalKeyResult(2, "front", 3.5, 1.0, LineStatus.INVALID, "none", 0, reference_m=3.5, x_m=5.75, y_m=0.0,
                          reason="Nothing was told.")


def progress(results):
    return Progress("digital_key", DigitalKeyParameters().to_mapping(), {}, CAR, results)


@pytest.mark.parametrize(("errors_m", "scale_m"), [
    ([], 0.01), ([0.001], 0.01), ([0.1, -0.31], 0.4), ([0.5], 0.5), ([-0.09], 0.1), ([7.0], 8.0), ([0.1 + 0.2], 0.3)])
def test_the_full_colour_is_a_round_error_that_none_exceeds(errors_m, scale_m):
    assert scale_of(errors_m) == pytest.approx(scale_m)


def test_too_near_and_too_far_have_different_colours_and_a_small_error_is_pale():
    near, none, far = (colour_of_error(error_m, 0.4) for error_m in (-0.4, 0.0, 0.4))
    assert near == colour_of_error(-9.0, 0.4) == (0, 114, 178)
    assert far == (213, 94, 0)
    assert min(none) > 240 and min(colour_of_error(0.1, 0.4)) > min(far)


def test_the_map_has_a_scale_in_centimetres_only_where_there_are_errors():
    figure = Figure()
    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
    points = PointSet("Error", PointRole.FIRST, ((1.0, 2.0), (3.0, 2.0)), errors_m=(0.1, -0.31))
    draw_errors(axes, points)
    draw_scale(figure, replace(points, errors_m=()))
    assert len(figure.axes) == 1
    draw_scale(figure, points)
    scale = figure.axes[1]
    assert scale.get_xlim() == pytest.approx((-40.0, 40.0))
    assert "[cm]" in scale.get_title()


def test_the_file_tells_errors_summary_and_what_the_figures_mean():
    lines = results_csv(SCENARIO, progress([OK, SILENT])).splitlines()
    assert "# summary bias: +30.0 cm (? ... ?)" in lines
    assert "# summary places without answer: 1 / 2 (50 %)" in lines
    row, silent = csv.DictReader(line for line in lines if not line.startswith("#"))
    assert (row["error_m"], row["reported_m"], row["answer"]) == ("0.3000", "4.8000", "distance")
    assert (silent["status"], silent["error_m"], silent["answer"]) == ("invalid", "", "none")
    table = list(results_table(SCENARIO, [OK, SILENT]))
    assert any("1 sigma of where it really was" in line for line in table)
    assert ("places without answer", "1 / 2 (50 %)") in summary_rows(SCENARIO, progress([OK, SILENT]))


def test_the_budget_is_that_of_the_error_and_the_outline_is_measured_from_the_phones_place():
    outline = ((2.25, -0.9), (2.25, 0.9), (-2.25, 0.9), (-2.25, -0.9))
    car = replace(CAR, outline=outline)
    parameters = DigitalKeyParameters(maximum_distance_m=4.5)
    found = Assessor(SCENARIO, parameters, car, load_calibration()).assess(progress([OK]))
    budget = found.budget(1, "phone")
    assert budget.sigma_m > (0.03 ** 2 + 0.02 ** 2) ** 0.5
    assert budget.expanded_m > SIGMAS_OF_LEVEL * (0.03 ** 2 + 0.02 ** 2) ** 0.5
    assert found.to_outline_m[1, "phone"] == pytest.approx(distance_to_polygon((6.75, 0.0), outline))
