"""Guided calibration: plausible and implausible readings, the guides with a scripted person, the record."""
# SPDX-License-Identifier: Apache-2.0
import datetime
import itertools
import math
import random
from dataclasses import replace

import pytest

from mtr_commissioning.calibration import command_line
from mtr_commissioning.calibration.console import Console
from mtr_commissioning.calibration.guides import GUIDES
from mtr_commissioning.calibration.lever import lever_of, spread_of
from mtr_commissioning.calibration.lift import height_error
from mtr_commissioning.calibration.mast import Reading, lean_of
from mtr_commissioning.calibration.odometer import GyroTurn, mean_pose, way_between
from mtr_commissioning.calibration.press import Press, need_of
from mtr_commissioning.calibration.readings import Estimate, ReadingsUnusable, mean_of
from mtr_commissioning.calibration.record import DESIGN_TERMS, Check, Origin, overdue, updated
from mtr_commissioning.calibration.record_file import load, save
from mtr_commissioning.calibration.scales import scale_of
from mtr_core.se2 import Pose2
from mtr_description.mounts import KeyMount

TODAY = datetime.date(2026, 11, 23)
ORIGIN = Origin("MTR-1", "J. Nov\u00e1k", 0.25)
KEY = (0.262, -0.011)


def places(count=8, noise_m=0.0, seed=1, turn_rad=2.0 * math.pi):
    """Return poses at which the key touches a line at (3, -2)."""
    draw = random.Random(seed)
    for number in range(count):
        heading = number * turn_rad / count
        x, y = Pose2(0.0, 0.0, heading).apply(*KEY)
        yield Pose2(3.0 - x + draw.gauss(0.0, noise_m), -2.0 - y + draw.gauss(0.0, noise_m), heading)


def test_lever_is_found_whatever_the_line():
    found = lever_of(list(places()))
    assert (found.ahead.value, found.left.value) == pytest.approx(KEY, abs=1e-9)
    assert found.ahead.freedom == 12


def test_lever_is_as_far_off_as_its_sigma_says():
    found = [lever_of(list(places(noise_m=0.003, seed=seed))) for seed in range(200)]
    squares = [((each.ahead.value - KEY[0]) / each.ahead.sigma) ** 2 for each in found]
    # Student's t with 12 degrees of freedom has a variance of 1.2.
    assert sum(squares) / len(squares) == pytest.approx(1.2, abs=0.3)


@pytest.mark.parametrize("wrong, words", [
    (places(3), "at 3 headings; at least 4"), (places(6, turn_rad=1.5), "cover 72 degrees; at least 120"),
    (places(8, noise_m=0.05), "contradict each other")])
def test_foolish_places_are_refused(wrong, words):
    with pytest.raises(ReadingsUnusable, match=words):
        lever_of(list(wrong))


def test_spread_of_headings_counts_over_the_full_turn():
    assert spread_of([3.0, -3.0]) == pytest.approx(2.0 * math.pi - 6.0)


def reading(lean_deg):
    return Reading(0.4, 0.010, 1.2, 0.010 + 0.8 * math.tan(math.radians(lean_deg)))


def test_lean_of_mast_and_slope_of_floor_are_told_apart():
    lean, floor = lean_of([(reading(0.5), reading(0.1)), (reading(0.52), reading(0.12))])
    assert (lean.value, floor.value) == pytest.approx((0.31, 0.2), abs=1e-3)
    assert lean.sigma >= math.degrees(0.001 / 0.8) / math.sqrt(12.0)


@pytest.mark.parametrize("pairs, words", [
    ([(reading(0.5), reading(0.1))], "1 reading; at least 2"),
    ([(Reading(0.4, 0.0, 0.5, 0.0), reading(0.1))] * 2, "rose by 0.10 m")])
def test_too_few_or_short_readings_of_the_mast_are_refused(pairs, words):
    with pytest.raises(ReadingsUnusable, match=words):
        lean_of(pairs)


def test_scale_of_ways_out_and_back():
    found = scale_of([(9.97, 10.0), (-9.98, -10.0), (9.98, 10.0), (-9.97, -10.0)], 2.0, "m")
    assert found.value == pytest.approx(1.0025, abs=1e-4) and 1e-4 < found.sigma < 1e-3


@pytest.mark.parametrize("pairs, words", [
    ([(1.0, 1.0), (-1.0, -1.0)], "at least 2 m"), ([(-10.0, 10.0), (10.0, -10.0)], "its sign is wrong"),
    ([(10.0, 10.0), (10.0, 10.0)], "one direction"), ([(0.0, 10.0), (0.0, -10.0)], "silent")])
def test_ways_that_tell_nothing_are_refused(pairs, words):
    with pytest.raises(ReadingsUnusable, match=words):
        scale_of(pairs, 2.0, "m")


