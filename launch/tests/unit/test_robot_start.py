"""The start of the robot's service: which launch file, with which arguments, of which release."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import shutil
import subprocess

import pytest

START = pathlib.Path(__file__).resolve().parents[3] / "setup" / "robot" / "start"
ROSLAUNCH = '#!/bin/sh\necho "$@"\necho "ROS_HOME=$ROS_HOME ROS_LOG_DIR=$ROS_LOG_DIR LD_PRELOAD=$LD_PRELOAD"\n'


@pytest.fixture
def robot(tmp_path):
    """The folder of releases, one of them in use; roslaunch only says what it was told."""
    release = tmp_path / "a"
    (release / "lib").mkdir(parents=True)
    (release / "roslaunch").write_text(ROSLAUNCH, encoding="ascii")
    (release / "roslaunch").chmod(0o755)
    (release / "setup.bash").write_text(f'export PATH="{release}:$PATH"\n', encoding="ascii")
    (tmp_path / "current").symlink_to("a")
    shutil.copy(START, tmp_path / "start")
    return tmp_path


def started(robot, **environment):
    """The start's output by lines."""
    done = subprocess.run([robot / "start"], check=True, capture_output=True, text=True,
                          env={"PATH": "/usr/bin:/bin", "HOME": "/home/x", **environment})
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


def test_without_a_release_it_says_what_to_run(robot):
    (robot / "current").unlink()
    done = subprocess.run([robot / "start"], check=False, capture_output=True, text=True)
    assert done.returncode == 1 and "run setup/install-robot.sh of a checkout" in done.stderr


def test_shipped_settings_name_a_shipped_launch_file():
    settings = dict(line.split("=", 1) for line in (START.parent / "robot.env").read_text(encoding="utf-8").splitlines()
                    if line and not line.startswith("#"))
    assert (START.parents[2] / "launch" / "launch" / settings["MTR_LAUNCH"]).is_file()
