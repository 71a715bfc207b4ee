"""Shipped launch and configuration files load, and document their arguments."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
from xml.etree import ElementTree

import pytest
import yaml

TOP = pathlib.Path(__file__).resolve().parents[3]
LAUNCH_FILES = sorted((TOP / "launch" / "launch").glob("*.launch"))
ROBOT = TOP / "launch" / "launch" / "robot.launch"
# Files that robot.launch includes; it declares their arguments.
PARTS = sorted((TOP / "launch" / "launch" / "robot").glob("*.launch"))
MAX_LINES = 60
YAML_FILES = sorted(path for path in [*(TOP / "catkin_ws" / "src").glob("*/config/*.yaml"),
                                      *(TOP / "operator_gui").rglob("*.yaml")] if "build" not in path.parts)


def test_the_four_launch_files_are_there():
    assert {path.stem for path in LAUNCH_FILES} >= {"robot", "sim", "view", "replay"}


@pytest.mark.parametrize("path", LAUNCH_FILES, ids=lambda path: path.name)
def test_every_argument_of_a_launch_file_is_documented(path):
    assert all(argument.get("doc") for argument in ElementTree.parse(path).getroot().findall("arg"))


@pytest.mark.parametrize("path", [ROBOT, *PARTS], ids=lambda path: path.name)
def test_no_part_of_the_robot_is_longer_than_a_page(path):
    assert len(PARTS) == 6
    assert len(path.read_text(encoding="utf-8").splitlines()) <= MAX_LINES


@pytest.mark.parametrize("path", PARTS, ids=lambda path: path.name)
def test_parts_of_the_robot_take_the_arguments_of_robot_launch_alone(path):
    known = {argument.get("name") for argument in ElementTree.parse(ROBOT).getroot().findall("arg")}
    assert not list(ElementTree.parse(path).getroot().iter("arg")) or path.name == "nodes.launch"
    used = set(re.findall(r"\$\(arg (\w+)\)", path.read_text(encoding="utf-8")))
    assert used and used <= known


def test_every_argument_of_the_robot_is_used():
    text = "".join(path.read_text(encoding="utf-8") for path in PARTS)
    names = [argument.get("name") for argument in ElementTree.parse(ROBOT).getroot().findall("arg")]
    assert [name for name in names if not re.search(rf"\b{name}\b", text)] == []


@pytest.mark.parametrize("path", [*LAUNCH_FILES, *PARTS], ids=lambda path: path.name)
def test_every_node_of_a_launch_file_exists(path):
    for node in ElementTree.parse(path).getroot().iter("node"):
        package, executable = node.get("pkg"), node.get("type")
        folder = TOP / "catkin_ws" / "src" / package
        if not package.startswith("mtr_"):
            continue
        cmake = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
        assert executable in cmake, f"{package} does not build or install {executable}"


def test_end_of_one_node_of_the_robot_ends_no_other_and_it_is_started_again():  # A11
    nodes = [node for path in (ROBOT, *PARTS) for node in ElementTree.parse(path).getroot().iter("node")]
    assert len(nodes) > 10
    for node in nodes:
        assert node.get("respawn") in ("true", "$(arg respawn)"), node.attrib
        assert float(node.get("respawn_delay")) >= 1.0, node.attrib
        assert node.get("required") in (None, "$(eval not respawn)"), node.attrib


@pytest.mark.parametrize("path", YAML_FILES, ids=lambda path: str(path.relative_to(TOP)))
def test_every_configuration_file_loads(path):
    assert isinstance(yaml.safe_load(path.read_text(encoding="utf-8")), dict)
