"""Start of the robot's service: selection of launch file, arguments and release."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import shutil
import subprocess

import pytest

START = pathlib.Path(__file__).resolve().parents[3] / "setup" / "robot" / "start"
ROSLAUNCH = """#!/bin/sh
echo "$@"
echo "ROS_HOME=$ROS_HOME ROS_LOG_DIR=$ROS_LOG_DIR LD_PRELOAD=$LD_PRELOAD"
echo "$ROS_HOSTNAME"
"""


@pytest.fixture
def robot(tmp_path):
    """Folder of releases with one in use; roslaunch only prints its arguments."""
    release = tmp_path / "a"
    (release / "lib").mkdir(parents=True)
    (release / "roslaunch").write_text(ROSLAUNCH, encoding="ascii")
    (release / "roslaunch").chmod(0o755)
    (release / "setup.bash").write_text(f'export PATH="{release}:$PATH"\n', encoding="ascii")
    (tmp_path / "current").symlink_to("a")
    (release / "share" / "mtr_bringup").mkdir(parents=True)
    (release / "share" / "mtr_bringup" / "launch").symlink_to(START.parents[2] / "launch" / "launch")
    for name in ("start", "jackal_base.launch"):
        shutil.copy(START.with_name(name), tmp_path)
    return tmp_path


def run(robot, *words, **environment):
    """Return the finished start."""
    given = {"PATH": "/usr/bin:/bin", "HOME": "/home/x", "CONFIGURATION_DIRECTORY": str(robot / "etc"),
             "ROS_MASTER_URI": "http://127.0.0.1:11311", **environment}
    return subprocess.run([robot / "start", *words], check=False, capture_output=True, text=True, env=given)


def started(robot, *words, **environment):
    """Return the start's output by lines."""
    done = run(robot, *words, **environment)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.mark.parametrize("environment, told", [
    ({}, "robot.launch"), ({"MTR_ARGUMENTS": "bind_address:=10.0.0.1 base_guard:=true"},
                           "robot.launch bind_address:=10.0.0.1 base_guard:=true"),
    ({"MTR_LAUNCH": "jackal.launch", "MTR_ARGUMENTS": "lidar:=sick_lms111"}, "jackal.launch lidar:=sick_lms111")])
def test_settings_choose_launch_file_and_arguments(robot, environment, told):
    assert started(robot, **environment)[0] == f"--skip-log-check mtr_bringup {told}"


def test_logs_go_where_systemd_says(robot):
    assert started(robot, STATE_DIRECTORY="/var/lib/mtr", LOGS_DIRECTORY="/var/log/mtr")[1] == (
        "ROS_HOME=/var/lib/mtr/ros ROS_LOG_DIR=/var/log/mtr LD_PRELOAD=")


@pytest.mark.parametrize("address, is_preloaded", [("127.0.0.1", True), ("10.0.0.1", False)])
def test_graph_on_loopback_has_its_library(robot, address, is_preloaded):
    (robot / "a" / "lib" / "libmtr_loopback.so").touch()
    assert started(robot, ROS_IP=address)[1].endswith("libmtr_loopback.so") is is_preloaded


def test_name_of_the_computer_opens_no_graph(robot):
    # Value of ROS_HOSTNAME left by a Jackal's own service, which has priority over ROS_IP in ROS.
    assert started(robot, ROS_IP="127.0.0.1", ROS_HOSTNAME="cpr-j100-0001")[2] == ""


def test_robot_waits_for_the_master_that_another_start_brings(robot):
    told = started(robot, MTR_MASTER="wait")
    assert told[0] == "The nodes start as soon as there is a ROS master at http://127.0.0.1:11311 (MTR_MASTER=wait)."
    assert told[1] == "--skip-log-check --wait mtr_bringup robot.launch"
    assert started(robot, MTR_MASTER="own")[0] == "--skip-log-check mtr_bringup robot.launch"
    refused = run(robot, MTR_MASTER="yes")
    assert refused.returncode == 1 and refused.stderr == "MTR_MASTER is yes; allowed are own and wait.\n"


