"""The record that the robot's guided calibration writes is the one that the Operator's budget reads."""
# SPDX-License-Identifier: Apache-2.0
import datetime
import math

import pytest

from mtr_commissioning.calibration.readings import Estimate
from mtr_commissioning.calibration.record import DESIGN_TERMS, LARGEST, Check, Origin, updated
from mtr_commissioning.calibration.record_file import save
from mtr_operator.domain.estimation.budget import calibration_document
from mtr_operator.storage.given_files import load_calibration

TODAY = datetime.date(2026, 11, 23)
ORIGIN = Origin("MTR-1", "J. Nov\u00e1k", 0.25)
NAMES = ("key_lever_m", "mast_lean_deg", "lidar_yaw_deg", "wheel_scale", "gyro_scale", "lift_height_m", "press_force_n",
         "mass_kg", "centre_of_mass_m")


def test_every_measurement_is_read_and_counts_where_it_has_a_term(tmp_path):
    document, path = None, tmp_path / "robot.yaml"
    for number, name in enumerate(NAMES):
        freedom = math.inf if name == "press_force_n" else 5.0
        document = updated(document, ORIGIN, Check(name, Estimate(0.01, 0.002, freedom), "tape"),
                           TODAY - datetime.timedelta(10 * number))
    save(path, document)
    record = load_calibration(path)
    assert [check.name for check in record.checks] == list(NAMES)
    assert record.made == TODAY - datetime.timedelta(20)
    for name in ("key_lever_m", "mast_lean_deg", "lidar_yaw_deg"):
        assert record.terms[name].sigma == pytest.approx(math.hypot(0.01, 0.002))
        assert record.terms[name].degrees_of_freedom == 5.0
    assert record.warning(TODAY) == ""
    assert "press_force_n was measured 366 days ago" in record.warning(TODAY + datetime.timedelta(306))
    assert calibration_document.calibration_from(record.to_document()) == record


def test_terms_of_the_design_and_their_limits_are_the_same_on_both_sides(tmp_path):
    document = updated(None, ORIGIN, Check("wheel_scale", Estimate(1.0, 0.001, 3.0), "tape"), TODAY)
    path = tmp_path / "robot.yaml"
    save(path, document)
    assert load_calibration(path).terms == load_calibration().terms
    assert set(LARGEST) < set(DESIGN_TERMS)
    assert {name: calibration_document._LARGEST[name.rpartition("_")[2]] for name in LARGEST} == LARGEST
