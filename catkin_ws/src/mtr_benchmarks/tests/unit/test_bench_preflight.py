"""The preflight reports the fault of a wrongly assembled robot within 5 s of simulated motion."""
# SPDX-License-Identifier: Apache-2.0
import json

import pytest

from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.preflight import verdicts
from mtr_benchmarks.preflight.__main__ import ALARMS, WRONG, main, report
from mtr_benchmarks.preflight.assemblies import ASSEMBLIES, RIGHT
from mtr_benchmarks.preflight.drive import drive_of, drives, record
from mtr_benchmarks.preflight.verdicts import Verdict, asks_for_more, counts, says, verdict_on
from mtr_motion_check.finding import bad, good, needs_more

# One drive with perfect LiDARs, one with bad LiDARs and a walking person.
DRIVES = {"lot": (4, False), "lot_person": (5, True)}


@pytest.fixture(scope="module", params=DRIVES)
def recording(request):
    seed, worst_lidar = DRIVES[request.param]
    return record(drive_of(request.param, seed, worst_lidar))


@pytest.mark.parametrize("name", ASSEMBLIES)
def test_what_is_wrong_is_named_and_nothing_else(recording, name):
    verdict = verdict_on(recording, ASSEMBLIES[name])
    assert verdict.is_right, verdict.said


def test_verdict_is_right_when_each_cause_and_nothing_else_is_told():
    findings = [good("a", "b", "x"), bad("a", "b", "the wheel is loose"), bad("a", "b", "the wheel is flat")]
    assert says(findings, ("flat", "loose")) and says(findings[:1], ())
    assert not says(findings, ("loose",)) and not says(findings, ("loose", "flat", "gone"))


def test_wrong_diagnosis_that_also_asks_for_more_is_wrong():
    more, flat = needs_more("motion", "Drive on."), bad("a", "b", "the wheel is flat")
    assert asks_for_more([more], ("flat",)) and asks_for_more([more, flat, good("a", "b", "x")], ("flat", "loose"))
    assert not asks_for_more([more, flat], ()) and not asks_for_more([more, flat], ("loose",))
    assert not asks_for_more([flat], ("flat",)) and not asks_for_more([more, flat, flat], ("flat",))


class Says:
    """Replaces the preflight's judge."""

    def __init__(self, *findings):
        self.found = findings

    def __call__(self, lidars):
        return self

    def findings(self, recording):
        return self.found


def test_alarm_on_a_right_robot_is_one_although_it_also_asks_for_more(recording, monkeypatch):
    more, swapped = needs_more("motion", "Drive on."), bad("a", "b", "Front and rear LiDAR are swapped.")
    monkeypatch.setattr(verdicts, "MotionJudge", Says(more, swapped))
    drive = drive_of("open", 2, False)
    judged = {drive: {name: verdict_on(recording, assembly) for name, assembly in ASSEMBLIES.items()}}
    found = {row.requirement: row.value for row in report(judged).rows}
    assert found[ALARMS] == 1.0 and found[WRONG] == (len(ASSEMBLIES) - 1) / len(ASSEMBLIES)
    monkeypatch.setattr(verdicts, "MotionJudge", Says(more))
    assert verdict_on(recording, ASSEMBLIES[RIGHT]).is_undecided


def test_counts_and_rows_tell_wrong_from_undecided():
    right, unsure, wrong, passed = (Verdict(True, False, ()), Verdict(False, True, ("more",)),
                                    Verdict(False, False, ("x",)), Verdict(False, False, ()))
    assert counts([right, unsure, wrong, passed]) == {"right": 1, "undecided": 1, "wrong": 2}
    lot, bare = drive_of("lot", 1, False), drive_of("open", 2, False)
    fine = {name: right for name in ASSEMBLIES}
    assert all_met(report({lot: fine, bare: {name: unsure for name in ASSEMBLIES}}).rows)
    assert not all_met(report({lot: {**fine, RIGHT: wrong}}).rows)
    assert not all_met(report({lot: {**fine, "IMU upside down": passed}}).rows)


def test_drives_differ_by_seed_only():
    first, again, other = drives(1, 3), drives(1, 3), drives(2, 3)
    assert first == again and first != other and len({drive.legs for drive in first}) == 3


def test_program_writes_its_file(tmp_path, capsys):
    assert main(["--drives", "1", "--out", str(tmp_path)]) == 0
    content = json.loads((tmp_path / "preflight.json").read_text(encoding="utf-8"))
    assert content["assemblies"][RIGHT] == {"right": 1, "undecided": 0, "wrong": 0}
    assert "right verdicts" in capsys.readouterr().out
