"""Requirements on a base: each missing part of a URDF is named, and drive control's parameters follow from it."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
from collections import Counter

import pytest
import yaml

from mtr_commissioning.base_contract.balance import AGREEMENT_M, balance_parameters
from mtr_commissioning.base_contract.command_line import main
from mtr_commissioning.base_contract.description import description_findings
from mtr_commissioning.base_contract.interface import limit_findings, topic_rows
from mtr_commissioning.preflight.expected import Setup
from mtr_commissioning.preflight.records import RobotRecord, TopicRecord
from mtr_core import names
from mtr_description.base_controller import base_parameters_in
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_base_file, shipped_geometry, shipped_urdf, urdf_in

TOP = pathlib.Path(__file__).resolve().parents[5]
BASES = TOP / "tests" / "system" / "bases"
HEADER = TOP / "catkin_ws" / "src" / "mtr_drive_control" / "include" / "mtr_drive_control" / "parameters.hpp"


def bad(findings):
    """Return subjects and sentences of bad findings."""
    return {each.subject: each.text for each in findings if each.is_bad}


@pytest.mark.parametrize("text", [shipped_urdf(), urdf_in(BASES / "wide.urdf.xacro")], ids=["shipped", "wide"])
def test_both_bases_describe_themselves(text):
    assert bad(description_findings(text, has_rear_lidar=True)) == {}


@pytest.mark.parametrize("old, new, subjects", [
    ('"front_lidar"', '"laser"', {"front_lidar"}), ('"key"', '"remote"', {"key", "masses", "footprint"}),
    ('type="continuous"', 'type="fixed"', {"wheels", "key", "masses", "footprint"}),
    ('"0 0 3.141592653589793"', '"0 0 1.5"', {"rear_lidar"}), ("0.508 0.43 0.06", "2.5 0.43 0.06", {"footprint"}),
    ("<robot ", "<robots ", {names.ROBOT_DESCRIPTION})])
def test_each_thing_that_is_missing_is_named(old, new, subjects):
    found = bad(description_findings(shipped_urdf().replace(old, new), has_rear_lidar=True))
    assert set(found) == subjects
    assert all(text.endswith("Correct the file that robot_file:= names.") for text in found.values())


def test_robot_without_rear_lidar_needs_none():
    text = shipped_urdf().replace('"rear_lidar"', '"other"')
    assert bad(description_findings(text, has_rear_lidar=False)) == {}


def test_parameters_of_the_shipped_robot_are_drive_controls_own():
    for name, value in balance_parameters(shipped_geometry()).items():
        default = float(re.search(rf"double {name} = ([\d.]+);", HEADER.read_text(encoding="utf-8")).group(1))
        assert value == pytest.approx(default, abs=AGREEMENT_M), name


def test_parameters_of_the_wide_base_are_those_of_its_urdf():
    loaded = yaml.safe_load((BASES / "wide_nodes.yaml").read_text(encoding="utf-8"))["drive_control"]
    wanted = balance_parameters(RobotGeometry(urdf_in(BASES / "wide.urdf.xacro")))
    assert {name: loaded[name] for name in wanted} == pytest.approx(wanted, abs=1e-4)


@pytest.mark.parametrize("path", [shipped_base_file(), BASES / "wide_base.yaml"], ids=lambda path: path.stem)
def test_controllers_say_their_limits(path):
    assert bad(limit_findings("base", base_parameters_in(path))) == {}


@pytest.mark.parametrize("change, subject", [
    ({"cmd_vel_timeout": None}, "base/cmd_vel_timeout"), ({"cmd_vel_timeout": True}, "base/cmd_vel_timeout"),
    ({"linear": {"x": {"has_acceleration_limits": True, "max_velocity": 1.0}}}, "base/linear/x/max_acceleration"),
    ({"angular": {"z": {"has_acceleration_limits": False, "max_velocity": 1.0, "max_acceleration": 2.0}}},
     "base/angular/z")])
def test_limits_that_are_missing_are_named(change, subject):
    assert list(bad(limit_findings("base", {**base_parameters_in(shipped_base_file()), **change}))) == [subject]


def test_base_without_parameters_is_told_what_to_do():
    assert "base_guard:=true" in bad(limit_findings("base", None))["base"]


def record(frame="odom", rate_hz=50.0):
    """Return the record of a base without faults, except for the frame or the rate."""
    def topic(kind, hz, frames=()):
        return TopicRecord(kind, ("/base",), [number / hz for number in range(int(3 * hz))], [0.01], Counter(frames))
    return RobotRecord({names.WHEEL_COMMAND: TopicRecord("geometry_msgs/Twist", ("/drive_control",)),
                        names.WHEEL_ODOMETRY: topic("nav_msgs/Odometry", rate_hz, [frame]),
                        names.IMU_DATA: topic("sensor_msgs/Imu", 50.0, ["imu"]),
                        names.BATTERY: topic("sensor_msgs/BatteryState", 1.0)}, listened_s=3.0)


@pytest.mark.parametrize("heard, listeners, subject", [
    (record(), ["/base"], None), (record(), [], names.WHEEL_COMMAND),
    (record("wheels"), ["/base"], names.WHEEL_ODOMETRY),
    (record(rate_hz=10.0), ["/base"], names.WHEEL_ODOMETRY)])
def test_topics_of_the_base_are_checked_and_those_of_others_are_not(heard, listeners, subject):
    assert list(bad(topic_rows(heard, Setup(), listeners))) == ([] if subject is None else [subject])


def test_files_alone_are_checked_without_a_master(tmp_path, capsys):
    files = ["--robot-file", str(BASES / "wide.urdf.xacro"), "--base-file", str(BASES / "wide_base.yaml")]
    assert main([*files, "--json", str(tmp_path / "found.json")]) == 0
    assert "centre_of_mass_m: 0.2175" in capsys.readouterr().out
    assert main(["--robot-file", str(tmp_path / "none.urdf")]) == 2
    assert main([*files[:3], str(tmp_path / "none.yaml")]) == 2
