"""Data that the benchmark gives to the Car locator, and selection of the evaluated size."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from mtr_benchmarks.localization.drives.options import DriveOptions
from mtr_benchmarks.localization.drives.record import _meta
from mtr_benchmarks.localization.methods.this_system import data_sheet, is_below_widest_line, plane_errors
from mtr_car_locator.measure.car_fit import CarFit, PlaneSize
from mtr_car_locator.rectangle import Rectangle
from mtr_car_locator.surfels import surfels_from
from mtr_core.se2 import Pose2

NOWHERE = Pose2(0.0, 0.0, 0.0)


def meta(car, height_m):
    segment = {"kind": "loop", "end_s": 1.0}
    return _meta(DriveOptions(car=car, lidar_height_m=height_m), NOWHERE, [segment])


@pytest.mark.parametrize("car, height_m, below", [("hatchback", 0.3, False), ("sedan", 0.3, False), ("van", 0.3, False),
                                                  ("hatchback", 0.2, True), ("sedan", 0.2, True), ("van", 0.2, True)])
def test_data_sheet_is_given_where_the_plane_is_below_the_widest_line(car, height_m, below):
    assert is_below_widest_line(meta(car, height_m)) is below


def test_data_sheet_says_what_the_shape_is():
    sheet = data_sheet(meta("sedan", 0.2))
    assert (sheet.known_length_m, sheet.known_width_m, sheet.wheelbase_m) == (4.85, 1.85, 2.85)
    assert sheet.front_overhang_m == pytest.approx(1.0)


def test_measured_size_is_judged_and_the_published_one_where_nothing_was_measured():
    fit = CarFit(Rectangle(NOWHERE, 4.28, 1.79), (), (0.0, 0.0, 0.0), 0.005, 0.005, (), surfels_from(np.empty((0, 6))),
                 1.0, in_plane=PlaneSize(4.25, 0.002))
    found = plane_errors(fit, {"length_m": 4.251, "width_m": 1.761})
    assert found.length_m == pytest.approx(-0.001)
    assert found.width_m == pytest.approx(0.029)
