"""What a guided calibration finds is kept in the robot's record, and the next tests use it."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import datetime

import pytest

from mtr_operator.domain.errors import InvalidCalibration, OutputError
from mtr_operator.domain.estimation.budget.calibration_steps import Found, with_height, with_lever
from mtr_operator.station.calibration.record_keeper import RecordKeeper
from mtr_operator.station.settings_file import SettingsStore
from mtr_operator.storage.given_files import load_calibration

FIRST, LATER = datetime.date(2026, 11, 23), datetime.date(2027, 1, 5)
HEIGHT, LEVER = Found(3, 0.011, 0.001), Found(5, 0.262, 0.001)


def keep_height(record, signed):
    return with_height(record, HEIGHT, signed)


def keep_lever(record, signed):
    return with_lever(record, LEVER, 0.25, signed)


@pytest.fixture
def store(tmp_path):
    made = SettingsStore(tmp_path / "settings.json")
    made.settings = dataclasses.replace(made.settings, result_folder=tmp_path / "results")
    return made


def test_first_finding_begins_a_record_that_the_next_tests_use(store, tmp_path):
    path = RecordKeeper(store, lambda: FIRST).keep(keep_height, "MTR 1/a", "J. Novak")
    assert path == tmp_path / "calibration" / "MTR_1_a.yaml"
    assert store.settings.calibration == path
    record = load_calibration(path)
    assert (record.robot, record.by, record.made, record.valid_days) == ("MTR 1/a", "J. Novak", FIRST, 365)
    assert record.key_height_offset_m == 0.011


def test_later_step_has_its_own_date_and_leaves_the_others(store):
    RecordKeeper(store, lambda: FIRST).keep(keep_height, "MTR-1", "J. Novak")
    path = RecordKeeper(store, lambda: LATER).keep(keep_lever, "", "K. Dvorak")
    record = load_calibration(path)
    assert record.robot == "MTR-1"
    assert {check.name: (check.made, check.by) for check in record.checks} == \
        {"lift_height_m": (FIRST, "J. Novak"), "key_lever_m": (LATER, "K. Dvorak")}
    assert record.terms["key_lever_m"].value == pytest.approx(0.012)


def test_record_of_the_same_robot_is_found_again_when_none_was_chosen(store):
    RecordKeeper(store, lambda: FIRST).keep(keep_height, "MTR-1", "J. Novak")
    keeper = RecordKeeper(store, lambda: LATER)
    keeper.use(None)
    assert (keeper.path, keeper.record()) == (None, None)
    kept = load_calibration(keeper.keep(keep_lever, "MTR-1", "x"))
    assert {check.name for check in kept.checks} == {"lift_height_m", "key_lever_m"}


def test_figure_beyond_what_may_be_recorded_is_refused_and_nothing_written(store, tmp_path):
    keeper = RecordKeeper(store, lambda: FIRST)
    with pytest.raises(InvalidCalibration, match="key_lever_m: value is 0.112 m; allowed is -0.1 to 0.1 m"):
        keeper.keep(lambda record, signed: with_lever(record, LEVER, 0.15, signed), "MTR-1", "x")
    assert not (tmp_path / "calibration").exists()
    assert store.settings.calibration is None


def test_folder_that_cannot_be_made_is_one_sentence(store, tmp_path):
    (tmp_path / "calibration").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        RecordKeeper(store, lambda: FIRST).keep(keep_height, "MTR-1", "x")


def test_damaged_record_is_not_overwritten(store, tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("robot: MTR-1\n")
    keeper = RecordKeeper(store, lambda: FIRST)
    with pytest.raises(InvalidCalibration):
        keeper.use(path)
    store.change(dataclasses.replace(store.settings, calibration=path))
    with pytest.raises(InvalidCalibration):
        keeper.keep(keep_height, "MTR-1", "x")
    assert path.read_text() == "robot: MTR-1\n"