def test_height_error_has_offset_and_scale():
    found = height_error([(0.4, 0.412), (0.8, 0.816), (1.2, 1.220)])
    assert (found.middle.value, found.scale, found.largest_m) == pytest.approx((0.016, 1.01, 0.020))


@pytest.mark.parametrize("pairs, words", [([(0.4, 0.4), (0.9, 0.9)], "2 heights"),
                                          ([(0.4, 0.4), (0.45, 0.45), (0.5, 0.5)], "0.10 m apart")])
def test_too_few_heights_are_refused(pairs, words):
    with pytest.raises(ReadingsUnusable, match=words):
        height_error(pairs)


def test_need_of_a_press_lies_between_what_failed_and_what_worked():
    need = need_of([Press(0.2, 3.0, False), Press(0.3, 5.0, True), Press(0.5, 9.0, True)])
    assert (need.force.value, need.strength) == pytest.approx((4.0, 0.375))
    assert need.force.sigma == pytest.approx(1.0 / math.sqrt(3.0))


@pytest.mark.parametrize("presses, words", [
    ([Press(0.3, 5.0, True)], "1 presses worked and 0"),
    ([Press(0.3, 5.0, True), Press(0.5, 9.0, False)], "sits loosely")])
def test_presses_that_contradict_each_other_are_refused(presses, words):
    with pytest.raises(ReadingsUnusable, match=words):
        need_of(presses)


def test_readings_that_are_alike_are_as_sure_as_their_scale():
    assert mean_of([2.0, 2.0], 0.12).sigma == pytest.approx(0.12 / math.sqrt(12.0))


def test_gyro_counts_less_its_offset_from_rest_on():
    gyro = GyroTurn()
    for step in range(1200):
        stamp_s = 0.02 * step
        if step == 300:
            gyro.begin()
        gyro.add(stamp_s, 0.02 + (0.5 if 400 <= step < 1000 else 0.0))
    assert gyro.turn_rad() == pytest.approx(6.0, abs=0.001)


def test_gyro_without_rest_before_the_turn_says_so():
    gyro = GyroTurn()
    for step in range(300):
        gyro.add(0.02 * step, 0.5)
    gyro.begin()
    with pytest.raises(ReadingsUnusable, match="at rest for 3 s"):
        gyro.turn_rad()


def test_way_is_negative_backwards_and_poses_are_averaged_over_the_half_turn():
    start = Pose2(1.0, 1.0, math.pi / 2.0)
    assert way_between(start, start @ Pose2(-2.0, 0.1, 0.0)) == pytest.approx(-math.hypot(2.0, 0.1))
    assert abs(mean_pose([Pose2(0.0, 0.0, 3.14), Pose2(0.0, 2.0, -3.14)]).heading) == pytest.approx(math.pi)


class FakeRobot:
    """Robot with the state that the readings need."""

    def __init__(self):
        self._places, self._heights = places(8, noise_m=0.001), itertools.cycle([0.4, 0.8, 1.2])
        self._ways, self._turns = iter([9.97, -9.97, 9.97, -9.96]), iter([6.27, -6.27, 6.27, -6.26])
        self.refusals = 0

    def key(self):
        return KeyMount(0.25, 0.0, 0.4, 0.9)

    def pose(self):
        if self.refusals:
            self.refusals -= 1
            raise ReadingsUnusable("The robot moved.")
        return next(self._places)

    def begin(self):
        pass

    def way_m(self):
        return next(self._ways)

    def turn_rad(self):
        return next(self._turns)

    def key_height_m(self):
        return next(self._heights)


def guided(what, answers, robot=None):
    said, script = [], iter(answers)
    console = Console(lambda question: "" if question.endswith("Enter. ") else next(script), said.append)
    return GUIDES[what](console, robot or FakeRobot()), " ".join(said)


@pytest.mark.parametrize("what, answers, names, words", [
    ("lever", ["8"], ["key_lever_m"], "Write the measured place"),
    ("mast", ["2", *["10", "17"] * 4], ["mast_lean_deg"], "leans forwards"),
    ("wheels", ["10", "1"], ["wheel_scale", "gyro_scale"], "what the IMU's driver publishes"),
    ("lift", ["3", "0,41", "0.81", "1.21"], ["lift_height_m"], "10.0 mm higher"),
    ("press", ["2", "0.2", "3", "n", "0.3", "5", "y"], ["press_force_n"], "0.38 at least")])
def test_each_guide_leads_to_its_checks(what, answers, names, words):
    if what == "mast":
        robot = FakeRobot()
        robot.key_height_m = iter([0.4, 1.2] * 4).__next__
        checks, said = guided(what, answers, robot)
    else:
        checks, said = guided(what, answers)
    assert [check.name for check in checks] == names
    assert words in said


