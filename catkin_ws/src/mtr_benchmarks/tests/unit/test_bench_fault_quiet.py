"""Evaluation of cells of the matrix with an unnoticeable fault, and definition of standstill."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from types import SimpleNamespace

import pytest
from nav_msgs.msg import Odometry

from mtr_benchmarks.faults.course import Course
from mtr_benchmarks.faults.judge import Outcome, end_speed_mps, has_stood, standstill_s, wrong
from mtr_benchmarks.faults.matrix import ANY_REASON, GOES_ON, HELD, UNHEARD, Cell, Expected, Matrix, table
from mtr_benchmarks.faults.robot import FaultyRobot

QUIET = Cell("driving", "battery", "off", 1.0, 0.0, False, Expected(
    stands_s=None, told="", told_s=1.0, mode="following_waypoint", then=GOES_ON, record=""))
WELL = Outcome(0.5, None, {}, ["following_waypoint"], GOES_ON, "", end_mps=0.5)


@pytest.mark.parametrize("change, words", [
    ({"told_s": {"localization.lost": 0.1}}, "tells"),
    ({"modes": ["following_waypoint", "fault"]}, "must be following"),
    ({"modes": ["following_waypoint", "fault", "following_waypoint"]}, "must be following"),
    ({"modes": ["following_waypoint", UNHEARD]}, "must be following"), ({"modes": []}, "must be following")])
def test_where_nothing_is_to_be_noticed_all_stays_as_it_was(change, words):
    assert wrong(QUIET, WELL) == [] and words in " ".join(wrong(QUIET, replace(WELL, **change)))


def test_codes_that_may_be_told_where_none_has_to():
    told = replace(WELL, told_s={"localization.lost": 0.1})
    for may_tell, is_right in (("localization.lost or x.y", True), (ANY_REASON, True), ("x.y", False)):
        cell = replace(QUIET, expected=replace(QUIET.expected, may_tell=may_tell))
        assert bool(wrong(cell, told)) != is_right
        assert ("any" if may_tell == ANY_REASON else "`x.y`") in table(Matrix((cell,)))[2]


@pytest.mark.parametrize("change", [
    {"stood_s": 0.3, "end_mps": 0.0}, {"modes": ["following_waypoint", "fault"]}, {"then": HELD}])
def test_robot_that_may_stand_says_why(change):
    cell = replace(QUIET, expected=replace(QUIET.expected, may_stand=True, may_tell=ANY_REASON, record=None,
                                           mode="following_waypoint or fault", then="resumes or held"))
    seen = replace(WELL, **change)
    assert ["does not say why" in each for each in wrong(cell, seen)] == [True]
    assert wrong(cell, replace(seen, told_s={"localization.lost": 0.1})) == [] and wrong(cell, WELL) == []


def test_press_of_a_cell_is_reported_as_done():
    cell = replace(QUIET, expected=replace(QUIET.expected, presses=True))
    assert wrong(cell, replace(WELL, pressed=True)) == [] and "press" in wrong(cell, WELL)[0]


def test_robot_that_has_mapped_the_car_during_the_fault_has_gone_on():
    mapping = replace(QUIET, state="mapping", expected=replace(QUIET.expected, mode="mapping_car"))
    assert wrong(mapping, replace(WELL, modes=["mapping_car", "following_waypoint"], stood_s=0.2, end_mps=0.0)) == []


def test_robot_that_turns_on_the_spot_does_not_stand():
    robot = SimpleNamespace(speeds=[], _time_s=lambda stamp_s: stamp_s)
    for number in range(100):
        turning = Odometry()
        turning.header.stamp.secs, turning.header.stamp.nsecs = divmod(10 * 10 ** 9 + number * 20_000_000, 10 ** 9)
        turning.twist.twist.angular.z = 0.8
        FaultyRobot._take_truth(robot, turning)
    assert standstill_s(robot.speeds, 10.2, 11.5) is None and not has_stood(robot.speeds, 1.5)
    assert end_speed_mps(robot.speeds, 10.2, 11.5) > 0.2 and end_speed_mps(robot.speeds, 20.0, 21.0) is None


@pytest.mark.parametrize("presses", [True, False])
def test_press_is_ordered_where_a_cell_has_one_when_its_fault_has_begun(presses):
    asked = []
    robot = SimpleNamespace(
        status=SimpleNamespace(hold_id=0, mode=1), release_hold=None, speed_mps=0.0, now_s=99.0, seen=[], lifts=[],
        speeds=[], ended_s=2.0, begin=lambda *_: asked.append("fault") or 1.0, press=lambda: asked.append("press"),
        has_pressed=True, wait_until=lambda *_: None)
    cell = replace(QUIET, state="ready", expected=replace(QUIET.expected, presses=presses))
    assert Course(robot).run(cell).pressed == presses and asked == ["fault"] + ["press"] * presses
