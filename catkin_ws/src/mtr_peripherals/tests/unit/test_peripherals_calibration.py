"""Buttons and times of the calibration."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib

import pytest
import yaml

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import parameters_from
from mtr_peripherals.calibration import Calibration, RequestRefused
from mtr_peripherals.parameters import Parameters

SHIPPED = pathlib.Path(__file__).resolve().parents[2] / "config" / "calibration.yaml"
CALIBRATION = Calibration()


def test_shipped_file_holds_every_value_and_is_valid():
    values = yaml.safe_load(SHIPPED.read_text(encoding="utf-8"))
    shipped = parameters_from(values, Calibration)
    assert set(values) == set(vars(CALIBRATION))
    assert shipped.button_of_servo == (1, 2)


@pytest.mark.parametrize("buttons, bits", [([1], 1), ([2], 2), ([1, 2], 3), ([2, 2], 2)])
def test_buttons_become_servos(buttons, bits):
    assert CALIBRATION.servos(buttons) == bits


@pytest.mark.parametrize("buttons", [[], [3], [1, 0]])
def test_unknown_button_is_refused(buttons):
    with pytest.raises(RequestRefused):
        CALIBRATION.servos(buttons)


@pytest.mark.parametrize("strength", [-0.1, 1.1, math.nan])
def test_strength_out_of_range_is_refused(strength):
    with pytest.raises(RequestRefused, match="0 to 1"):
        CALIBRATION.strength(strength)


@pytest.mark.parametrize("duration_s, hold_ms", [(0.0, 300), (0.25, 250), (0.0001, 1), (10.0, 10000)])
def test_duration_becomes_milliseconds(duration_s, hold_ms):
    assert CALIBRATION.hold_ms(duration_s) == hold_ms


@pytest.mark.parametrize("duration_s", [-1.0, 10.1, math.nan, math.inf])
def test_duration_out_of_range_is_refused(duration_s):
    with pytest.raises(RequestRefused):
        CALIBRATION.hold_ms(duration_s)


@pytest.mark.parametrize("bad", [{"maximum_hold_s": 100.0}, {"button_of_servo": [1, 2, 3]}, {"button_of_servo": [0]},
                                 {"default_hold_s": 20.0}, {"minimum_strength": 1.1}])
def test_value_out_of_range_is_a_sentence(bad):
    with pytest.raises(ConfigurationError, match=next(iter(bad))):
        Calibration(**bad)


def test_node_reads_parameters_and_calibration_from_one_namespace():
    parameters = parameters_from({"firmware_silent_after_s": 2, "default_hold_s": 0.8}, Parameters)
    assert parameters == Parameters(firmware_silent_after_s=2.0, calibration=Calibration(default_hold_s=0.8))


def test_ends_of_the_allowed_ranges_are_allowed():
    assert (CALIBRATION.strength(0.0), CALIBRATION.strength(1.0)) == (0.0, 1.0)


def test_small_negative_duration_is_refused():
    with pytest.raises(RequestRefused):
        CALIBRATION.hold_ms(-0.5)


def test_mount_has_at_least_one_servo():
    assert Calibration(button_of_servo=(3,)).servos([3]) == 1
    with pytest.raises(ConfigurationError, match="button_of_servo"):
        Calibration(button_of_servo=())
