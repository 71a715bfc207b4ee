"""Disk, temperature, memory and the level of a Wi-Fi connection, from files as Linux writes them."""
# SPDX-License-Identifier: Apache-2.0
import pathlib

import pytest

from mtr_commissioning.preflight.machine import (
    Machine,
    disk_finding,
    machine_findings,
    memory_finding,
    temperature_finding,
)

WIRELESS = """Inter-| sta-|   Quality        |   Discarded packets               | Missed | WE
 face | tus | link level noise |  nwid  crypt   frag  retry   misc | beacon | 22
{rows}"""


def machine(root, total=100e9, free=50e9):
    """Return a computer with these files and this disk."""
    return Machine(root, [pathlib.Path("/home")], lambda path: (int(total), int(total - free), int(free)))


def write(root, name, text):
    (root / name).parent.mkdir(parents=True, exist_ok=True)
    (root / name).write_text(text, encoding="ascii")


@pytest.mark.parametrize("total, free, is_bad", [
    (100e9, 5.1e9, False), (100e9, 4.9e9, True), (10e9, 1.1e9, False), (10e9, 0.9e9, True), (10e9, 0.0, True)])
def test_disk_needs_a_gigabyte_and_a_twentieth(tmp_path, total, free, is_bad):
    assert disk_finding(machine(tmp_path, total, free)).is_bad is is_bad


@pytest.mark.parametrize("free, told", [
    ({"/home": 50e9, "/var": 0.9e9}, (True, "/var/log/robot")), ({"/home": 0.9e9, "/var": 50e9}, (True, "/home")),
    ({"/home": 50e9, "/var": 40e9}, (False, "/var/log/robot")),
    ({"/home": 0.5e9, "/var": 0.4e9}, (True, "/var/log/robot"))])
def test_disk_of_the_robots_logs_counts_like_that_of_the_home(tmp_path, free, told):
    def usage(path):
        if str(path) not in free:
            raise FileNotFoundError(path)
        return int(60e9), 0, int(free[str(path)])
    finding = disk_finding(Machine(tmp_path, [pathlib.Path("/home"), pathlib.Path("/var/log/robot")], usage))
    assert finding.is_bad is told[0] and f"free on {told[1]}" in finding.text


def test_disk_that_tells_nothing_is_bad(tmp_path):
    def usage(path):
        raise OSError(5, "Input/output error")
    finding = disk_finding(Machine(tmp_path, [pathlib.Path("/home")], usage))
    assert finding.is_bad and "look at the disk" in finding.text


def test_masters_are_told_by_the_command_lines_of_ros(tmp_path):
    for number, words in ((10, "/usr/bin/python3 /usr/bin/rosmaster --core -p 11311 -w 3 __log:=/tmp/master.log"),
                          (11, "/usr/bin/python3 -u /opt/ros/noetic/bin/rosmaster --core"),
                          (12, "python3 /usr/bin/rosmaster --core --port 11312"),
                          (13, "vim rosmaster"), (14, "roslaunch --core -p 1 rosmaster"), (15, "")):
        write(tmp_path, f"proc/{number}/cmdline", words.replace(" ", "\0") + "\0")
    (tmp_path / "proc" / "16").mkdir()
    assert machine(tmp_path).ros_master_ports() == [11311, 11312]


@pytest.mark.parametrize("zones, is_bad", [(("45000", "84900"), False), (("45000", "85100"), True), (("x",), False),
                                           ((), False)])
def test_hottest_zone_counts(tmp_path, zones, is_bad):
    for index, text in enumerate(zones):
        write(tmp_path, f"sys/class/thermal/thermal_zone{index}/temp", f"{text}\n")
    assert temperature_finding(machine(tmp_path)).is_bad is is_bad


@pytest.mark.parametrize("kilobytes, is_bad", [(400_000, False), (200_000, True)])
def test_little_memory_is_bad(tmp_path, kilobytes, is_bad):
    write(tmp_path, "proc/meminfo", f"MemTotal: 8000000 kB\nMemFree: 1 kB\nMemAvailable:  {kilobytes} kB\n")
    assert memory_finding(machine(tmp_path)).is_bad is is_bad


@pytest.mark.parametrize("level, found", [("-56.", ("wlan0", -56.0)), ("-256", None), ("0", None)])
def test_level_of_a_connection(tmp_path, level, found):
    # An interface that is an access point has a row of zeros.
    write(tmp_path, "proc/net/wireless", WIRELESS.format(
        rows=f" wlan0: 0000   54.  {level}  -256        0      0      0      0      0        0\n"))
    assert machine(tmp_path).signal_dbm() == found


def test_computer_that_tells_nothing_is_not_bad(tmp_path):
    assert not any(finding.is_bad for finding in machine_findings(machine(tmp_path)))
