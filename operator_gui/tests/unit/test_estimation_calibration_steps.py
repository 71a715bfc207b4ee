"""What a person reads on rule and tape measure becomes terms and steps of a calibration record."""
# SPDX-License-Identifier: Apache-2.0
import datetime
import math

import pytest

from mtr_operator.domain.errors import InvalidCalibration
from mtr_operator.domain.estimation.budget.calibration import KEY_LEVER, MAST_LEAN
from mtr_operator.domain.estimation.budget.calibration_document import calibration_from
from mtr_operator.domain.estimation.budget.calibration_steps import (
    Signed,
    found_from,
    height_from,
    lever_from,
    with_height,
    with_lever,
    with_press,
)
from mtr_operator.domain.estimation.budget.terms import Carriage, Measurement, terms_of
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.storage.given_files import load_calibration

TODAY = datetime.date(2026, 11, 23)
SIGNED = Signed(TODAY, "J. Novak")
RECORD = load_calibration()


def term_named(name, record):
    terms = terms_of(Measurement(0.0, 0.0, (0.0, 0.0)), Carriage((1.0, 0.0), 1.0), record)
    return next(term for term in terms if term.name == name)


def test_lever_is_the_mean_of_both_axles_with_the_spread_of_the_readings():
    found = lever_from([0.119, 0.121, 0.120], [0.381, 0.383, 0.382])
    assert (found.count, found.mean_m) == (3, pytest.approx(0.251))
    assert found.spread_m == pytest.approx(0.001)
    assert found.sigma_m == pytest.approx(math.hypot(0.001 / math.sqrt(3), 0.001 / math.sqrt(3)))


def test_lever_goes_into_the_budget_with_what_is_not_corrected():
    record = with_lever(RECORD, lever_from([0.129, 0.131, 0.130], [0.391, 0.393, 0.392]), 0.25, SIGNED)
    term = term_named(KEY_LEVER, record)
    assert (term.value, term.degrees_of_freedom) == (pytest.approx(0.011), 2.0)
    assert term.contribution_m == pytest.approx(math.hypot(0.011, 0.000816), abs=1e-5)
    assert term.source == "calibration record of 2026-11-23: rule to both axles, 3 readings"
    check = record.check_named(KEY_LEVER)
    assert (check.made, check.by, check.value) == (TODAY, "J. Novak", pytest.approx(0.011))


def test_height_of_the_tape_moves_the_lean_of_the_mast_in_the_budget():
    record = with_height(RECORD, height_from([(0.649, 0.6), (1.05, 1.0), (1.451, 1.4)]), SIGNED)
    before, after = term_named(MAST_LEAN, RECORD), term_named(MAST_LEAN, record)
    assert after.contribution_m == pytest.approx(1.05 * before.contribution_m)
    assert term_named(KEY_LEVER, record) == term_named(KEY_LEVER, RECORD)


def test_record_with_all_checks_comes_back_from_its_file():
    record = with_lever(RECORD, lever_from([0.119, 0.121, 0.120], [0.381, 0.383, 0.382]), 0.25, SIGNED)
    record = with_press(with_height(record, found_from([0.01, 0.012, 0.011]), SIGNED), 0.6, 0.1, 9, SIGNED)
    assert calibration_from(record.to_document()) == record
    assert [check.name for check in record.checks] == ["key_lever_m", "lift_height_m", "press_strength"]


def test_check_takes_the_place_of_the_former_one_and_the_record_is_as_old_as_its_terms():
    later = Signed(datetime.date(2027, 1, 5), "K. Dvorak")
    first = with_lever(RECORD, lever_from([0.119, 0.121, 0.120], [0.381, 0.383, 0.382]), 0.25, SIGNED)
    first = with_height(first, found_from([0.01, 0.012, 0.011]), SIGNED)
    second = with_height(first, found_from([0.0, 0.0, 0.0]), later)
    assert [(check.name, check.made) for check in second.checks] == \
        [("key_lever_m", TODAY), ("lift_height_m", later.made)]
    assert (second.made, second.key_height_offset_m) == (TODAY, 0.0)


@pytest.mark.parametrize(("readings", "sentence"), [
    ([], "There are 0 readings; give at least 3."), ([0.1, 0.1], "There are 2 readings; give at least 3."),
    ([0.10, 0.11, 0.13], "The readings differ by 30 mm; allowed is 20 mm. Read them again.")])
def test_readings_that_say_nothing_are_refused(readings, sentence):
    with pytest.raises(InvalidCalibration) as refused:
        found_from(readings)
    assert str(refused.value) == sentence


@pytest.mark.parametrize(("front", "rear", "part"), [
    ([0.1, 0.1, 0.1], [0.38, 0.38], "3 readings to the front axle and 2 to the rear one"),
    ([0.120, 0.112, 0.120], [0.382, 0.390, 0.382], "between the axles differs by 16 mm")])
def test_lever_whose_axles_do_not_agree_is_refused(front, rear, part):
    with pytest.raises(InvalidCalibration, match=part):
        lever_from(front, rear)


def test_press_weaker_than_the_car_answers_to_is_warned_of():
    record = with_press(RECORD, 0.6, 0.1, 9, SIGNED)
    [caution] = record.cautions(KeyPressParameters(press_strength=0.5), TODAY)
    assert caution.startswith(
        "Parameter press_strength is 0.5; at the calibration of 2026-11-23 the Car answered from 0.6 on.")
    assert record.cautions(KeyPressParameters(press_strength=0.6), TODAY) == ()
    assert record.cautions(AutolockParameters(), TODAY) == ()
    assert RECORD.cautions(KeyPressParameters(press_strength=0.05), TODAY) == ()


def test_heights_that_are_too_near_to_each_other_are_refused():
    with pytest.raises(InvalidCalibration) as refused:
        height_from([(0.61, 0.6), (0.71, 0.7), (0.81, 0.8)])
    assert str(refused.value) == "The heights are 20 cm apart; give some that are at least 30 cm apart."
