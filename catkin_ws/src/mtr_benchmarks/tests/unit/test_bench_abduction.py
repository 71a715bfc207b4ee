"""Abducted robots are evaluated only by their published poses, and none is left out."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest

from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.localization import __main__ as program
from mtr_benchmarks.localization import one_abduction, report
from mtr_benchmarks.localization.drives.pose_track import compose, pose_track
from mtr_benchmarks.localization.drives.record import DriveError
from mtr_benchmarks.localization.drives.selection import SCENES, abductions
from mtr_benchmarks.localization.judging import abduction
from mtr_benchmarks.localization.methods.key_track import KeyTrack, key_track
from mtr_benchmarks.localization.methods.outcome import THIS_SYSTEM
from mtr_benchmarks.localization.methods.this_system import NoMap, SystemFailure
from mtr_benchmarks.localization.one_drive import RECORDING, DriveResult, DriveTask
from mtr_benchmarks.localization.repeats import MAX_DRIVES
from mtr_core.se2 import Pose2

CARRIED_S = 4.0
SEGMENTS = [{"kind": "wander", "begin_s": 1.0},
            {"kind": "abduct", "begin_s": CARRIED_S, "distance_m": 3.0, "turn_rad": 0.5 * math.pi},
            {"kind": "abduct", "begin_s": CARRIED_S + 0.02}]
FAR_OFF, LOST, RIGHT = (2.0, 0.05, True), (5.0, 3.0, False), (0.01, 0.005, True)


def fate(course):
    """Return the result of a robot with (error, sigma, valid) from each of the times on, since it was carried away."""
    stamps = np.arange(0.0, 29.0, 0.02)
    rows = np.tile(RIGHT, (len(stamps), 1)).astype(float)
    for begin_s, state in course.items():
        rows[stamps > CARRIED_S + begin_s + 0.001] = state
    mode = np.full(len(stamps), 2.0)
    return abduction.fate(KeyTrack(stamps, rows[:, 0], rows[:, 1], rows[:, 2] > 0.5, mode), SEGMENTS)


def test_robot_that_finds_itself_again():
    found = fate({0.0: FAR_OFF, 0.8: LOST, 6.0: RIGHT})
    assert found.knew_before and found.first_wrong is None and found.wrong_s == 0.0
    assert (found.noticed_s, found.found_s) == pytest.approx((0.8, 6.0), abs=0.03)
    assert (found.after_10_s, found.jump_m) == (abduction.RIGHT, 3.0)
    assert found.turn_deg == pytest.approx(90.0)


def test_robot_that_stays_lost_is_never_wrong_and_not_found():
    found = fate({0.0: FAR_OFF, 1.9: LOST})
    assert (found.first_wrong, found.found_s, found.after_10_s) == (None, None, abduction.LOST)


def test_robot_that_is_wrong_at_2_s_is_wrong():
    found = fate({0.0: FAR_OFF, 2.1: LOST})
    assert found.first_wrong.at_s == pytest.approx(2.0, abs=0.03)
    assert found.wrong_s == pytest.approx(0.1, abs=0.03)


def test_robot_that_is_wrong_for_a_single_pose_late_is_wrong():
    found = fate({0.0: LOST, 20.0: (0.3, 0.05, True), 20.02: LOST})
    assert found.first_wrong == found.worst_wrong
    assert (found.first_wrong.error_m, found.first_wrong.sigma_m, found.first_wrong.mode) == (0.3, 0.05, 2)
    assert found.after_10_s == abduction.LOST


@pytest.mark.parametrize(("state", "is_wrong"), [
    ((0.099, 0.001, True), False), ((0.101, 0.001, True), True), ((0.101, 0.026, True), False),
    ((2.0, 0.49, True), True), ((2.0, 0.51, True), False), ((9.0, 0.01, False), False)])
def test_pose_is_wrong_beyond_10_cm_and_4_sigma(state, is_wrong):
    assert (fate({0.0: LOST, 5.0: state}).first_wrong is not None) == is_wrong


def test_pose_that_is_off_within_its_sigma_is_neither_right_nor_lost():
    found = fate({0.0: LOST, 5.0: (0.3, 0.2, True)})
    assert (found.after_10_s, found.found_s) == (abduction.UNSURE, None)
    assert abduction.figures([found]).settled == 0


def test_robot_that_falls_silent_is_neither_right_nor_lost():
    stamps, zeros = np.arange(0.0, CARRIED_S + 9.0, 0.02), np.zeros(650)
    assert abduction.fate(KeyTrack(stamps, zeros, zeros, zeros > 0.0, zeros), SEGMENTS).after_10_s == abduction.UNSURE


def test_worst_pose_is_told():
    found = fate({0.0: LOST, 5.0: FAR_OFF, 6.0: (4.0, 0.07, True), 7.0: LOST})
    assert (found.first_wrong.error_m, found.worst_wrong.error_m) == (2.0, 4.0)
    assert found.wrong_s == pytest.approx(2.0, abs=0.05)
    said = abduction.sentence(found)
    assert "Carried 3.00 m and turned by 90 deg; wrong and valid for 2.00 s" in said
    assert "by 4.00 m with 0.070 m in mode 2" in said


def test_wrong_way_that_crosses_the_right_one_is_not_found():
    assert fate({0.0: FAR_OFF, 5.0: RIGHT, 5.5: FAR_OFF}).found_s is None


def results(fates, failures=(), repeats=()):
    drives = abductions(len(fates) + len(failures))
    found = [DriveResult(drive, {}, {}, SEGMENTS, each, repeats) for drive, each in zip(drives, fates)]
    return found + [DriveResult(drive, {}, each, [], None) for drive, each in zip(drives[len(fates):], failures)]


def rows(found):
    return {row["name"]: row for row in report.abduction_report(found).document()["table"]}


GOOD = {0.0: FAR_OFF, 0.8: LOST, 6.0: RIGHT}


def test_robots_that_are_right_or_lost_meet_the_table():
    found = rows(results([fate(GOOD), fate({0.0: FAR_OFF, 1.0: LOST})]))
    assert found[abduction.WRONG.name]["value"] == 0 and found[abduction.SETTLED.name]["value"] == 1.0
    assert found[abduction.NOTICED.name]["value"] == 1.0 and found[abduction.FOUND.name]["value"] == 0.5
    assert found[abduction.FOUND_TIME.name]["value"] == pytest.approx(6.0, abs=0.03)
    assert found[abduction.VAGUE.name]["value"] == 0
    assert all(row["met"] for row in found.values())


def test_one_robot_that_was_lost_before_meets_nothing():
    found = report.abduction_report(results([fate(GOOD)] * 99 + [fate({-1.0: LOST, 0.0: LOST})]))
    assert not any(row.is_met for row in found.rows if row.requirement in (abduction.WRONG, abduction.SETTLED))
    assert found.rows[0].remark == "100 robots, lost before: 1"


def test_valid_poses_that_are_far_off_are_counted_whatever_their_sigma():
    found = rows(results([fate({0.0: state}) for state in ((6.0, 1.6, True), FAR_OFF, RIGHT, LOST)]))
    assert found[abduction.VAGUE.name]["value"] == 2
    assert (found[abduction.SETTLED.name]["value"], found[abduction.SETTLED.name]["met"]) == (0.5, False)


def test_one_wrong_robot_of_a_hundred_fails_the_table():
    found = rows(results([fate(GOOD)] * 99 + [fate({0.0: FAR_OFF, 2.1: LOST})]))
    assert (found[abduction.WRONG.name]["value"], found[abduction.WRONG.name]["met"]) == (1, False)
    assert found[abduction.SETTLED.name]["met"] is True
    assert found[abduction.NOTICED.name]["value"] == pytest.approx(0.99)


@pytest.mark.parametrize(("unsettled", "met"), [(1, True), (2, False)])
def test_nine_of_ten_have_to_be_right_or_lost_after_10_s(unsettled, met):
    off = fate({0.0: LOST, 5.0: (0.3, 0.2, True)})
    assert rows(results([fate(GOOD)] * (10 - unsettled) + [off] * unsettled))[abduction.SETTLED.name]["met"] is met


@pytest.mark.parametrize("method", [THIS_SYSTEM, RECORDING])
def test_failed_drive_meets_nothing(method):
    found = rows(results([fate(GOOD)], [{method: "It ended with 1."}]))
    assert not found[abduction.WRONG.name]["met"] and not found[abduction.SETTLED.name]["met"]
    assert found[abduction.WRONG.name]["failed_drives"] == 1


def test_no_robot_at_all_meets_nothing():
    found = rows([])
    assert found[abduction.WRONG.name]["value"] is None and not found[abduction.WRONG.name]["met"]
    assert not found[abduction.SETTLED.name]["met"]


def test_repeated_drives_and_wrong_robots_are_told():
    bad = fate({0.0: FAR_OFF, 2.1: LOST})
    found = report.abduction_report(results([bad], repeats=["lot_abduct_1: The robot touches car."]))
    assert found.rows[0].as_json()["repeated_drives"] == 1
    assert found.remarks[0].startswith("lot_abduct_1: Carried 3.00 m")
    assert found.remarks[1] == "Repeated: lot_abduct_1: The robot touches car."
    written = found.document()["abducted"]
    assert written["repeats"] == ["lot_abduct_1: The robot touches car."]
    assert written["robots"][0]["name"] == "lot_abduct_1" and written["robots"][0]["first_wrong"]["error_m"] == 2.0
    assert [written["scenes"][scene]["robots"] for scene in SCENES] == [1, 0, 0, 0]


def task(tmp_path, keep=False):
    return DriveTask(abductions(1)[0], tmp_path, tmp_path / "none", keep)


class Stage:
    """Replaces recording and replay; each drive gives the next of the results."""

    def __init__(self, monkeypatch, turns):
        self.turns, self.names = list(turns), []
        monkeypatch.setattr(one_abduction, "record", self.record)
        monkeypatch.setattr(one_abduction, "read_truth", lambda folder: None)
        monkeypatch.setattr(one_abduction, "run_key_track", self.track)
        monkeypatch.setattr(one_abduction, "fate", lambda given, segments: given)

    def record(self, options, folder):
        self.names.append(folder.name)
        folder.mkdir(parents=True)
        if isinstance(self.turns[0], DriveError):
            raise self.turns.pop(0)
        return {"segments": SEGMENTS}

    def track(self, folder, truth):
        turn = self.turns.pop(0)
        if isinstance(turn, Exception):
            raise turn
        return turn


def test_drive_that_proves_nothing_is_repeated_with_another_seed_and_told(monkeypatch, tmp_path):
    stage = Stage(monkeypatch, [DriveError("The robot touches car."), NoMap("There is no map."), fate(GOOD)])
    found = one_abduction.run_abduction(task(tmp_path))
    assert stage.names == ["lot_abduct_1", "lot_abduct_100001", "lot_abduct_200001"]
    assert found.drive.name == "lot_abduct_200001" and found.fate == fate(GOOD) and not found.failures
    assert found.repeats == ["lot_abduct_1: The robot touches car.", "lot_abduct_100001: There is no map."]
    assert not list(tmp_path.iterdir())


def test_drive_that_never_proves_anything_fails(monkeypatch, tmp_path):
    Stage(monkeypatch, [NoMap("There is no map.")] * MAX_DRIVES)
    found = one_abduction.run_abduction(task(tmp_path))
    assert found.fate is None and len(found.repeats) == MAX_DRIVES
    assert found.failures[RECORDING].startswith("5 drives gave nothing.")


def test_program_that_fails_is_not_repeated(monkeypatch, tmp_path):
    stage = Stage(monkeypatch, [SystemFailure("replay_bag ended with -11"), fate(GOOD)])
    found = one_abduction.run_abduction(task(tmp_path))
    assert found.failures == {THIS_SYSTEM: "replay_bag ended with -11"} and len(stage.names) == 1


@pytest.mark.parametrize(("course", "kept"), [(GOOD, []), ({0.0: FAR_OFF, 2.1: LOST}, ["lot_abduct_1"])])
def test_only_recordings_of_wrong_robots_are_kept(monkeypatch, tmp_path, course, kept):
    Stage(monkeypatch, [fate(course)])
    one_abduction.run_abduction(task(tmp_path, keep=True))
    assert [each.name for each in tmp_path.iterdir()] == kept


STAMPS = np.arange(0.0, 20.0, 0.02)
MAP_FROM_CAR = Pose2(-3.0, 1.5, 0.7)


def circle():
    """Return poses around the Car."""
    angles = STAMPS / 20.0 * 2.0 * math.pi
    return np.stack([4.0 * np.cos(angles), 3.0 * np.sin(angles), angles + math.pi / 2.0], axis=1)


def tracked(poses_in_map, covariance):
    """Return the key track of a system with right key frames."""
    true = pose_track(STAMPS, circle())
    track = pose_track(STAMPS, poses_in_map, np.tile(covariance, (len(STAMPS), 1, 1)), np.ones(len(STAMPS)) > 0.0)
    frames = pose_track(STAMPS[::25], compose(MAP_FROM_CAR, circle())[::25])
    return key_track(track, frames, true, np.zeros(len(STAMPS)))


def test_right_track_has_no_error_wherever_its_map_begins():
    assert np.max(tracked(compose(MAP_FROM_CAR, circle()), np.eye(3)).error_m) < 1e-9


def test_sigma_is_the_key_s_in_the_direction_of_its_error():
    off = tracked(compose(MAP_FROM_CAR, circle()) + (0.3, 0.0, 0.0), np.diag((0.04, 0.25, 0.0)))
    assert off.error_m == pytest.approx(0.3) and off.sigma_m == pytest.approx(0.2)
    aside = tracked(compose(MAP_FROM_CAR, circle()) + (0.0, 0.3, 0.0), np.diag((0.04, 0.25, 0.0)))
    assert aside.sigma_m == pytest.approx(0.5)


def test_uncertain_heading_counts_by_the_key_s_lever():
    turned = tracked(compose(MAP_FROM_CAR, circle()) + (0.0, 0.0, 0.02), np.diag((0.0, 0.0, 0.1**2)))
    assert turned.sigma_m == pytest.approx(0.25 * 0.1, rel=0.01)


def test_pose_between_the_truth_s_stamps_is_not_smeared_by_the_robot_s_own_jump():
    """The estimate jumps at one instant; interpolating it would give a mean of before and after."""
    poses = compose(MAP_FROM_CAR, circle())
    poses[500:] += (3.0, 0.0, 0.0)
    found = tracked(poses, np.eye(3))
    assert found.error_m[499] < 1e-9 and found.error_m[500] == pytest.approx(3.0)


def chosen(arguments):
    return [each.name for each in program.selected(program.command_line().parse_args(arguments))]


def test_command_line_chooses_how_many_are_carried_away():
    assert len(chosen(["--kidnappings-only"])) == 50 * len(SCENES)
    assert len(chosen(["--kidnappings-only", "--quick"])) == 2 * len(SCENES)
    assert chosen(["--kidnappings-only", "--kidnappings", "1", "--kidnap-seed", "9"]) == [
        f"{scene}_abduct_9" for scene in SCENES]
    assert sum("_abduct_" in name for name in chosen(["--kidnappings", "3"])) == 3 * len(SCENES)
    assert "lot_plain_1" in chosen([])


def test_no_robot_is_refused(capsys):
    with pytest.raises(SystemExit):
        program.main(["--kidnappings", "0"])
    assert "--kidnappings is 0; at least 1 robot is carried away." in capsys.readouterr().err


def test_only_kidnappings_need_no_other_program_and_have_a_file_of_their_own(monkeypatch, tmp_path):
    monkeypatch.setattr(program, "run_all", lambda tasks, jobs: results([fate(GOOD)] * len(tasks)))
    files = ["--out", str(tmp_path), "--mrpt", str(tmp_path / "none")]
    assert program.main(["--kidnappings-only", "--quick", *files]) == 0
    assert [each.name for each in tmp_path.iterdir()] == ["abductions.json"]
    with pytest.raises(SystemExit):
        program.main(["--quick", *files])


def test_whole_benchmark_fails_with_a_wrong_robot():
    wrong = results([replace(fate(GOOD), first_wrong=abduction.WrongPose(3.0, 1.0, 0.1, 2))])
    found = report.report(wrong, None)
    assert not all_met([row for row in found.rows if row.requirement is abduction.WRONG])
    assert found.document()["abducted"]["all"]["wrong"] == 1 and found.document()["drives"] == []
