"""Rejection of parameters."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_core.errors import ConfigurationError, RobotError, check_range


@pytest.mark.parametrize("value", [0.5, 1.0, 2.0])
def test_value_within_the_range_is_returned(value):
    assert check_range("~speed_mps", value, 0.5, 2.0, "m/s") == value


@pytest.mark.parametrize("value", [0.499, 2.001, math.nan, math.inf, -math.inf])
def test_value_beyond_the_range_is_refused(value):
    with pytest.raises(ConfigurationError):
        check_range("~speed_mps", value, 0.5, 2.0, "m/s")


def test_refusal_names_parameter_value_and_range():
    with pytest.raises(ConfigurationError) as refusal:
        check_range("~speed_mps", 9.0, 0.5, 2.0, "m/s")
    assert str(refusal.value) == "Parameter ~speed_mps is 9 m/s; allowed is 0.5 to 2 m/s."


def test_configuration_error_belongs_to_the_error_tree():
    assert issubclass(ConfigurationError, RobotError)
