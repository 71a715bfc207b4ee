"""The URDF loads, and says the same about the robot as the simulator does."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from xml.etree import ElementTree

import mujoco
import pytest
import yaml

from mtr_core import names
from mtr_description.shipped import shipped_urdf
from mtr_simulation.physics import robot

PACKAGE = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def root():
    return ElementTree.fromstring(shipped_urdf())


def numbers(element, attribute, default="0 0 0"):
    text = element.get(attribute, default) if element is not None else default
    return [float(number) for number in text.split()]


def joint_to(root, link):
    return next((joint for joint in root.findall("joint") if joint.find("child").get("link") == link), None)


def place(root, link):
    """Position in base_link with the lift at its lower stop; no parent of another link is turned."""
    position = [0.0, 0.0, 0.0]
    while link != names.BASE:
        joint = joint_to(root, link)
        position = [a + b for a, b in zip(position, numbers(joint.find("origin"), "xyz"))]
        link = joint.find("parent").get("link")
    return position


def link(root, name):
    return next(each for each in root.findall("link") if each.get("name") == name)


def mass(root, name):
    return float(link(root, name).find("inertial/mass").get("value"))


def test_each_link_but_the_base_hangs_on_one_joint(root):
    links = [each.get("name") for each in root.findall("link")]
    children = [joint.find("child").get("link") for joint in root.findall("joint")]
    assert sorted([*children, names.BASE]) == sorted(links)


@pytest.mark.parametrize("frame", [names.BASE, names.FRONT_LIDAR, names.REAR_LIDAR, names.IMU, names.KEY])
def test_frame_of_the_sensor_messages_exists(root, frame):
    assert link(root, frame) is not None


def test_urdf_loads_in_the_physics_engine():
    model = mujoco.MjModel.from_xml_string(shipped_urdf())
    assert {model.joint(index).name for index in range(model.njnt)} == {"lift", *(f"{n}_wheel" for n in robot.WHEELS)}


@pytest.mark.parametrize(("frame", "x_m", "yaw_rad"), [
    (names.FRONT_LIDAR, robot.FRONT_LIDAR_X_M, robot.FRONT_LIDAR_YAW_RAD),
    (names.REAR_LIDAR, robot.REAR_LIDAR_X_M, robot.REAR_LIDAR_YAW_RAD),
])
def test_lidars_are_where_the_simulator_has_them(root, frame, x_m, yaw_rad):
    assert place(root, frame) == pytest.approx([x_m, 0.0, robot.LIDAR_HEIGHT_M - robot.BASE_HEIGHT_M])
    assert numbers(joint_to(root, frame).find("origin"), "rpy") == pytest.approx([0.0, 0.0, yaw_rad])


def test_key_is_where_the_simulator_has_it(root):
    height = robot.KEY_HEIGHT_AT_LOWER_STOP_M - robot.BASE_HEIGHT_M
    assert place(root, names.KEY) == pytest.approx([robot.KEY_X_M, 0.0, height])


def test_lift_has_the_simulator_s_stroke(root):
    lift = next(joint for joint in root.findall("joint") if joint.get("name") == "lift")
    limit = lift.find("limit")
    assert lift.get("type") == "prismatic"
    assert (float(limit.get("lower")), float(limit.get("upper"))) == (0.0, robot.LIFT_STROKE_M)


@pytest.mark.parametrize(("wheel", "position"), list(zip(robot.WHEELS, robot.WHEEL_POSITIONS)))
def test_wheels_are_where_the_simulator_has_them(root, wheel, position):
    assert place(root, f"{wheel}_wheel_link") == pytest.approx(position)
    cylinder = link(root, f"{wheel}_wheel_link").find("visual/geometry/cylinder")
    assert float(cylinder.get("radius")) == robot.WHEEL_RADIUS_M
    assert float(cylinder.get("length")) == robot.WHEEL_WIDTH_M


@pytest.mark.parametrize(("name", "mass_kg"), [
    ("chassis", robot.BASE_MASS_KG), ("mast", robot.MAST_MASS_KG), ("carriage", robot.CARRIAGE_MASS_KG),
    ("key", robot.KEY_MASS_KG), ("front_lidar", robot.LIDAR_MASS_KG), ("front_left_wheel_link", robot.WHEEL_MASS_KG),
])
def test_masses_are_the_simulator_s(root, name, mass_kg):
    assert mass(root, name) == mass_kg


def test_boxes_are_the_simulator_s(root):
    boxes = [numbers(box, "size") for box in link(root, "chassis").findall("visual/geometry/box")]
    assert boxes == [list(robot.CHASSIS_SIZE), list(robot.FENDERS_SIZE)]
    assert place(root, "mast")[0] == robot.MAST_X_M
    assert numbers(link(root, "mast").find("visual/geometry/box"), "size")[2] == robot.MAST_LENGTH_M


def test_root_has_no_inertia_because_kdl_cannot_use_it(root):
    assert link(root, names.BASE).find("inertial") is None


def test_rviz_shows_what_the_nodes_publish():
    config = yaml.safe_load((PACKAGE / "rviz" / "robot.rviz").read_text(encoding="utf-8"))
    manager = config["Visualization Manager"]
    topics = {display.get("Topic") or display.get("Marker Topic") for display in manager["Displays"]}
    assert manager["Global Options"]["Fixed Frame"] == names.MAP
    assert topics >= {names.FRONT_SCAN, names.REAR_SCAN, names.MOTION_PATH, names.SIM_TRUTH, names.CAR_MARKERS,
                      names.MAP_GRID, names.LOCALIZATION_MARKERS, names.MOTION_MARKERS, names.DRIVE_MARKERS}


def test_key_is_what_is_foremost(root):
    boxes = link(root, "chassis").findall("visual/geometry/box")
    assert max(numbers(box, "size")[0] for box in boxes) / 2.0 < robot.KEY_X_M + 0.02
    assert math.isclose(place(root, names.KEY)[1], 0.0)
