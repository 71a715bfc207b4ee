"""The robot's service is sandboxed, bounded and started again, and its ROS graph is closed; docs/security.md."""
# SPDX-License-Identifier: Apache-2.0
import pathlib

import pytest

TOP = pathlib.Path(__file__).resolve().parents[2]
UNIT = TOP / "setup" / "robot" / "mtr-robot.service"
# What the unit must say at least, see systemd.exec(5); an empty value takes everything away.
MUST = {
    "User": "mtr", "NoNewPrivileges": "yes", "CapabilityBoundingSet": "", "AmbientCapabilities": "",
    "RestrictAddressFamilies": "AF_UNIX AF_INET AF_INET6", "ProtectSystem": "strict", "ProtectHome": "yes",
    "PrivateTmp": "yes", "ProtectKernelTunables": "yes", "ProtectKernelModules": "yes", "ProtectControlGroups": "yes",
    "RestrictNamespaces": "yes", "RestrictSUIDSGID": "yes", "LockPersonality": "yes", "DevicePolicy": "closed",
    "SystemCallFilter": "@system-service", "SystemCallArchitectures": "native", "UMask": "0077", "MemoryMax": "2G",
    "TasksMax": "512", "Restart": "always"}


def settings():
    """Lines of the section Service, by their names; a name that is there twice has all its values."""
    found, section = {}, ""
    for line in UNIT.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            section = line
        elif section == "[Service]" and line and not line.startswith("#"):
            name, _, value = line.partition("=")
            found.setdefault(name, []).append(value)
    return found


@pytest.mark.parametrize("name", MUST)
def test_service_keeps_its_bound(name):
    assert settings().get(name) == [MUST[name]]


def test_service_reaches_serial_lines_and_the_game_controller_and_no_other_device():
    assert {value.split()[0] for value in settings()["DeviceAllow"]} == {"char-ttyACM", "char-ttyUSB", "char-input"}


def test_service_ends_as_by_ctrl_c_so_that_drive_control_brakes_and_runs_what_closes_the_graph():
    assert settings()["KillSignal"] == ["SIGINT"] and int(settings()["TimeoutStopSec"][0]) >= 10
    assert settings()["ExecStart"] == ["/opt/mtr/start"]
    start = (UNIT.parent / "start").read_text(encoding="utf-8")
    assert "LD_PRELOAD=$PWD/current/lib/libmtr_loopback.so" in start
    assert "ROS_IP=127.0.0.1" in (UNIT.parent / "robot.env").read_text(encoding="utf-8").splitlines()
