"""The URDF loads in all its readers and has the frames of the nodes; rviz displays their topics."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from xml.etree import ElementTree

import pytest
import yaml

from mtr_core import names
from mtr_description.shipped import main, shipped_geometry, shipped_urdf, urdf_in

PACKAGE = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def root():
    return ElementTree.fromstring(shipped_urdf())


def link(root, name):
    return next(each for each in root.findall("link") if each.get("name") == name)


def test_each_link_but_the_base_hangs_on_one_joint(root):
    links = [each.get("name") for each in root.findall("link")]
    children = [joint.find("child").get("link") for joint in root.findall("joint")]
    assert sorted([*children, names.BASE]) == sorted(links)


@pytest.mark.parametrize("frame", [names.BASE, names.FRONT_LIDAR, names.REAR_LIDAR, names.IMU, names.KEY])
def test_frame_of_the_sensor_messages_exists(root, frame):
    assert link(root, frame) is not None


def test_root_has_no_inertia_because_kdl_cannot_use_it(root):
    assert link(root, names.BASE).find("inertial") is None


def test_rviz_shows_what_the_nodes_publish():
    config = yaml.safe_load((PACKAGE / "rviz" / "robot.rviz").read_text(encoding="utf-8"))
    manager = config["Visualization Manager"]
    topics = {display.get("Topic") or display.get("Marker Topic") for display in manager["Displays"]}
    assert manager["Global Options"]["Fixed Frame"] == names.MAP
    assert topics >= {names.FRONT_SCAN, names.REAR_SCAN, names.MOTION_PATH, names.SIM_TRUTH, names.CAR_MARKERS,
                      names.MAP_GRID, names.LOCALIZATION_MARKERS, names.MOTION_MARKERS, names.DRIVE_MARKERS}


def test_rviz_has_the_robots_panel():
    config = yaml.safe_load((PACKAGE / "rviz" / "robot.rviz").read_text(encoding="utf-8"))
    plugins = ElementTree.parse(str(PACKAGE.parent / "mtr_rviz" / "plugin_description.xml")).getroot()
    assert {panel["Class"] for panel in config["Panels"]} == {"rviz/Displays", *(each.get("name") for each in plugins)}


def test_key_is_what_is_foremost():
    geometry = shipped_geometry()
    assert geometry.footprint().front_m == geometry.key().x_m + 0.02


PART_OF_A_PACKAGE = """<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find {package})/urdf/robot.urdf.xacro"/>
</robot>
"""


def test_description_may_include_a_file_of_a_package(tmp_path, capsys):
    path = tmp_path / "part.urdf.xacro"
    path.write_text(PART_OF_A_PACKAGE.format(package="mtr_description"), encoding="utf-8")
    assert ElementTree.fromstring(urdf_in(path)).find("link") is not None
    assert main([str(path)]) == 0 and "<link" in capsys.readouterr().out


def test_package_that_is_missing_is_named_in_one_sentence(tmp_path, capsys):
    path = tmp_path / "part.urdf.xacro"
    path.write_text(PART_OF_A_PACKAGE.format(package="no_such_package"), encoding="utf-8")
    assert main([str(path)]) == 1
    error = capsys.readouterr().err.strip()
    assert "no_such_package" in error and str(path) in error and "\n" not in error
    assert main([]) == 2
