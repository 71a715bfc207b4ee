"""Heights of the key and of its lift."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_description.shipped import shipped_geometry
from mtr_peripherals.calibration import RequestRefused
from mtr_peripherals.key_lift import HEIGHT_ROUNDING_M, KeyLift

LIFT = KeyLift(shipped_geometry().key())


@pytest.mark.parametrize("key_m, lift_m", [(0.35, 0.0), (1.55, 1.2), (1.0, 0.65), (1.5504, 1.2), (0.3496, 0.0)])
def test_key_height_becomes_lift_height(key_m, lift_m):
    assert LIFT.height_m(key_m) == pytest.approx(lift_m)


def test_no_height_holds_the_lift():
    assert math.isnan(LIFT.height_m(math.nan))


@pytest.mark.parametrize("key_m", [0.34, 1.56, -1.0, math.inf, -math.inf])
def test_height_out_of_range_is_refused_with_the_range(key_m):
    with pytest.raises(RequestRefused, match="0.35 to 1.55 m"):
        LIFT.height_m(key_m)


def test_key_is_as_far_above_its_lowest_place_as_the_lift_above_its_stop():
    assert LIFT.key_height_m(0.65) == pytest.approx(1.0)


def test_height_that_is_off_by_what_rounding_makes_is_that_of_the_stop():
    assert LIFT.height_m(LIFT.key_height_m(0.0) - HEIGHT_ROUNDING_M) == 0.0
