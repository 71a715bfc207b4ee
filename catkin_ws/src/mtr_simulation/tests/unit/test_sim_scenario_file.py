"""A test site from a file: allowed content, rejected content, and the resulting solids of both simulators."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2
from mtr_simulation.physics.mjcf import model_xml
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.site.car_shape import CAR_SHAPES
from mtr_simulation.site.scenario import SCENARIOS, Scenario
from mtr_simulation.site.scenario_file import chosen_scenario
from mtr_simulation.site.surroundings import Cone, ParkedCar, Pole, Walk, Wall

YARD = """
car: {length_m: 4.2, width_m: 1.75}
world_from_car: [1.0, -2.0, 90]
start_in_car: [4.0, 2.5, 180]
friction: 0.7
poles: [[9.0, 1.0], [9.5, -2.0, 0.08]]
cones: [[0.0, 12.0]]
walls: [[0.0, 14.0, 0.0, 20.0]]
parked_cars: [{pose: [-11.0, 0.0, 90], shape: van}]
person: {start: [-5.0, -8.0], end: [5.0, -8.0], speed_mps: 1.0}
"""


def written(tmp_path, text):
    path = tmp_path / "yard.yaml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_a_file_says_all_that_a_site_has(tmp_path):
    site = chosen_scenario(written(tmp_path, YARD))
    assert (site.car.length_m, site.car.width_m, site.friction) == (4.2, 1.75, 0.7)
    assert site.world_from_car == Pose2(1.0, -2.0, math.radians(90.0))
    assert site.start_in_car == Pose2(4.0, 2.5, math.radians(180.0))
    assert site.poles == (Pole(9.0, 1.0), Pole(9.5, -2.0, 0.08)) and site.cones == (Cone(0.0, 12.0),)
    assert site.walls == (Wall(Pose2(0.0, 14.0, 0.0), 20.0),)
    assert site.parked_cars == (ParkedCar(Pose2(-11.0, 0.0, math.radians(90.0)), CAR_SHAPES["van"]),)
    assert site.person == Walk((-5.0, -8.0), (5.0, -8.0), 1.0)
    assert site.start_offset_m == Scenario().start_offset_m


def test_an_empty_table_is_the_open_site_and_a_name_is_a_shipped_one(tmp_path):
    assert chosen_scenario(written(tmp_path, "{}")) == SCENARIOS["open"]
    assert chosen_scenario("far") is SCENARIOS["far"]


def test_the_physics_take_a_site_from_a_file(tmp_path):
    site = chosen_scenario(written(tmp_path, YARD))
    text = model_xml(site, shipped_robot(), site.start_in_world(1), 0.005, 6.0)
    assert text.count('body name="parked_0"') == 1 and text.count("mesh name=") == 3


@pytest.mark.parametrize(("text", "expected"), [
    ("- 1", "is no table"),
    ("a: [", "is not valid YAML"),
    ("tree: 1", "Entry tree is unknown; allowed are car, world_from_car"),
    ("friction: 9", "friction is 9"),
    ("friction: much", "friction is 'much'"),
    ("car: bus", "Entry car is 'bus'; allowed is default, hatchback"),
    ("car: [1]", r"Entry car is \[1\]"),
    ("car: {length_m: 99}", "length_m is 99 m"),
    ("poles: [[1.0]]", r"Entry poles\[0\] is \[1.0\]; allowed is a list of 2 to 3 numbers"),
    ("walls: here", "Entry walls is 'here'; allowed is a list"),
    ("start_in_car: [1.0, .nan, 3]", "Entry start_in_car"),
    ("parked_cars: [{place: [1, 2, 3]}]", "allowed is a table of pose, shape"),
    ("parked_cars: [{shape: van}]", r"Entry parked_cars\[0\].pose is None"),
])
def test_what_a_file_gets_wrong_is_said_in_one_sentence(tmp_path, text, expected):
    with pytest.raises(ConfigurationError, match=expected) as caught:
        chosen_scenario(written(tmp_path, text))
    assert str(caught.value).startswith("Scenario ")


def test_a_file_that_is_not_there_and_a_name_that_is_none_are_refused(tmp_path):
    with pytest.raises(ConfigurationError, match="cannot be read: No such file"):
        chosen_scenario(str(tmp_path / "none.yaml"))
    with pytest.raises(ConfigurationError, match="or the path of a YAML file"):
        chosen_scenario("moon")
