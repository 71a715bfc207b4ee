"""Shipped launch and configuration files load, and say what their arguments are for."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from xml.etree import ElementTree

import pytest
import yaml

TOP = pathlib.Path(__file__).resolve().parents[3]
LAUNCH_FILES = sorted((TOP / "launch" / "launch").glob("*.launch"))
YAML_FILES = sorted(path for path in [*(TOP / "catkin_ws" / "src").glob("*/config/*.yaml"),
                                      *(TOP / "operator_gui").rglob("*.yaml")] if "build" not in path.parts)


def test_the_four_launch_files_are_there():
    assert {path.stem for path in LAUNCH_FILES} >= {"robot", "sim", "view", "replay"}


@pytest.mark.parametrize("path", LAUNCH_FILES, ids=lambda path: path.name)
def test_every_argument_of_a_launch_file_is_documented(path):
    assert all(argument.get("doc") for argument in ElementTree.parse(path).getroot().findall("arg"))


@pytest.mark.parametrize("path", LAUNCH_FILES, ids=lambda path: path.name)
def test_every_node_of_a_launch_file_exists(path):
    for node in ElementTree.parse(path).getroot().iter("node"):
        package, executable = node.get("pkg"), node.get("type")
        folder = TOP / "catkin_ws" / "src" / package
        if not package.startswith("mtr_"):
            continue
        cmake = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
        assert executable in cmake, f"{package} does not build or install {executable}"


def test_end_of_one_node_of_the_robot_ends_no_other_and_it_is_started_again():  # A11
    nodes = list(ElementTree.parse(TOP / "launch" / "launch" / "robot.launch").getroot().iter("node"))
    assert len(nodes) > 10
    for node in nodes:
        assert node.get("respawn") in ("true", "$(arg respawn)"), node.attrib
        assert float(node.get("respawn_delay")) >= 1.0, node.attrib
        assert node.get("required") in (None, "$(eval not respawn)"), node.attrib


@pytest.mark.parametrize("path", YAML_FILES, ids=lambda path: str(path.relative_to(TOP)))
def test_every_configuration_file_loads(path):
    assert isinstance(yaml.safe_load(path.read_text(encoding="utf-8")), dict)
