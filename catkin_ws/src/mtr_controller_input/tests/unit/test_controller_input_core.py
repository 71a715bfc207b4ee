"""The dead-man switch and the velocities of the manual controller."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_controller_input.core import RELEASED, velocity
from mtr_controller_input.parameters import Parameters
from mtr_core.errors import ConfigurationError

PARAMETERS = Parameters()
SLOW, FAST, BOTH, NONE = [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 1, 1], [0] * 6


def test_without_a_dead_man_button_nothing_is_wanted():
    assert velocity(PARAMETERS, [1.0, 1.0], NONE, 0.0) == RELEASED


@pytest.mark.parametrize("buttons, linear, angular", [(SLOW, 0.4, 0.6), (FAST, 1.2, 1.2), (BOTH, 1.2, 1.2)])
def test_full_deflection_gives_the_velocity_of_the_button(buttons, linear, angular):
    assert velocity(PARAMETERS, [1.0, 1.0], buttons, 0.0) == (linear, angular, True)


def test_held_button_without_deflection_holds_the_robot():
    assert velocity(PARAMETERS, [0.04, -0.04], SLOW, 0.0) == (0.0, 0.0, True)


@pytest.mark.parametrize("age_s", [0.51, math.inf, math.nan, -0.1])
def test_stale_message_counts_as_released(age_s):
    assert velocity(PARAMETERS, [1.0, 1.0], SLOW, age_s) == RELEASED


@pytest.mark.parametrize("axes", [[], [math.nan, math.inf], [0.0]])
def test_missing_or_broken_axis_counts_as_released(axes):
    assert velocity(PARAMETERS, axes, SLOW, 0.0)[:2] == (0.0, 0.0)


def test_deflection_beyond_one_is_one():
    assert velocity(PARAMETERS, [-3.0, 3.0], SLOW, 0.0) == (0.4, -0.6, True)


def test_controller_without_the_button_counts_as_released():
    assert velocity(PARAMETERS, [1.0, 1.0], [1], 0.0) == RELEASED


@pytest.mark.parametrize("bad", [{"slow_mps": 3.0}, {"slow_button": 40}, {"dead_zone": 0.9},
                                 {"silent_after_s": float("nan")}])
def test_parameter_out_of_range_is_a_sentence(bad):
    with pytest.raises(ConfigurationError, match=next(iter(bad))):
        Parameters(**bad)


def test_two_buttons_on_one_index_are_an_error():
    with pytest.raises(ConfigurationError, match="must differ"):
        Parameters(slow_button=5)