def test_an_answer_that_cannot_be_used_is_asked_for_again():
    checks, said = guided("lift", ["many", "2", "3", "0.4", "9", "0.8", "1.2"])
    assert "That is no number" in said and "It is 2 heights; allowed is 3 to 20 heights." in said
    assert "It is 9 m; allowed is 0 to 3 m." in said and checks[0].estimate.value == pytest.approx(0.0)


def test_a_reading_that_cannot_be_used_is_taken_again():
    robot = FakeRobot()
    robot.refusals = 2
    checks, _ = guided("lever", ["8"], robot)
    assert checks[0].estimate.value == pytest.approx(KEY[0] - 0.25, abs=0.003)


def check(name, value=0.004, how="plumb line"):
    return Check(name, Estimate(value, 0.001, 12.0), how)


def test_record_keeps_the_day_of_its_oldest_term_and_what_else_was_measured(tmp_path):
    path, before = tmp_path / "robot.yaml", None
    for name, days in (("key_lever_m", 400), ("wheel_scale", 500), ("mast_lean_deg", 10)):
        before = updated(before, ORIGIN, check(name), TODAY - datetime.timedelta(days))
        save(path, before)
        before = load(path)
    assert before["date"] == (TODAY - datetime.timedelta(400)).isoformat()
    assert before["terms"]["mast_lean_deg"]["degrees_of_freedom"] == 12.0
    assert before["terms"]["floor_slope_deg"]["distribution"] == "rectangular"
    late = overdue(before, TODAY)
    assert [sentence.split()[0] for sentence in late] == ["lidar_yaw_deg", "key_lever_m", "wheel_scale"]
    again = updated(before, ORIGIN, check("key_lever_m"), TODAY)
    assert again["date"] == (TODAY - datetime.timedelta(10)).isoformat() and len(again["checks"]) == 3


def test_what_was_never_measured_is_told():
    record = updated(None, ORIGIN, check("wheel_scale"), TODAY)
    named = [sentence.split()[0] for sentence in overdue(record, TODAY)]
    assert named == ["mast_lean_deg", "key_lever_m", "lidar_yaw_deg"]


def test_record_of_another_robot_is_refused_and_before_the_work(tmp_path):
    record = updated(None, ORIGIN, check("mast_lean_deg"), TODAY)
    with pytest.raises(ReadingsUnusable, match="of the robot MTR-1, not of MTR-2"):
        updated(record, replace(ORIGIN, robot="MTR-2"), check("key_lever_m"), TODAY)
    path = tmp_path / "robot.yaml"
    save(path, record)
    options = command_line.parsed(["lidars", "--bag", "none.bag", "--robot", "MTR-2"])
    with pytest.raises(ReadingsUnusable, match="--record"):
        command_line.calibrated(options, path)


def test_lever_ends_with_the_description_that_it_was_measured_against(tmp_path, capsys):
    record = updated(updated(None, ORIGIN, check("key_lever_m", 0.03), TODAY), ORIGIN, check("wheel_scale"), TODAY)
    moved = replace(ORIGIN, key_ahead_m=0.28)
    other = updated(record, moved, check("mast_lean_deg"), TODAY)
    assert other["terms"]["key_lever_m"] == DESIGN_TERMS["key_lever_m"] and other["key_ahead_m"] == 0.28
    assert [each["name"] for each in other["checks"]] == ["wheel_scale", "mast_lean_deg"]
    again = updated(record, moved, check("key_lever_m", 0.001), TODAY)
    assert again["terms"]["key_lever_m"]["value"] == 0.001
    options, path = command_line.parsed(["mast", "--by", "J"]), tmp_path / "robot.yaml"
    for found, is_said in ((check("mast_lean_deg"), True), (check("key_lever_m"), False)):
        command_line.recorded(options, path, record, [found], 0.28)
        assert ("key_lever_m counts as never measured" in capsys.readouterr().out) is is_said


def test_error_that_is_to_be_mended_is_not_recorded():
    with pytest.raises(ReadingsUnusable, match="at most 0.1 is recorded"):
        updated(None, ORIGIN, check("key_lever_m", 0.2), TODAY)


@pytest.mark.parametrize("content", ["{", "- 1", "robot: x"])
def test_a_file_that_is_no_record_is_one_sentence(tmp_path, content):
    path = tmp_path / "robot.yaml"
    path.write_text(content)
    with pytest.raises(ReadingsUnusable, match=r"robot.yaml .*--record\."):
        load(path)


def test_a_record_that_cannot_be_written_is_one_sentence(tmp_path):
    with pytest.raises(ReadingsUnusable, match="cannot be written"):
        save(tmp_path / "nowhere" / "robot.yaml", {})
