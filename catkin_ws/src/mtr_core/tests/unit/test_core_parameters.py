"""Reading, checking and formatting of parameters."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import FrozenInstanceError, dataclass
from typing import Tuple

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import ParameterSet, described, number, parameters_from


@dataclass(frozen=True)
class Inner(ParameterSet):
    """Parameters nested in Example."""

    stroke_m: float = number(1.2, 0.05, 2.0, "m")
    buttons: Tuple[int, ...] = (1, 2)


@dataclass(frozen=True)
class Example(ParameterSet):
    """One field of each type."""

    speed_mps: float = number(0.5, 0.05, 2.0, "m/s")
    seed: int = number(1, 0, 2**31 - 1)
    rear: bool = True
    address: str = ""
    owners: Tuple[str, ...] = ("a",)
    corners: Tuple[float, ...] = ()
    inner: Inner = Inner()


def test_no_value_gives_the_defaults():
    assert parameters_from({}, Example) == Example()


def test_list_of_numbers_takes_whole_and_other_numbers():
    assert parameters_from({"corners": [1, 2.5]}, Example).corners == (1, 2.5)


def test_values_replace_defaults_also_inside():
    parameters = parameters_from({"speed_mps": 1, "rear": False, "stroke_m": 0.8, "buttons": [3]}, Example)
    assert parameters == Example(speed_mps=1.0, rear=False, inner=Inner(0.8, (3,)))
    assert type(parameters.speed_mps) is float and type(parameters.inner.buttons) is tuple


def test_parameters_cannot_be_changed():
    with pytest.raises(FrozenInstanceError):
        Example().seed = 2


def test_unknown_name_is_refused_with_those_allowed():
    with pytest.raises(ConfigurationError) as error:
        parameters_from({"spead_mps": 1.0}, Example)
    assert str(error.value) == ("Parameter spead_mps is unknown; allowed are address, buttons, corners, owners, "
                                "rear, seed, speed_mps, stroke_m.")


@pytest.mark.parametrize("values, sentence", [
    ({"speed_mps": "fast"}, "Parameter speed_mps is 'fast'; allowed is a number, 0.05 to 2 m/s."),
    ({"speed_mps": True}, "Parameter speed_mps is True; allowed is a number, 0.05 to 2 m/s."),
    ({"seed": 1.0}, "Parameter seed is 1.0; allowed is a whole number, 0 to 2147483647."),
    ({"seed": False}, "Parameter seed is False; allowed is a whole number, 0 to 2147483647."),
    ({"rear": 1}, "Parameter rear is 1; allowed is true or false."),
    ({"address": 5}, "Parameter address is 5; allowed is a text."),
    ({"owners": "a"}, "Parameter owners is 'a'; allowed is a list of texts."),
    ({"buttons": [1, "b"]}, r"Parameter buttons is [1, 'b']; allowed is a list of whole numbers."),
    ({"corners": [1.0, "b"]}, r"Parameter corners is [1.0, 'b']; allowed is a list of numbers."),
    ({"buttons": [True]}, r"Parameter buttons is [True]; allowed is a list of whole numbers."),
])
def test_wrong_type_is_refused_with_what_is_allowed(values, sentence):
    with pytest.raises(ConfigurationError) as error:
        parameters_from(values, Example)
    assert str(error.value) == sentence


@pytest.mark.parametrize("values, sentence", [
    ({"speed_mps": 3}, "Parameter speed_mps is 3 m/s; allowed is 0.05 to 2 m/s."),
    ({"speed_mps": math.nan}, "Parameter speed_mps is nan m/s; allowed is 0.05 to 2 m/s."),
    ({"seed": -1}, "Parameter seed is -1; allowed is 0 to 2147483647."),
    ({"stroke_m": math.inf}, "Parameter stroke_m is inf m; allowed is 0.05 to 2 m."),
])
def test_number_out_of_range_is_refused_with_value_and_range(values, sentence):
    with pytest.raises(ConfigurationError) as error:
        parameters_from(values, Example)
    assert str(error.value) == sentence


def test_ends_of_the_range_are_allowed():
    assert parameters_from({"speed_mps": 0.05, "seed": 2**31 - 1}, Example).speed_mps == 0.05


def test_all_values_are_shown_in_one_line_with_units():
    assert described(Example()) == ("speed_mps 0.5 m/s, seed 1, rear true, address '', owners ['a'], "
                                    "corners [], stroke_m 1.2 m, buttons [1, 2]")
