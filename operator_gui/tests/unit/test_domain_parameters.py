"""Parameters: a clear sentence for everything that is not allowed."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib

import pytest

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.storage.given_files import load_limits
from mtr_operator.storage.parameter_file import load_parameters

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


@pytest.mark.parametrize(("values", "parts"), [
    ({"maximum_distance_m": 51.0}, ["maximum_distance_m", "51 m", "0.1 to 50 m"]),
    ({"maximum_speed_mps": 0}, ["maximum_speed_mps", "0 m/s", "0.05 to 2 m/s"]),
    ({"maximum_distance_m": math.nan}, ["maximum_distance_m", "nan", "0.1 to 50 m"]),
    ({"maximum_distance_m": math.inf}, ["maximum_distance_m", "inf", "0.1 to 50 m"]),
    ({"maximum_distance_m": "1,5"}, ["maximum_distance_m", "'1,5'", "1.5"]),
    ({"maximum_distance_m": "far"}, ["maximum_distance_m", "'far'", "a number"]),
    ({"maximum_distance_m": True}, ["maximum_distance_m", "True", "a number"]),
    ({"maximum_distance_m": None}, ["maximum_distance_m", "None", "a number"]),
    ({"maximum_distance_m": [4.0]}, ["maximum_distance_m", "[4.0]", "a number"]),
    ({"maximum_distance": 4.0}, ["maximum_distance is unknown", "maximum_distance_m"]),
    ({"zzz": 4.0}, ["zzz is unknown", "minimum_distance_m", "key_height_m"]),
    ({"minimum_distance_m": 4.0}, ["minimum_distance_m is 4 m", "below", "maximum_distance_m, 4 m"]),
    ({"straightening_distance_m": 3.5}, ["straightening_distance_m is 3.5 m", "3.5 m"]),
    ({"minimum_distance_m": 0.2}, ["minimum_distance_m is 0.2 m", "clearance_m, 0.3 m"]),
    ({"measuring_speed_mps": 1.5}, ["measuring_speed_mps is 1.5 m/s", "maximum_speed_mps, 1 m/s"]),
    ({"key_height_m": 1.6}, ["key_height_m", "1.6 m", "0.35 to 1.55 m"]),
])
def test_autolock_violation_is_a_sentence_with_name_value_and_range(values, parts):
    with pytest.raises(InvalidParameter) as caught:
        AutolockParameters.from_mapping(values)
    for part in parts:
        assert part in str(caught.value)


@pytest.mark.parametrize(("values", "parts"), [
    ({"angle_between_radials_deg": 361}, ["angle_between_radials_deg", "361 deg", "1 to 360 deg"]),
    ({"angle_between_radials_deg": 0}, ["angle_between_radials_deg", "0 deg"]),
    ({"attempts": 1.5}, ["attempts", "1.5", "whole numbers"]),
    ({"attempts": 0}, ["attempts", "0", "1 to 20"]),
    ({"attempts": math.nan}, ["attempts", "nan", "1 to 20"]),
    ({"attempts": math.inf}, ["attempts", "inf", "1 to 20"]),
    ({"minimum_distance_m": 10 ** 400}, ["minimum_distance_m", "1000", "...", "0 to 20 m"]),
    ({"press_strength": 1.01}, ["press_strength", "1.01", "0.05 to 1"]),
    ({"minimum_distance_m": 7.0}, ["minimum_distance_m is 7 m", "at most", "6.5 m"]),
    ({"straightening_distance_m": 3.6}, ["straightening_distance_m is 3.6 m", "3.5 m"]),
    ({"method": "fast"}, ["method is fast", "scan or adaptive"]),
    ({"method": "x" * 5000}, ["method is xxx", "scan or adaptive"]),
    ({"method": None}, ["method is no word (NoneType)", "scan or adaptive"]),
    ({"method": True}, ["method is no word (bool)"]),
    ({"metod": "scan"}, ["metod is unknown", "did you mean method"]),
    ({"interval_m": 0.01}, ["interval_m is 0.01 m", "0.05 to 5 m"]),
    ({"attempts_limit": 5}, ["attempts_limit", "6 to 200"]),
])
def test_key_press_violation_is_a_sentence_with_name_value_and_range(values, parts):
    with pytest.raises(InvalidParameter) as caught:
        KeyPressParameters.from_mapping(values)
    for part in parts:
        assert part in str(caught.value)


def test_full_circle_is_allowed_and_radians_inside():
    assert KeyPressParameters.from_mapping({"angle_between_radials_deg": 360}).angle_between_radials_rad == \
        pytest.approx(2 * math.pi)


def test_straightening_up_to_the_minimum_distance_is_allowed_for_key_press():
    parameters = KeyPressParameters.from_mapping({"straightening_distance_m": 3.5})
    assert parameters.press_distances_m == [3.0]


def test_places_end_at_exactly_the_minimum_distance_despite_rounding():
    parameters = KeyPressParameters.from_mapping({
        "minimum_distance_m": 3.1, "maximum_distance_m": 4.3, "straightening_distance_m": 0.3,
        "approach_distance_m": 0.1})
    assert parameters.press_distances_m == pytest.approx([4.0, 3.9, 3.8, 3.7, 3.6, 3.5, 3.4, 3.3, 3.2, 3.1])


def test_places_never_lie_below_the_minimum_distance():
    parameters = KeyPressParameters.from_mapping({"approach_distance_m": 2.0})
    assert parameters.press_distances_m == pytest.approx([6.0, 4.0])


def test_measuring_speed_is_the_maximum_speed_by_default():
    assert AutolockParameters.from_mapping({"maximum_speed_mps": 0.7}).speed_on_axis_mps == 0.7


@pytest.mark.parametrize("kind", [AutolockParameters, KeyPressParameters])
def test_mapping_makes_a_round_trip(kind):
    assert kind.from_mapping(kind().to_mapping()) == kind()


@pytest.mark.parametrize("path", sorted([*EXAMPLES.glob("*.yaml"), *(EXAMPLES / "demo").rglob("*.yaml")]),
                         ids=lambda path: str(path.relative_to(EXAMPLES)))
def test_shipped_example_is_valid(path):
    if path.parent.name == "limits":
        assert load_limits(path).requirements
    else:
        parameters = load_parameters(path, SCENARIOS[path.stem].parameters_type)
        assert SCENARIOS[path.stem].lines(parameters, CarDimensions(4.5, 1.8, 0.01, 0.01))


def test_example_of_every_scenario_is_shipped():
    for folder in (EXAMPLES, EXAMPLES / "demo"):
        assert {path.stem for path in folder.glob("*.yaml")} == set(SCENARIOS)


@pytest.mark.parametrize(("text", "part"), [
    ("minimum_distance_m: 0.5\nminimum_distance_m: 0.6\n", "says minimum_distance_m twice"),
    ("a: [1,\n", "not valid YAML in line 2"),
    ("- 1\n", "parameter: value"),
    ("just text", "parameter: value"),
    ("maximum_distance_m: 1,5\n", "write a decimal point: 1.5"),
    ("maximum_distance_m: .nan\n", "maximum_distance_m is nan"),
    ("passes: 1\nmaximum_distance_m: 012\n", "says 012 in line 2, which YAML takes for 10; write the number that"),
    ("maximum_distance_m: 1:30\n", "says 1:30 in line 1, which YAML takes for 90; write the number that is meant"),
    ("maximum_distance_m: 1:3.5\n", "says 1:3.5 in line 1, which YAML takes for 63.5;"),
    ("maximum_distance_m: 1_5\n", "says 1_5 in line 1, which YAML takes for 15;"),
    ("maximum_distance_m: 1_0.5\n", "says 1_0.5 in line 1, which YAML takes for 10.5;"),
    ("? [1, 2]\n: 3\n", "not valid YAML in line 1"),
    ("maximum_distance_m: !!python/object:os.system x\n", "not valid YAML"),
])
def test_bad_parameter_file_is_a_sentence_with_its_name(tmp_path, text, part):
    path = tmp_path / "parameters.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidParameter) as caught:
        load_parameters(path, AutolockParameters)
    assert part in str(caught.value)
    assert str(path) in str(caught.value)


def test_missing_and_binary_parameter_files_are_sentences(tmp_path):
    with pytest.raises(InvalidParameter, match="cannot be read"):
        load_parameters(tmp_path / "none.yaml", AutolockParameters)
    path = tmp_path / "binary.yaml"
    path.write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(InvalidParameter, match="not a text file"):
        load_parameters(path, AutolockParameters)


@pytest.mark.parametrize(("key", "value", "text"), [
    ("key_height_m", 1.024, "102.4 cm"), ("maximum_speed_mps", 1.0, "3.6 km/h"), ("minimum_distance_m", 3.0, "3 m"),
    ("angle_between_radials_deg", 45.0, "45\N{DEGREE SIGN}"), ("attempts", 2, "2")])
def test_operator_reads_centimetres_degrees_and_kilometres_per_hour(key, value, text):
    declared = {item.file_key: item for item in KeyPressParameters.declarations().values()}
    assert declared[key].shown_text(value) == text


def test_json_and_empty_files_are_parameter_files(tmp_path):
    path = tmp_path / "parameters.json"
    path.write_text('{"minimum_distance_m": 0.6}', encoding="utf-8")
    assert load_parameters(path, AutolockParameters).minimum_distance_m == 0.6
    path.write_text("", encoding="utf-8")
    assert load_parameters(path, AutolockParameters) == AutolockParameters()


def test_file_from_before_there_was_a_choice_means_what_it_meant():
    assert KeyPressParameters.from_mapping({}).method == "scan"
    assert KeyPressParameters.from_mapping(KeyPressParameters.proposed()).method == "adaptive"


@pytest.mark.parametrize("name", ["key_press.yaml", "demo/key_press.yaml"])
def test_shipped_parameters_of_key_press_search_for_intervals(name):
    assert load_parameters(EXAMPLES / name, KeyPressParameters).method == "adaptive"


def test_key_frequency_sets_the_half_wavelength():
    plan = KeyPressParameters.from_mapping({"method": "adaptive", "key_frequency_mhz": 868.3}).search_plan
    assert plan.half_wavelength_m == pytest.approx(0.1726, abs=1e-4)
    assert (plan.minimum_m, plan.maximum_m, plan.interval_m, plan.attempts_limit) == (3.0, 6.0, 0.25, 24)


def test_numbers_of_the_other_method_have_no_effect():
    declarations = KeyPressParameters.declarations()
    for method, idle in (("scan", {"interval_m", "attempts_limit", "key_frequency_hz", "key_rest_limit_s"}),
                         ("adaptive", {"approach_distance_m", "attempts", "confirming_presses"})):
        parameters = KeyPressParameters.from_mapping({"method": method})
        assert {name for name, declared in declarations.items() if not parameters.has_effect(declared)} == idle
