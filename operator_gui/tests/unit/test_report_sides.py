"""Minimum, mean and maximum per side, with as much as is known of lines that know one end only."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.verdict.judgement import Judgement, TestJudgement
from mtr_operator.domain.verdict.requirement import Requirement
from mtr_operator.domain.verdict.verdict import Verdict
from mtr_operator.report.side_summary import ALL_SIDES, side_summaries
from mtr_operator.report.side_table import side_table

KEY_PRESS = SCENARIOS["key_press"]
CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
# Four radials on each side and corner.
SCAN = KeyPressParameters.from_mapping({"method": "scan", "angle_between_radials_deg": 11.25})


def radial(number, worked_m, failed_m):
    """Scan of a radial; the number 1 leads to the front, 9 to the right."""
    status = LineStatus.NOT_REACHED if worked_m is None else LineStatus.OK
    return KeyPressResult(number, 11.25 * (number - 1), status, worked_m, failed_m, 0.01, 3, 1.0, "")


def summaries(*results, judgement=None):
    progress = Progress("key_press", SCAN.to_mapping(), {}, CAR, list(results))
    return {summary.side: summary for summary in side_summaries(KEY_PRESS, SCAN, progress, judgement)}


def test_sides_come_clockwise_and_all_of_them_last():
    assert list(summaries(radial(9, 4.0, 4.5), radial(1, 4.0, 4.5), radial(5, 4.0, 4.5))) == [
        "front", "front right", "right", ALL_SIDES]
    assert list(summaries(radial(1, 4.0, 4.5))) == ["front"]


def test_ranges_between_places_stay_ranges():
    front = summaries(radial(1, 4.0, 4.5), radial(2, 5.0, 5.5))["front"]
    assert (front.count, front.worst_line) == (2, 1)
    assert (front.minimum, front.maximum) == (Figure(Kind.BETWEEN, 4.0, 4.5), Figure(Kind.BETWEEN, 5.0, 5.5))
    assert front.mean == Figure(Kind.BETWEEN, 4.5, 5.0)


@pytest.mark.parametrize(("results", "minimum", "mean", "maximum"), [
    ([(6.0, None), (6.0, None)], Figure(Kind.AT_LEAST, 6.0), Figure(Kind.AT_LEAST, 6.0), Figure(Kind.AT_LEAST, 6.0)),
    ([(6.0, None), (4.0, 4.5)], Figure(Kind.BETWEEN, 4.0, 4.5), Figure(Kind.AT_LEAST, 5.0), Figure(Kind.AT_LEAST, 6.0)),
    ([(None, 3.0), (4.0, 4.5)], Figure(Kind.AT_MOST, 3.0), Figure(Kind.AT_MOST, 3.75), Figure(Kind.BETWEEN, 4.0, 4.5)),
    ([(None, 3.0), (6.0, None)], Figure(Kind.AT_MOST, 3.0), Figure(Kind.UNKNOWN), Figure(Kind.AT_LEAST, 6.0))])
def test_what_is_known_from_one_side_only_is_said_so__A6(results, minimum, mean, maximum):
    front = summaries(*(radial(index + 1, *ends) for index, ends in enumerate(results)))["front"]
    assert (front.minimum, front.mean, front.maximum) == (minimum, mean, maximum)


def test_values_have_values():
    adaptive = KeyPressParameters.from_mapping({"angle_between_radials_deg": 11.25})
    found = [replace(radial(number, 4.0, 4.5), method="adaptive", reach="measured", d50_m=d50_m,
                     d50_low_m=d50_m - 0.2, d50_high_m=d50_m + 0.2)
             for number, d50_m in ((1, 4.0), (2, 5.0))]
    progress = Progress("key_press", adaptive.to_mapping(), {}, CAR, found)
    front, = side_summaries(KEY_PRESS, adaptive, progress, None)
    assert (front.minimum, front.mean, front.maximum) == tuple(Figure(Kind.VALUE, m) for m in (4.0, 4.5, 5.0))


def test_invalid_lines_say_nothing_and_are_not_counted():
    invalid = replace(radial(2, None, None), status=LineStatus.INVALID, reason="Bus off.")
    assert summaries(radial(1, 4.0, 4.5), invalid)["front"].count == 1
    alone = summaries(invalid)["front"]
    assert (alone.count, alone.worst_line, alone.minimum.kind) == (0, None, Kind.NOT_REACHED)


def test_worst_line_is_that_with_the_worst_verdict_before_the_nearest():
    requirement = Requirement("near", "press", None, 4.2)
    judgement = TestJudgement((Judgement(requirement, 1, Verdict.PASS),
                               Judgement(requirement, 2, Verdict.FAIL, "Far.")))
    front = summaries(radial(1, 4.0, 4.5), radial(2, 5.0, 5.5), judgement=judgement)["front"]
    assert (front.worst_line, front.verdict) == (2, Verdict.FAIL)


def test_text_has_a_row_per_side():
    found = list(summaries(radial(1, 4.0, 4.5), radial(9, 6.0, None)).values())
    assert [row.split("  ")[0] for row in side_table(found, False)] == ["press: side", "front", "right", "all sides"]
    assert [" ".join(row.split()) for row in side_table(found, False)] == [
        "press: side lines minimum m mean m maximum m worst line",
        "front 1 4.00 to 4.50 4.00 to 4.50 4.00 to 4.50 1",
        "right 1 at least 6.00 at least 6.00 at least 6.00 9",
        "all sides 2 4.00 to 4.50 at least 5.00 at least 6.00 1"]


def test_text_has_a_column_of_verdicts_where_there_are_limits():
    judgement = TestJudgement((Judgement(Requirement("near", "press", 3.0, None), 1, Verdict.PASS),))
    heading, front = side_table(list(summaries(radial(1, 4.0, 4.5), judgement=judgement).values()), True)
    assert heading.endswith("verdict") and front.endswith("pass")
