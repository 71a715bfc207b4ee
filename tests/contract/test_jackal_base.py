"""What brings a Jackal's base beside this robot: no other commander, one description, limits that the mast survives.

What it stands for is of jackal/jackal (c6ab6ca), jackal/jackal_robot (1adcf8f) and clearpathrobotics/robot_upstart
(987376f).
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from xml.etree import ElementTree

import pytest
import roslaunch
import rospkg
import yaml

TOP = pathlib.Path(__file__).resolve().parents[2]
LAUNCH = TOP / "setup" / "robot" / "jackal_base.launch"
CONTROLLER = "/jackal_velocity_controller"
# Of a Jackal's control.yaml.
STOCK = {"jackal_velocity_controller": {
    "type": "diff_drive_controller/DiffDriveController", "cmd_vel_timeout": 0.25, "wheel_separation_multiplier": 1.5,
    "left_wheel": ["front_left_wheel", "rear_left_wheel"], "right_wheel": ["front_right_wheel", "rear_right_wheel"],
    "linear": {"x": {"max_acceleration": 20.0}}, "angular": {"z": {"max_acceleration": 25.0}}}}
FILES = {"jackal_control": {"control.yaml": STOCK, "robot_localization.yaml": {"frequency": 50}},
         "jackal_base": {"mag_config_default.yaml": {"mag_bias/x": 0.0}}}


@pytest.fixture(name="load")
def _load(tmp_path, monkeypatch):
    """The launch file as roslaunch reads it on a Jackal, with some arguments."""
    for package, files in FILES.items():
        (tmp_path / package / "config").mkdir(parents=True)
        (tmp_path / package / "package.xml").write_text(
            f"<package><name>{package}</name><version>0.1.0</version><description>-</description>"
            f"<maintainer email='a@b.example'>-</maintainer><license>-</license></package>", encoding="ascii")
        for name, content in files.items():
            (tmp_path / package / "config" / name).write_text(yaml.safe_dump(content), encoding="ascii")
    path = rospkg.get_ros_package_path()
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path}:{path}")
    for name in ("JACKAL_MAG_CONFIG", "JACKAL_WIRELESS_INTERFACE"):
        monkeypatch.delenv(name, raising=False)
    # roslaunch keeps what it found of packages.
    monkeypatch.setattr(roslaunch.substitution_args, "_rospack", None)
    monkeypatch.setattr(rospkg.rospack, "_cache", {}, raising=False)
    return lambda *arguments: roslaunch.config.load_config_default([(str(LAUNCH), list(arguments))], None)


def test_nobody_but_drive_control_is_there_to_command_the_wheels(load):
    nodes = load().nodes
    assert {node.type for node in nodes} == {
        "jackal_node", "message_info_service.py", "spawner", "imu_filter_node", "nmea_topic_driver",
        "ekf_localization_node"}
    assert not [node.name for node in nodes if any("cmd_vel" in word for pair in node.remap_args for word in pair)]


def test_limits_that_the_mast_survives_come_over_the_jackals_own(load):
    params = load().params
    ours = yaml.safe_load((TOP / "catkin_ws/src/mtr_description/config/jackal_base.yaml").read_text(encoding="utf-8"))
    for axis, name in (("linear", "x"), ("angular", "z")):
        limit = ours["jackal_velocity_controller"][axis][name]["max_acceleration"]
        assert params[f"{CONTROLLER}/{axis}/{name}/max_acceleration"].value == limit
    # What is not ours stays.
    assert params[f"{CONTROLLER}/wheel_separation_multiplier"].value == 1.5


def test_base_is_driven_by_the_robots_own_description(load, tmp_path):
    params = load().params
    robot = ElementTree.fromstring(params["/robot_description"].value)
    # The controller reads track and radius by these names, from cylinders.
    for name in STOCK["jackal_velocity_controller"]["left_wheel"] + STOCK["jackal_velocity_controller"]["right_wheel"]:
        joint = robot.find(f"joint[@name='{name}']")
        wheel = robot.find(f"link[@name='{joint.find('child').get('link')}']")
        assert joint.get("type") == "continuous" and wheel.find("collision/geometry/cylinder") is not None
    own = tmp_path / "own.urdf"
    own.write_text("<robot name='own'><link name='base_link'/></robot>", encoding="ascii")
    assert "name=\"own\"" in load(f"robot_file:={own}").params["/robot_description"].value


def test_whoever_says_odom_to_base_link_can_be_chosen(load):
    assert "ekf_localization" not in {node.name for node in load("ekf:=false").nodes}


def test_end_of_the_mcus_node_is_the_end_of_all_because_its_controllers_end_with_it(load):
    assert [node.name for node in load().nodes if node.required] == ["jackal_node"]


def test_every_argument_is_documented():
    assert all(argument.get("doc") for argument in ElementTree.parse(LAUNCH).getroot().findall("arg"))
