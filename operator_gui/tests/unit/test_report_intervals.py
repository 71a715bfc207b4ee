"""How intervals are shown: in the table, and in the picture of a search for Key press."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.results.figure import Figure, Kind, figure_of
from mtr_operator.domain.results.line_result import LineStatus, has_intervals, result_from_document
from mtr_operator.domain.results.picture import PointRole
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.scenarios.zone_map.parameters import ZoneMapParameters
from mtr_operator.domain.scenarios.zone_map.result import ZoneMapResult
from mtr_operator.domain.verdict.assessment import Assessor
from mtr_operator.history.statistics.texts import signed_number
from mtr_operator.report.figures import ends_text
from mtr_operator.report.protocol_page import protocol_png
from mtr_operator.report.results_csv import results_csv
from mtr_operator.report.table import line_text, results_table
from mtr_operator.storage.given_files import load_calibration

KEY_PRESS = SCENARIOS["key_press"]
CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
PARAMETERS = KeyPressParameters.from_mapping({"method": "adaptive", "angle_between_radials_deg": 90.0})
MEASURED = KeyPressResult(1, 0.0, LineStatus.OK, 5.3, 5.6, 0.01, 12, 1.0, "", method="adaptive", reach="measured",
                          d50_m=5.4, d50_sigma_m=0.15, d50_low_m=5.12, d50_high_m=5.71, d95_m=4.9, d95_low_m=4.5,
                          d95_high_m=5.3, holes_m="3.46")
OPEN = replace(MEASURED, radial=2, angle_deg=90.0, d50_high_m=None, holes_m="")
FARTHER = replace(OPEN, radial=3, angle_deg=180.0, status=LineStatus.NOT_REACHED, reach="farther", d50_m=None,
                  d95_m=None, d95_low_m=None, d95_high_m=None)
NEARER = replace(FARTHER, radial=4, angle_deg=270.0, reach="nearer", d50_low_m=None, d50_high_m=3.4)
RESULTS = [MEASURED, OPEN, FARTHER, NEARER]


def test_table_has_intervals_and_says_where_one_is_open():
    heading, *rows = results_table(KEY_PRESS, RESULTS)
    assert heading.endswith("95 % m")
    assert [row.rsplit("  ", 1)[1] for row in rows[:4]] == [
        "5.12 to 5.71", "at least 5.12", "at least 5.12", "at most 3.40"]
    assert "5.40  0.150" in rows[0] and "at least 5.12" in rows[2].split("  ")
    assert rows[4].startswith("Beside each distance stands 1 sigma of the boundary, and its 95 % interval")


def test_table_without_intervals_is_as_before():
    scan = replace(MEASURED, method="scan")
    assert not has_intervals([scan])
    assert next(iter(results_table(KEY_PRESS, [scan]))).endswith("key \N{PLUS-MINUS SIGN} m")


def test_picture_of_a_scan_tells_a_range_between_places_from_one_beyond_the_first__A5_A6():
    between = replace(MEASURED, method="scan", distance_m=5.0, failed_distance_m=5.5)
    beyond = replace(between, radial=2, angle_deg=90.0, distance_m=6.0, failed_distance_m=None)
    scan = KeyPressParameters.from_mapping({"method": "scan", "angle_between_radials_deg": 90.0})
    worked, failed, farther, _ = KEY_PRESS.picture(scan, CAR, [between, beyond]).point_sets
    assert (worked.known, failed.known) == (((5.0, 0.0),), ((5.5, 0.0),))
    assert worked.figures == (Figure(Kind.BETWEEN, 5.0, 5.5), None)
    assert worked.brackets == (((5.0, 0.0), (5.5, 0.0)),)
    assert farther.role is PointRole.FIRST_FAILED and farther.figures == (Figure(Kind.AT_LEAST, 6.0),)
    assert farther.known[0] == pytest.approx((0.0, -6.0))
    assert protocol_png(KEY_PRESS, scan, Progress("key_press", scan.to_mapping(), {}, CAR, [between, beyond]))


def test_figures_stand_beside_the_boundary_alone():
    half, sure, *_ = KEY_PRESS.picture(PARAMETERS, CAR, RESULTS).point_sets
    assert half.figures == (Figure(Kind.VALUE, 5.4), None, None, None)
    assert set(sure.figures) == {None}


@pytest.mark.parametrize(("ends", "figure", "text"), [
    ({}, Figure(Kind.AT_LEAST, 5.12), "press at least 5.12 m"),
    ({"d50_low_m": None, "d50_high_m": 5.71}, Figure(Kind.AT_MOST, 5.71), "press at most 5.71 m"),
    ({"d50_low_m": None}, Figure(Kind.UNKNOWN), "press unknown")])
def test_boundary_with_an_open_end_is_no_value_with_a_sigma(ends, figure, text):
    opened = replace(OPEN, **ends)
    distance, = opened.distances
    assert (distance.distance_m, distance.uncertainty_m) == (None, None)
    assert figure_of(distance) == figure
    assert line_text(KEY_PRESS, opened).endswith(text)
    assert result_from_document(KeyPressResult, opened.to_document()) == opened


def test_picture_of_a_search_has_both_outlines_with_intervals_and_what_is_not_known():
    half, sure, farther, nearer, unknown, holes, invalid = KEY_PRESS.picture(PARAMETERS, CAR, RESULTS).point_sets
    assert half.is_outline and sure.is_outline
    assert (len(half.known), len(sure.known)) == (1, 2)
    assert half.intervals == (((5.12, 0.0), (5.71, 0.0)),) and len(sure.intervals) == 2
    assert half.bars == ()
    # An open interval has the end that is known.
    assert farther.known == (pytest.approx((0.0, -5.12)), pytest.approx((-5.12, 0.0)))
    assert farther.figures == (Figure(Kind.AT_LEAST, 5.12),) * 2
    assert nearer.known == (pytest.approx((0.0, 3.4)),) and nearer.figures == (Figure(Kind.AT_MOST, 3.4),)
    assert unknown.known == ()
    assert holes.known[0] == pytest.approx((3.46, 0.0)) and invalid.known == ()


def test_border_that_nobody_knows_is_shown_as_a_guess():
    nowhere = replace(OPEN, d50_low_m=None)
    *_, unknown, _, _ = KEY_PRESS.picture(PARAMETERS, CAR, [nowhere]).point_sets
    assert unknown.role is PointRole.UNKNOWN and unknown.known == (pytest.approx((0.0, -5.4)),)
    assert unknown.figures == (Figure(Kind.UNKNOWN),)
    progress = Progress("key_press", PARAMETERS.to_mapping(), {}, CAR, [nowhere])
    assert protocol_png(KEY_PRESS, PARAMETERS, progress).startswith(b"\x89PNG")


def test_protocol_is_drawn_with_intervals():
    progress = Progress("key_press", PARAMETERS.to_mapping(), {}, CAR, RESULTS)
    assert protocol_png(KEY_PRESS, PARAMETERS, progress).startswith(b"\x89PNG")


def test_lean_of_mast_and_floor_counts_by_the_height_of_the_zone():
    parameters = ZoneMapParameters(heights=2, highest_key_height_m=1.5)
    zones = [ZoneMapResult(number, "front", height_m, LineStatus.OK, 16, 3.0, 2.5, 3.5, 0.01, 0.5, 0.4, 0.6)
             for number, height_m in ((1, 1.0), (9, 1.5))]
    progress = Progress("zone_map", parameters.to_mapping(), {}, CAR, zones)
    budgets = Assessor(SCENARIOS["zone_map"], parameters, CAR, load_calibration()).assess(progress).budgets
    low, high = ({term.name: term.contribution_m for term in budget.terms} for budget in budgets)
    for name in ("mast_lean_deg", "floor_slope_deg"):
        assert high[name] == pytest.approx(1.5 * low[name])
    assert high["key_lever_m"] == low["key_lever_m"]


@pytest.mark.parametrize(("outline", "shortest_m"), [
    # The recorded distance counts from the centre, the outline's front lies 2.2 m before it.
    (((2.2, -0.9), (2.2, 0.9), (-2.2, 0.9), (-2.2, -0.9)), MEASURED.distances[0].distance_m - 2.2), ((), None)])
def test_distance_from_the_outline_that_was_seen_is_offered_too(outline, shortest_m):
    car = replace(CAR, outline=outline)
    progress = Progress("key_press", PARAMETERS.to_mapping(), {}, car, [MEASURED])
    assessment = Assessor(KEY_PRESS, PARAMETERS, car, load_calibration()).assess(progress)
    assert assessment.to_outline_m.get((1, "press")) == (shortest_m if shortest_m is None
                                                         else pytest.approx(shortest_m, abs=1e-3))
    row = list(csv.DictReader(line for line in results_csv(KEY_PRESS, progress, assessment).splitlines()
                              if not line.startswith("#")))[0]
    assert row["press_to_outline_m"] == ("" if shortest_m is None else f"{shortest_m:.4f}")


@pytest.mark.parametrize(("ends", "figure", "sigma_m"), [
    ((2.5, 3.5), Figure(Kind.VALUE, 3.0), 0.255), ((2.1, None), Figure(Kind.AT_LEAST, 2.1), None),
    ((None, 4.35), Figure(Kind.AT_MOST, 4.35), None), ((None, None), Figure(Kind.UNKNOWN), None)])
def test_reach_of_a_zone_has_the_sigma_of_its_interval_and_not_of_the_keys_place(ends, figure, sigma_m):
    parameters = ZoneMapParameters()
    zone = ZoneMapResult(1, "front", 1.0, LineStatus.OK, 16, 3.0, *ends, 0.002, 0.5, 0.4, 0.6)
    distance, = zone.distances
    assert figure_of(distance) == figure
    assert distance.uncertainty_m == (None if sigma_m is None else pytest.approx(sigma_m, abs=1e-3))
    progress = Progress("zone_map", parameters.to_mapping(), {}, CAR, [zone])
    budgets = Assessor(SCENARIOS["zone_map"], parameters, CAR, load_calibration()).assess(progress).budgets
    assert [budget.expanded_m > 0.45 for budget in budgets] == ([] if sigma_m is None else [True])
    assert result_from_document(ZoneMapResult, zone.to_document()) == zone


@pytest.mark.parametrize("ends", [{}, {"d50_low_m": None}])
def test_boundary_with_an_open_end_has_no_expanded_uncertainty(ends):
    assessor = Assessor(KEY_PRESS, PARAMETERS, CAR, load_calibration())
    closed, opened = (assessor.assess(Progress("key_press", PARAMETERS.to_mapping(), {}, CAR, [result])).budgets
                      for result in (MEASURED, replace(OPEN, **ends)))
    assert len(closed) == 1 and opened == ()


@pytest.mark.parametrize("low, high, text, signed", [
    (1.0, 2.0, "1.00 to 2.00", "+1.00 to +2.00"), (-0.5, 0.0, "-0.50 to 0.00", "-0.50 to +0.00"),
    (1.0, math.inf, "at least 1.00", "at least +1.00"), (-math.inf, -2.0, "at most -2.00", "at most -2.00"),
    (-math.inf, math.inf, "", ""), (math.nan, 2.0, "at most 2.00", "at most +2.00"), (math.nan, math.nan, "", "")])
def test_end_that_is_not_finite_is_not_written(low, high, text, signed):
    assert ends_text(low, high) == text and ends_text(low, high, signed_number) == signed


def test_ends_have_the_digits_and_the_language_of_their_user():
    assert ends_text(1.0, 2.0, lambda value, digits: f"{value:.{digits}f}".replace(".", ","),
                     lambda template: template.replace("to", "bis"), digits=3) == "1,000 bis 2,000"
