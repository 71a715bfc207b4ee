"""Progress of a test and position of the robot, from the files of a test in progress."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from followed_tests import Measuring

from mtr_operator.domain.results.journal import DECISION, FURTHER, LINE, LINE_BEGUN, LINE_RESUMED
from mtr_operator.storage.journal.journal_file import Entry
from mtr_operator.storage.recorded.course_file import newest_moment
from mtr_results.live.pace import course_of


def decided(*moments):
    return [Entry(number, kind, {"action": "go", "robot_time_s": at_s} if kind == DECISION else {})
            for number, (kind, at_s) in enumerate(moments, start=1)]


def test_time_left_is_the_median_pace_of_the_lines():
    course = course_of(decided((DECISION, 10.0), (DECISION, 40.0), (LINE, 0.0), (DECISION, 70.0), (LINE, 0.0),
                               (DECISION, 570.0), (LINE, 0.0), (DECISION, 630.0)))
    assert course.line_s == 60.0 and course.left_s(2, 640.0) == pytest.approx(50.0 + 60.0)
    # An overlong line does not shorten the following ones.
    assert course.left_s(2, 900.0) == pytest.approx(60.0)
    assert course.left_s(0, 640.0) is None and course_of(decided((DECISION, 10.0))).left_s(3, 20.0) is None
    # The robot was restarted, with a new clock.
    assert course_of(decided((DECISION, 500.0), (LINE, 0.0), (DECISION, 3.0))).left_s(2, 4.0) is None


def test_line_at_hand_is_also_the_one_that_goes_on():
    for kind in (LINE_BEGUN, LINE_RESUMED, FURTHER):
        assert course_of([Entry(1, LINE, {}), Entry(2, kind, {"line": 3})]).line == 3


def test_newest_status_of_a_course_is_the_last_whole_one(tmp_path):
    course = tmp_path / "one" / "recording" / "course_001.jsonl"
    with Measuring(tmp_path / "one") as test:
        assert newest_moment(course) is None
        test.stand_at(1.0, 2.0, 50.0)
    content = course.read_text(encoding="utf-8")
    found = newest_moment(course).status
    assert (found.x, found.y, found.stamp_s, found.pose_valid) == (1.0, 2.0, 50.9, True)
    torn = tmp_path / "torn.jsonl"
    torn.write_text(content + '["n","held",{}]\n["s",[11,1', encoding="utf-8")
    assert newest_moment(torn).status.stamp_s == 50.9
    torn.write_text("no course\n" + content, encoding="utf-8")
    assert newest_moment(torn) is None