def test_base_brings_the_master_and_waits_for_nobody(robot):
    told = started(robot, "base", MTR_MASTER="wait", MTR_ARGUMENTS="bind_address:=10.0.0.1",
                   MTR_BASE_ARGUMENTS="ekf:=false")
    assert told[0] == "--skip-log-check jackal_base.launch ekf:=false"


@pytest.mark.parametrize("words, launch", [((), "mtr_bringup robot.launch"), (("base",), "jackal_base.launch")])
def test_base_and_robot_have_the_description_of_the_persons_own(robot, words, launch):
    (robot / "etc").mkdir()
    own = robot / "etc" / "robot.urdf.xacro"
    own.touch()
    assert started(robot, *words)[0] == f"--skip-log-check {launch} robot_file:={own}"
    chosen = {"MTR_ARGUMENTS": "robot_file:=/a.urdf", "MTR_BASE_ARGUMENTS": "robot_file:=/a.urdf"}
    assert started(robot, *words, **chosen)[0] == f"--skip-log-check {launch} robot_file:=/a.urdf"


@pytest.mark.parametrize("words, environment, told", [
    ((), {"MTR_ARGUMENTS": "bind_address:=10.0.0.1 rear_lidr:=false"}, "robot.launch has no argument rear_lidr;"),
    ((), {"MTR_ARGUMENTS": "joy.device:=/dev/js1"}, "robot.launch has no argument joy.device;"),
    ((), {"MTR_ARGUMENTS": "lidr:=sick_lms111", "MTR_LAUNCH": "jackal.launch"}, "jackal.launch has no argument lidr;"),
    # Argument of the LiDAR's driver alone, which jackal.launch sets.
    ((), {"MTR_ARGUMENTS": "host:=10.0.0.2", "MTR_LAUNCH": "jackal.launch"}, "jackal.launch has no argument host;"),
    (("base",), {"MTR_BASE_ARGUMENTS": "efk:=false"}, "jackal_base.launch has no argument efk;")])
def test_argument_that_the_launch_file_does_not_know_is_refused(robot, words, environment, told):
    refused = run(robot, *words, **environment)
    assert refused.returncode == 1 and refused.stderr.startswith(told) and not refused.stdout


def test_launch_file_that_is_not_there_is_named(robot):
    refused = run(robot, MTR_LAUNCH="robt.launch", MTR_ARGUMENTS="bind_address:=10.0.0.1")
    assert refused.returncode == 1
    assert refused.stderr == "The launch file robt.launch cannot be read; correct its name in /etc/mtr/robot.env.\n"


def test_jackal_takes_the_arguments_of_robot_launch_that_it_passes_on(robot):
    environment = {"MTR_LAUNCH": "jackal.launch", "MTR_ARGUMENTS": "localization:=external front_host:=10.0.0.2"}
    assert started(robot, **environment)[0].endswith("jackal.launch localization:=external front_host:=10.0.0.2")


def test_base_of_another_launch_file_is_asked_for_its_arguments(robot):
    own = robot / "own.launch"
    own.write_text("<launch><arg default='x'\n name='port'/></launch>", encoding="ascii")
    assert started(robot, "base", MTR_BASE_LAUNCH=str(own), MTR_BASE_ARGUMENTS="port:=/dev/x")
    assert run(robot, "base", MTR_BASE_LAUNCH=str(own), MTR_BASE_ARGUMENTS="prt:=/dev/x").returncode == 1


def test_without_a_release_it_says_what_to_run(robot):
    (robot / "current").unlink()
    done = subprocess.run([robot / "start"], check=False, capture_output=True, text=True)
    assert done.returncode == 1 and "run setup/install-robot.sh of a checkout" in done.stderr


def test_shipped_settings_name_a_shipped_launch_file():
    settings = dict(line.split("=", 1) for line in (START.parent / "robot.env").read_text(encoding="utf-8").splitlines()
                    if line and not line.startswith("#"))
    assert (START.parents[2] / "launch" / "launch" / settings["MTR_LAUNCH"]).is_file()
