"""Uncertainty budgets: known examples, sensitivities, what lines share, and the calibration records they read."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import math
from dataclasses import replace

import numpy as np
import pytest
import uncertainties
from uncertainties import ufloat

from mtr_operator.domain.errors import InvalidCalibration
from mtr_operator.domain.estimation.budget.calibration import Distribution
from mtr_operator.domain.estimation.budget.calibration_document import calibration_from
from mtr_operator.domain.estimation.budget.distance_budget import DistanceBudget, correlations
from mtr_operator.domain.estimation.budget.terms import Carriage, Measurement, Term, terms_of
from mtr_operator.domain.geometry.outline import SideError
from mtr_operator.storage.given_files import DEFAULT_CALIBRATION, load_calibration

TERM = {"value": 0.0, "uncertainty": 0.5, "distribution": "rectangular", "source": "rule"}
DOCUMENT = {"robot": "MTR-1", "date": "2026-03-01", "by": "J. Novak", "valid_days": 365, "key_ahead_m": 0.25,
            "terms": {"mast_lean_deg": TERM, "floor_slope_deg": TERM, "key_lever_m": {**TERM, "uncertainty": 0.003},
                      "lidar_yaw_deg": {**TERM, "degrees_of_freedom": 9.0}}}
FACING_FRONT = Carriage((1.0, 0.0), 1.0)


def term(name: str, sigma: float, freedom: float = math.inf, sensitivity: float = 1.0, is_common: bool = False) -> Term:
    """A normal one in m."""
    return Term(name, 0.0, sigma, "m", Distribution.NORMAL, freedom, sensitivity, sigma, "", is_common)


def test_end_gauge_example_of_the_gum_has_its_published_figures():
    # GUM H.1: contributions in nm and degrees of freedom; published are u = 32 nm, 16 degrees, U99 = 93 nm (k = 2.92).
    parts = [(25.0, 18.0), (5.8, 24.0), (3.9, 5.0), (6.7, 8.0), (2.9, 50.0), (16.6, 2.0)]
    budget = DistanceBudget(1, "end gauge", 0.0, tuple(term(str(index), *part) for index, part in enumerate(parts)))
    assert budget.sigma_m == pytest.approx(32.0, abs=0.5)
    assert math.floor(budget.degrees_of_freedom) == 16
    assert budget.coverage_factor == pytest.approx(2.12, abs=0.02)


def test_a_budget_of_infinite_degrees_covers_95_percent_with_1_96_sigma():
    budget = DistanceBudget(1, "unlock", 1.0, (term("own", 0.03), term("common", 0.04, is_common=True)))
    assert (budget.own_sigma_m, budget.common_sigma_m) == (0.03, 0.04)
    assert budget.sigma_m == pytest.approx(0.05)
    assert budget.expanded_m == pytest.approx(0.09800, abs=1e-5)


def test_correlation_is_the_share_of_the_common_errors_with_their_signs():
    budgets = [DistanceBudget(number, "unlock", 1.0, (term(f"own {number}", 0.03), term("mast", 0.04, sensitivity=sign,
                                                                                       is_common=True)))
               for number, sign in ((1, 1.0), (2, 1.0), (3, -1.0))]
    share = 0.0016 / 0.0025
    expected = [[1.0, share, -share], [share, 1.0, -share], [-share, -share, 1.0]]
    assert np.array(correlations(budgets)) == pytest.approx(np.array(expected))
    assert correlations([]) == []


def test_error_of_zero_is_no_variable_of_the_correlations(monkeypatch):
    made = []
    monkeypatch.setattr(uncertainties, "ufloat", lambda value, sigma: made.append(sigma) or ufloat(value, sigma))
    budgets = [DistanceBudget(line, "unlock", 1.0, (term("place", 0.02), term("time", 0.0),
                                                    term("lever", 0.02, is_common=True))) for line in (1, 2)]
    assert correlations(budgets)[0] == pytest.approx([1.0, 0.5])
    # Newer versions of the package warn of each on the terminal.
    assert made and 0.0 not in made


def test_correlations_are_those_of_drawn_errors():
    record = calibration_from(DOCUMENT)
    measurements = [Measurement(0.004, 0.0, (0.01, 0.02)), Measurement(0.006, 0.0, (0.01, 0.02))]
    carriages = [Carriage((1.0, 0.0), 1.0), Carriage((math.sqrt(0.5), math.sqrt(0.5)), 1.3)]
    budgets = [DistanceBudget(line, "unlock", 1.0, terms_of(*both, record))
               for line, both in enumerate(zip(measurements, carriages), start=1)]
    random = np.random.default_rng(4)
    shared: dict[str, np.ndarray] = {}
    errors = []
    for budget in budgets:
        error = np.zeros(20000)
        for each in budget.terms:
            drawn = random.normal(0.0, each.sigma, 20000)
            error += each.sensitivity * (shared.setdefault(each.name, drawn) if each.is_common else drawn)
        errors.append(error)
    assert np.std(errors, axis=1) == pytest.approx([budget.sigma_m for budget in budgets], rel=0.03)
    assert np.corrcoef(errors)[0, 1] == pytest.approx(correlations(budgets)[0][1], abs=0.02)


def test_a_mast_that_leans_a_degree_moves_a_key_at_1_m_by_17_mm():
    terms = {found.name: found for found in terms_of(Measurement(0.0, 0.0, (0.0, 0.0)), FACING_FRONT,
                                                     calibration_from(DOCUMENT))}
    assert terms["mast_lean_deg"].sensitivity == pytest.approx(-0.01745, abs=1e-5)
    assert terms["mast_lean_deg"].contribution_m == pytest.approx(0.01745 * 0.5 / math.sqrt(3.0), rel=1e-3)
    assert terms["key_lever_m"].contribution_m == pytest.approx(0.003 / math.sqrt(3.0))
    assert terms["lidar_yaw_deg"].contribution_m == 0.0
    assert "2026-03-01: rule" in terms["mast_lean_deg"].source
    assert set(terms) == {"mast_lean_deg", "floor_slope_deg", "key_lever_m", "lidar_yaw_deg"}


def test_a_yaw_counts_when_the_robot_stands_aslant():
    terms = terms_of(Measurement(0.0, 0.0, (0.0, 0.0)), replace(FACING_FRONT, heading_offset_rad=math.radians(5.0)),
                     calibration_from(DOCUMENT))
    yaw = next(found for found in terms if found.name == "lidar_yaw_deg")
    assert yaw.contribution_m == pytest.approx(0.25 * math.sin(math.radians(5.0)) * math.radians(0.5) / math.sqrt(3.0))


def test_what_is_open_of_the_cars_timing_correlates_lines_by_its_part_of_their_variance():
    measurements = [Measurement(0.0, own_m, (0.0, 0.0), timing_m, "unlock") for own_m, timing_m in
                    ((0.03, 0.04), (0.04, 0.03))]
    budgets = [DistanceBudget(line, "unlock", 1.0, terms_of(each, FACING_FRONT, calibration_from({**DOCUMENT, "terms": {
        name: {**TERM, "uncertainty": 0.0} for name in DOCUMENT["terms"]}})))
               for line, each in enumerate(measurements, start=1)]
    assert [budget.common_sigma_m for budget in budgets] == pytest.approx([0.04, 0.03])
    assert correlations(budgets)[0][1] == pytest.approx(0.04 * 0.03 / 0.05 ** 2)


def test_the_car_s_length_counts_along_it_and_its_width_across():
    def sizes(direction):
        found = terms_of(Measurement(0.0, 0.0, (0.02, 0.04)), Carriage(direction, 1.0), calibration_from(DOCUMENT))
        return {part.name: round(part.contribution_m, 6) for part in found if part.name.endswith("of the Car")}
    assert sizes((1.0, 0.0)) == {"length of the Car": 0.01, "width of the Car": 0.0}
    assert sizes((0.0, -1.0)) == {"length of the Car": 0.0, "width of the Car": 0.02}


def test_a_known_error_that_is_not_corrected_counts_in_full():
    term_of = calibration_from({**DOCUMENT, "terms": {**DOCUMENT["terms"], "mast_lean_deg": {
        **TERM, "value": 0.4, "uncertainty": 0.3, "distribution": "normal"}}}).terms["mast_lean_deg"]
    assert term_of.sigma == pytest.approx(0.5)


def test_a_record_is_written_as_it_was_read():
    record = calibration_from(DOCUMENT)
    assert calibration_from(record.to_document()) == record
    assert record.terms["lidar_yaw_deg"].degrees_of_freedom == 9.0


def test_a_record_warns_on_the_day_after_its_validity():
    record = calibration_from(DOCUMENT)
    last = datetime.date(2026, 3, 1) + datetime.timedelta(days=365)
    assert record.warning(last) == ""
    assert "366 days old" in record.warning(last + datetime.timedelta(days=1))


def test_the_shipped_record_is_read_and_never_expires():
    record = load_calibration()
    assert record.warning(datetime.date(2099, 1, 1)) == ""
    assert all(item.uncertainty > 0.0 for item in record.terms.values())


@pytest.mark.parametrize("change, piece", [
    ({"date": "yesterday"}, "date has to be"), ({"date": 3}, "date has to be"), ({"valid_days": 0}, "valid_days"),
    ({"valid_days": 1.5}, "valid_days"), ({"robot": ""}, "robot has to be"), ({"key_ahead_m": math.nan}, "key_ahead_m"),
    ({"terms": {}}, "mast_lean_deg is missing"), ({"terms": None}, "terms: it has to"),
    ({"more": 1}, "'more' is unknown"),
    ({"terms": {**DOCUMENT["terms"], "key_lever_m": {**TERM, "uncertainty": 0.2}}}, "key_lever_m: uncertainty"),
    ({"terms": {**DOCUMENT["terms"], "key_lever_m": {**TERM, "uncertainty": -0.1}}}, "allowed is 0 to 0.1"),
    ({"terms": {**DOCUMENT["terms"], "mast_lean_deg": {**TERM, "distribution": "even"}}}, "one of normal"),
    ({"terms": {**DOCUMENT["terms"], "mast_lean_deg": {**TERM, "distribution": []}}}, "one of normal"),
    ({"terms": {**DOCUMENT["terms"], "mast_lean_deg": 3}}, "mast_lean_deg: it has to"),
    ({"terms": {**DOCUMENT["terms"], "mast_lean_deg": {**TERM, "degrees_of_freedom": 0}}}, "degrees_of_freedom is 0")])
def test_a_damaged_record_is_refused_with_its_place(change, piece):
    with pytest.raises(InvalidCalibration) as caught:
        calibration_from({**DOCUMENT, **change})
    assert piece in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"{", b"\xff", b"terms: {a: *b}", b"x" * 70000])
def test_a_file_that_is_no_record_is_one_sentence_with_its_name(tmp_path, content):
    path = tmp_path / "robot.yaml"
    path.write_bytes(content)
    with pytest.raises(InvalidCalibration) as caught:
        load_calibration(path)
    assert str(path) in str(caught.value)
    assert DEFAULT_CALIBRATION.is_file()


def test_sides_of_the_car_are_common_to_the_lines_that_begin_on_them():
    front, left = SideError("front", 0.11, 1.0), SideError("left", 0.035, 1.0)
    corner = (replace(front, share=math.sqrt(0.5)), replace(left, share=math.sqrt(0.5)))
    rear = SideError("rear", 0.075, 1.0)
    budgets = [DistanceBudget(line, "unlock", 1.0, terms_of(Measurement(0.004, 0.0, (0.0, 0.0), sides=sides),
                                                            Carriage(direction, 1.0), calibration_from(DOCUMENT)))
               for line, (sides, direction) in enumerate((((front,), (1.0, 0.0)), ((front,), (1.0, 0.0)),
                                                          (corner, (math.sqrt(0.5),) * 2), ((rear,), (-1.0, 0.0))), 1)]
    named = [{term.name: term for term in budget.terms} for budget in budgets]
    assert named[0]["front of the Car"].contribution_m == pytest.approx(0.11) and "rear of the Car" not in named[0]
    assert named[2]["left of the Car"].contribution_m == pytest.approx(0.035 * math.sqrt(0.5))
    assert all(term.is_common for terms in named for name, term in terms.items() if name.endswith("of the Car"))
    shares = correlations(budgets)
    assert shares[0][1] > 0.95 and 0.8 < shares[0][2] < shares[0][1] and shares[0][3] < 0.2
