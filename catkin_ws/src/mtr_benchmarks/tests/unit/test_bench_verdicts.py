"""Short forms of complete tests at the limit and of ranges over reflecting ground, and their rows."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mtr_benchmarks.ranges.campaigns import AT_LIMIT, OVER_GROUND, Task, run_task
from mtr_benchmarks.ranges.cars import Polling, Radio
from mtr_benchmarks.ranges.nulls import NullDraw, radials_of
from mtr_benchmarks.ranges.pass_verdicts import AxesLimitDraw
from mtr_benchmarks.ranges.table import limit_figures, whole_tests
from mtr_benchmarks.ranges.verdicts import FAIL_BY_HOLE, SEARCHES, Judged, LimitDraw, verdict_of


@pytest.mark.parametrize("search", ["key_press", "handle_request"])
def test_lines_exactly_at_their_limits_are_judged_after_one_more_look(search):
    draw = LimitDraw(search, Radio(0.4, 0.0, 0.0), 2, 1, rounds=1)
    lines = run_task(Task(("short",), draw))[(AT_LIMIT, "short")]
    assert len(lines) == 2 and all(line.verdict in ("pass", "inconclusive", "fail") for line in lines)
    assert all(line.looks in (0, 1, 2) and line.holds in (True, False) for line in lines)
    assert any(line.looks == 2 and line.presses > 9 for line in lines)


def test_axes_exactly_at_their_limits_are_judged_after_one_more_look():
    lines = run_task(Task(("short",), AxesLimitDraw(Polling(), 2, 1, rounds=1)))[(AT_LIMIT, "short")]
    assert [line.presses for line in lines] == [3, 3] or any(line.verdict != "inconclusive" for line in lines)


@pytest.mark.parametrize("mhz", [868.0, 433.92])
def test_radials_over_ground_end_within_the_test(mhz):
    radials = radials_of(NullDraw(mhz, 5))
    assert all(4.0 < radial.d50_m < 16.0 for radial in radials)
    near = np.mean([radial.press(1.0) for radial in radials for _ in range(20)])
    far = np.mean([radial.press(29.0) for radial in radials for _ in range(20)])
    assert near > 0.8 and far < 0.2


def judged(verdict, holds=True):
    return Judged(verdict, 2, holds, holds, 0.2, 32)


def test_rows_tell_the_worst_kind_of_car():
    good = [judged("inconclusive")] * 95 + [judged("pass")] * 2
    bad = [judged("fail", False)] * 10 + [judged("pass")] * 90
    details = {AT_LIMIT: {"good": limit_figures(good), "bad": limit_figures(bad)}}
    rows = {row.requirement.name: row for row in whole_tests(details)}
    wrong_pass, wrong_fail = (rows[f"whole tests at the limit, wrong {name}, worst"] for name in ("pass", "fail"))
    assert (wrong_pass.value, wrong_pass.remark, wrong_pass.is_met) == (0.9, "bad", False)
    assert wrong_fail.value == 0.1 and not wrong_fail.is_met
    assert rows["coverage of whole tests at the limit, least"].value == 0.9


@pytest.mark.parametrize(("word", "holes_m", "counted"), [
    ("fail", "5.00", FAIL_BY_HOLE), ("fail", "5.00 7.00", "fail"), ("fail", "7.00", "fail"), ("fail", "", "fail"),
    ("fail", "5.00 12.00", FAIL_BY_HOLE), ("fail", "12.00", "fail"), ("pass", "5.00", "pass")])
def test_fail_is_wrong_unless_every_hole_nearer_than_the_limit_is_one(word, holes_m, counted):
    radial = SimpleNamespace(d50_m=10.0, works=lambda distance_m: 0.4 if distance_m == 5.0 else 0.6)
    result = replace(SEARCHES["key_press"].empty(1, 0.0), holes_m=holes_m)
    assert verdict_of(word, result, radial) == counted


def test_fails_by_a_hole_have_a_share_of_their_own():
    shares = limit_figures([judged("fail")] + [judged(FAIL_BY_HOLE)] * 2 + [judged("pass")])
    assert (shares["fail"], shares["fail_by_hole"], shares["pass"]) == (0.25, 0.5, 0.25)


def test_kinds_of_one_scenario_are_judged_together():
    few, many = [judged("pass")] * 2, [judged("inconclusive")] * 98
    details = {AT_LIMIT: {"key_press/steady/4": limit_figures(few), "key_press/fading/4": limit_figures(many)}}
    row = whole_tests(details)[0]
    assert row.value == pytest.approx(0.02) and row.details == {"key_press/steady/4": 1.0, "key_press/fading/4": 0.0}


def test_what_was_not_measured_has_no_row():
    assert whole_tests({}) == []
    assert len(whole_tests({OVER_GROUND: {"868_mhz": {"coverage_95": 0.95}}})) == 2
