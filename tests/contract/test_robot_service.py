"""The robot's service is sandboxed, bounded and started again, and its ROS graph is closed; docs/security.md."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys

import pytest

TOP = pathlib.Path(__file__).resolve().parents[2]
UNIT = TOP / "setup" / "robot" / "mtr-robot.service"
BASE = UNIT.with_name("mtr-base.service")
# Both have it.
COMMON = UNIT.with_name("mtr-service.conf")
BOUND = pathlib.Path(__file__).with_name("address_families.py")
# What the unit must say at least, see systemd.exec(5); an empty value takes everything away.
MUST = {
    "User": "mtr", "NoNewPrivileges": "yes", "CapabilityBoundingSet": "", "AmbientCapabilities": "",
    "RestrictAddressFamilies": "AF_UNIX AF_INET AF_INET6 AF_NETLINK", "ProtectSystem": "strict", "ProtectHome": "yes",
    "PrivateTmp": "yes", "ProtectKernelTunables": "yes", "ProtectKernelModules": "yes", "ProtectControlGroups": "yes",
    "RestrictNamespaces": "yes", "RestrictSUIDSGID": "yes", "LockPersonality": "yes", "DevicePolicy": "closed",
    "SystemCallFilter": "@system-service", "SystemCallArchitectures": "native", "UMask": "0077", "MemoryMax": "2G",
    "TasksMax": "512", "Restart": "always"}


def settings(unit=UNIT):
    """Lines of the section Service, by their names; a name that is there twice has all its values."""
    found, section = {}, ""
    for line in (unit.read_text(encoding="utf-8") + COMMON.read_text(encoding="utf-8")).splitlines():
        if line.startswith("["):
            section = line
        elif section == "[Service]" and line and not line.startswith("#"):
            name, _, value = line.partition("=")
            found.setdefault(name, []).append(value)
    return found


@pytest.mark.parametrize("unit", [UNIT, BASE], ids=lambda unit: unit.stem)
@pytest.mark.parametrize("name", MUST)
def test_service_keeps_its_bound(name, unit):
    assert settings(unit).get(name) == [MUST[name]]


def test_robot_and_base_start_by_the_same_program_and_the_robot_anew_with_its_master():
    assert settings(BASE)["ExecStart"] == ["/opt/mtr/start base"]
    lines = UNIT.read_text(encoding="utf-8").splitlines()
    assert "PartOf=mtr-base.service" in lines
    assert any(line.startswith("After=") and "mtr-base.service" in line for line in lines)
    # Both open the serial line of the MCU.
    assert "Conflicts=ros.service" in BASE.read_text(encoding="utf-8").splitlines()


def test_robot_s_programs_come_before_others_as_a_group():
    # Among sessions, of which each node has one, Linux does not look at Nice.
    assert settings()["Slice"] == ["mtr.slice"]
    lines = UNIT.with_name("mtr.slice").read_text(encoding="utf-8").splitlines()
    assert lines.index("[Slice]") < lines.index("CPUWeight=1000")


def test_end_of_one_service_takes_no_folder_from_the_other():
    # systemd removes a RuntimeDirectory at the end of each unit that names it; the folders of the others stay.
    assert "RuntimeDirectory" not in settings()


def test_service_reaches_serial_lines_and_the_game_controller_and_no_other_device():
    assert {value.split()[0] for value in settings()["DeviceAllow"]} == {"char-ttyACM", "char-ttyUSB", "char-input"}


def test_service_ends_as_by_ctrl_c_so_that_drive_control_brakes_and_runs_what_closes_the_graph():
    assert settings()["KillSignal"] == ["SIGINT"] and int(settings()["TimeoutStopSec"][0]) >= 10
    assert settings()["ExecStart"] == ["/opt/mtr/start"]
    start = (UNIT.parent / "start").read_text(encoding="utf-8")
    assert "LD_PRELOAD=$PWD/current/lib/libmtr_loopback.so" in start
    assert "ROS_IP=127.0.0.1" in (UNIT.parent / "robot.env").read_text(encoding="utf-8").splitlines()


def run_bounded(command, **settings_of_process):
    """Exit status and output of a command under the unit's address families."""
    bound = [sys.executable, BOUND, settings()["RestrictAddressFamilies"][0]]
    with subprocess.Popen([*bound, *command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **settings_of_process) as process:
        try:
            output, _ = process.communicate(timeout=50)
        finally:
            # As systemd does it; roslaunch ends what it has started.
            process.send_signal(signal.SIGINT)
    return process.returncode, output


def test_the_bound_of_this_test_refuses_other_families():
    _, output = run_bounded([sys.executable, "-c", "import socket; socket.socket(socket.AF_PACKET, socket.SOCK_RAW)"])
    assert "Address family not supported by protocol" in output


@pytest.mark.parametrize("what", [
    # roslaunch asks so whether a computer is this one, also where it is named by ROS_IP.
    "import rosgraph.network; assert '127.0.0.1' in rosgraph.network.get_local_addresses()",
    "import socket; socket.create_server(('127.0.0.1', 0))",
    "import socket; socket.socket(socket.AF_UNIX).close()"])
def test_service_may_open_what_ros_needs(what):
    status, output = run_bounded([sys.executable, "-c", what])
    assert status == 0, output


PACKAGE = {
    "package.xml": "<package><name>mtr_bringup</name></package>",
    "robot.launch": '<launch><param name="asked" value="17"/>'
                    '<node pkg="mtr_bringup" type="node" name="answer" output="screen" required="true"/></launch>',
    "node": "#!/usr/bin/env python3\nimport rospy\nrospy.init_node('x')\nprint('answer', rospy.get_param('/asked'))\n"}


def test_service_starts_a_master_and_nodes_within_its_bounds(tmp_path):
    package, release = tmp_path / "mtr_bringup", tmp_path / "current"
    package.mkdir()
    release.mkdir()
    for name, text in PACKAGE.items():
        (package / name).write_text(text, encoding="ascii")
    (package / "node").chmod(0o755)
    # Where the workspace of the tests is, there is a launch file of the same name.
    (release / "setup.bash").write_text("unset CMAKE_PREFIX_PATH\n"
                                        f'export ROS_PACKAGE_PATH="{tmp_path}:$ROS_PACKAGE_PATH"\n', encoding="ascii")
    shutil.copy(UNIT.parent / "start", tmp_path)
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("MTR_")}
    environment.update(ROS_IP="127.0.0.1", ROS_MASTER_URI=f"http://127.0.0.1:{port}", HOME=str(tmp_path))
    _, output = run_bounded([tmp_path / "start"], env=environment)
    assert "answer 17" in output, output
