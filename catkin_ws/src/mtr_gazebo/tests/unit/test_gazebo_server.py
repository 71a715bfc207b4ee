"""Start of Gazebo's server: command, environment, parameters and launch file."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
from xml.etree import ElementTree

import pytest
from mtr_gazebo.equipment.ticks import ticks_between
from mtr_gazebo.server.environment import server_command, server_environment
from mtr_gazebo.server.parameters import ServerParameters
from mtr_gazebo.world.plugin_element import PLUGIN

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import parameters_from

PACKAGE = pathlib.Path(__file__).resolve().parents[2]
TOP = PACKAGE.parents[2]
LAUNCH = ElementTree.parse(PACKAGE / "launch" / "gazebo.launch").getroot()


def test_the_world_is_the_last_word_of_the_command():
    assert server_command("sh -c", pathlib.Path("/w/site.world")) == ["sh", "-c", "/w/site.world"]


@pytest.mark.parametrize("command", ["", "no-such-server --verbose"])
def test_a_server_that_is_not_installed_is_refused(command):
    with pytest.raises(ConfigurationError, match=f"command is '{command}'.* Gazebo 11"):
        server_command(command, pathlib.Path("/w/site.world"))


def test_the_plugin_is_found_where_the_workspace_was_built(tmp_path):
    (tmp_path / "devel" / "lib").mkdir(parents=True)
    (tmp_path / "devel" / "lib" / PLUGIN).touch()
    made = server_environment({"CMAKE_PREFIX_PATH": f"{tmp_path}/devel{os.pathsep}/usr", "GAZEBO_PLUGIN_PATH": "/mine"})
    assert made["GAZEBO_PLUGIN_PATH"] == f"{tmp_path}/devel/lib{os.pathsep}/mine"
    assert made["GAZEBO_MODEL_DATABASE_URI"] == ""


def test_a_workspace_without_the_plugin_is_refused(tmp_path):
    with pytest.raises(ConfigurationError, match="libmtr_gazebo_plugin_ros.so is not there; build the workspace"):
        server_environment({"CMAKE_PREFIX_PATH": str(tmp_path)})


def test_the_folder_of_the_plugin_may_be_said(tmp_path):
    (tmp_path / PLUGIN).touch()
    assert server_environment({"GAZEBO_PLUGIN_PATH": str(tmp_path)})["GAZEBO_PLUGIN_PATH"] == str(tmp_path)


def test_a_wrong_scenario_is_refused_before_anything_starts():
    with pytest.raises(ConfigurationError, match="scenario is 'moon'"):
        parameters_from({"scenario": "moon"}, ServerParameters)


@pytest.mark.parametrize(("last", "now", "expected"), [(100, 120, [120]), (100, 180, [120, 140, 160, 180]),
                                                       (100, 100, []), (100, 90, []), (100, 139, [120])])
def test_no_tick_is_lost_when_poses_come_late_or_together(last, now, expected):
    ms = 1_000_000
    assert [tick // ms for tick in ticks_between(last * ms, now * ms)] == expected


def test_every_argument_of_the_launch_file_is_documented():
    assert all(argument.get("doc") for argument in LAUNCH.findall("arg"))


def test_programs_of_the_launch_file_are_installed():
    cmake = (PACKAGE / "CMakeLists.txt").read_text(encoding="utf-8")
    own = [node.get("type") for node in LAUNCH.iter("node") if node.get("pkg") == "mtr_gazebo"]
    assert own == ["server", "equipment_node"]
    assert all(f"scripts/{name}" in cmake and (PACKAGE / "scripts" / name).stat().st_mode & 0o111 for name in own)


def test_parameters_that_the_launch_file_sets_are_those_of_the_server():
    (server,) = [node for node in LAUNCH.iter("node") if node.get("type") == "server"]
    assert {param.get("name") for param in server.findall("param")} == set(vars(ServerParameters()))


def test_what_robot_launch_is_given_it_knows():
    robot = ElementTree.parse(TOP / "launch" / "launch" / "robot.launch").getroot()
    known = {argument.get("name") for argument in robot.findall("arg")}
    assert {argument.get("name") for argument in LAUNCH.find("include").findall("arg")} <= known
