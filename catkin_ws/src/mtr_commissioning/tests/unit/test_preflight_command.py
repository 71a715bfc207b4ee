"""Preflight program: options, exit status, file; without a ROS master."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib

import pytest

from mtr_commissioning.base_contract.command_line import main as base_contract
from mtr_commissioning.calibration.command_line import main as calibrate
from mtr_commissioning.preflight import command_line
from mtr_commissioning.preflight.expected import Setup
from mtr_commissioning.preflight.records import RobotRecord
from mtr_commissioning.preflight.report import standing_findings, write
from mtr_core import names
from mtr_description.shipped import shipped_base, shipped_geometry
from mtr_dispatcher.preflight_report import report_in
from mtr_motion_check.finding import bad, exit_code, good
from mtr_recording.command_line import record


def test_without_a_master_there_is_one_sentence_and_status_2(monkeypatch, capsys):
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:1")
    assert command_line.main([]) == 2
    output = capsys.readouterr()
    assert output.out == "" and output.err == (
        "There is no ROS master at http://127.0.0.1:1; start the robot first (roslaunch mtr_bringup robot.launch).\n")


@pytest.mark.parametrize("start", [
    lambda: command_line.main([]), lambda: record(["--out", "/tmp"]), lambda: calibrate(["lever"]),
    lambda: base_contract([])])
def test_program_in_a_shell_that_says_no_address_does_not_open_the_robots_graph(start, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    monkeypatch.setenv("ROS_IP", "")
    monkeypatch.delenv("ROS_HOSTNAME", raising=False)
    assert start() != 0 and os.environ["ROS_IP"] == "127.0.0.1"


@pytest.mark.parametrize("seconds", ["1", "61", "nan", "x"])
def test_seconds_out_of_range_are_refused(seconds, capsys):
    with pytest.raises(SystemExit) as refused:
        command_line.parsed(["--seconds", seconds])
    assert refused.value.code == 2 and "--seconds" in capsys.readouterr().err


def test_line_and_exit_status_follow_from_the_findings():
    fine, wrong = good("a.b", "disk", "Fine."), bad("a.b", "disk", "Full.", 0.1, 1.0, unit="GB")
    assert [fine.line(), wrong.line()] == ["ok  disk: Fine.", "BAD disk: Full."]
    assert (exit_code([]), exit_code([fine]), exit_code([fine, wrong])) == (0, 0, 1)


def test_file_has_all_findings(tmp_path):
    write([good("a.b", "disk", "Fine."), bad("c.d", "x", "Wrong.", 2.0, 1.0, unit="m")], tmp_path / "f.json")
    content = json.loads((tmp_path / "f.json").read_text(encoding="utf-8"))
    assert content["version"] == 1 and content["ok"] is False
    assert content["findings"][1] == {"check": "c.d", "subject": "x", "bad": True, "text": "Wrong.", "value": 2.0,
                                      "limit": 1.0, "unit": "m"}


def test_file_that_cannot_be_written_is_a_sentence(tmp_path, capsys):
    assert command_line.saved([], tmp_path / "f.json") and command_line.saved([], None)
    assert not command_line.saved([], tmp_path / "none" / "f.json")
    assert "cannot be written" in capsys.readouterr().err


def test_robot_that_does_not_run_is_bad_in_every_topic():
    findings = standing_findings(RobotRecord(), Setup(), shipped_geometry(), shipped_base())
    assert sum(finding.is_bad for finding in findings) == 9
    assert all(finding.text.endswith(".") for finding in findings)


def test_findings_are_left_with_the_master_for_the_operator(monkeypatch):
    master = {}
    monkeypatch.setattr(command_line.rospy, "set_param", master.__setitem__)
    monkeypatch.setattr(command_line.clock, "steady_ns", lambda: 90_000_000_000)
    findings = [good("a.b", "imu", "Fine."), bad("c.d", "disk", "Full.", 0.1, 1.0, unit="GB")]
    command_line.leave(names.PREFLIGHT_REPORT, findings)
    report = report_in(master[names.PREFLIGHT_REPORT])
    assert report.made_s == pytest.approx(90.0) and (report.checks, report.bad) == (2, 1)
    assert report.items == (("disk", True, "Full."), ("imu", False, "Fine."))


def test_master_that_does_not_take_them_is_a_sentence(monkeypatch, capsys):
    def refuse(*_):
        raise ConnectionRefusedError("gone")
    monkeypatch.setattr(command_line.rospy, "set_param", refuse)
    command_line.leave(names.PREFLIGHT_REPORT, [])
    assert capsys.readouterr().err.startswith("The Operator's application will not show this")


def test_disk_of_the_robots_folders_is_looked_at_beside_that_of_the_home(monkeypatch):
    looked = []
    monkeypatch.setattr(command_line, "machine_findings", lambda machine: looked.extend(machine.folders) or [])
    monkeypatch.setattr(command_line, "said_by", lambda _: None)
    command_line.computer_findings("http://127.0.0.1:11311", Setup(written_folders=("/var/log/mtr",)))
    assert looked == [pathlib.Path.home(), pathlib.Path("/var/log/mtr")]


def test_program_that_is_not_there_is_none():
    assert command_line.said_by(["mtr-no-such-program"]) is None
    assert command_line.said_by(["echo", "heard"]) == "heard\n"


def test_program_that_does_not_answer_says_nothing(monkeypatch):
    monkeypatch.setattr(command_line, "PROGRAM_TIMEOUT_S", 0.05)
    assert command_line.said_by(["cat", "/dev/zero"]) == ""


class Heard:
    """Record of a stationary robot without faults."""

    names = {}

    def listen(self, *_):
        return None


@pytest.fixture
def preflight(monkeypatch):
    """preflight(*options, in_motion=...) checks a robot with one master; returns the report for the Operator."""
    master, now_s = {}, [1000.0]
    monkeypatch.setattr(command_line.rospy, "set_param", master.__setitem__)
    monkeypatch.setattr(command_line.rospy, "get_param", master.get)
    monkeypatch.setattr(command_line.rospy, "init_node", lambda *_, **__: None)
    monkeypatch.setattr(command_line.clock, "steady_ns", lambda: round(1e9 * now_s[0]))
    for name, made in {"master_answers": lambda: True, "setup_of_robot": Setup, "computer_findings": list,
                       "described_robot": lambda: None, "Listener": Heard, "standing_findings": list}.items():
        monkeypatch.setattr(command_line, name, lambda *_, made=made: made())

    def run(*options, in_motion=(), later_s=60.0):
        now_s[0] += later_s
        monkeypatch.setattr(command_line, "motion_findings", lambda *_: list(in_motion))
        status = command_line.main(list(options))
        report = report_in(master[names.PREFLIGHT_REPORT])
        assert status == int(report.bad > 0)
        return report
    return run


SWAPPED = bad("motion.swap", "/front/scan", "The LiDARs are swapped.")


def test_what_was_found_in_motion_stays_red_until_somebody_drives_again(preflight):
    assert preflight("--drive", in_motion=[SWAPPED]).bad == 1
    standing = preflight(later_s=300.0)
    assert standing.bad == 1
    assert standing.items[0] == ("/front/scan", True, "The LiDARs are swapped. (In motion, 5 min ago.)")
    assert preflight("--drive", in_motion=[good("motion.swap", "/front/scan", "It is ahead.")]).bad == 0
    assert preflight(later_s=7200.0).items == (("/front/scan", False, "It is ahead. (In motion, 2 h ago.)"),)


def test_robot_that_was_never_compared_in_motion_says_so_and_is_good(preflight):
    assert preflight().items == (("motion", False, "Nothing was compared in motion yet; preflight --drive does it."),)


def test_motion_of_another_run_of_a_simulated_clock_does_not_count(preflight):
    preflight("--drive", in_motion=[SWAPPED], later_s=9000.0)
    assert preflight(later_s=-9500.0).bad == 0
