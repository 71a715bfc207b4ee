"""Verdicts by guard bands: on a line, on a test, and what may be measured further."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.results.line_result import LineResult, LineStatus, MeasuredDistance
from mtr_operator.domain.verdict.judgement import Circumstances, judge
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.requirement import Requirement, side_of
from mtr_operator.domain.verdict.verdict import Verdict, worst

LINES = radials_around(math.radians(45.0))
AT_LEAST = Requirement("far enough", "press", 1.2, None)
AT_MOST = Requirement("not too far", "press", None, 3.0)


@dataclass(frozen=True)
class Measured(LineResult):
    """A line with one distance."""

    line: int
    distance: MeasuredDistance
    holes_m: tuple[float, ...] = ()
    reason: str = ""
    evidence: tuple[str, ...] = ()

    @property
    def number(self) -> int:
        return self.line

    @property
    def place(self) -> str:
        return ""

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        return (self.distance,)

    def holes_nearer_than(self, distance_m: float) -> tuple[float, ...]:
        return tuple(hole_m for hole_m in self.holes_m if hole_m < distance_m)


def measured(line: int, low_m: float | None, high_m: float | None, value_m: float | None = None) -> Measured:
    """Result of a line with an interval."""
    status = LineStatus.NOT_REACHED if value_m is None else LineStatus.OK
    return Measured(line, MeasuredDistance("press", status, value_m, 0.01, low_m, high_m))


def verdict_of(requirement: Requirement, result: LineResult, guard_sigma_m: float = 0.0) -> Verdict:
    """Of one line, measured beside another one on which the key works."""
    others = [measured(2, 1.0, 2.0, 1.5)]
    circumstances = Circumstances(lambda _, __: guard_sigma_m)
    return judge(Limits((requirement,)), LINES[:1], [result, *others], circumstances).verdict


@pytest.mark.parametrize("low_m, high_m, at_least, at_most", [
    (1.3, 1.5, Verdict.PASS, Verdict.PASS),
    (1.2, 3.0, Verdict.PASS, Verdict.PASS),
    (0.9, 1.1, Verdict.FAIL, Verdict.PASS),
    (1.1, 1.3, Verdict.INCONCLUSIVE, Verdict.PASS),
    (2.9, 3.1, Verdict.PASS, Verdict.INCONCLUSIVE),
    (3.1, 3.3, Verdict.PASS, Verdict.FAIL),
    (1.0, 3.3, Verdict.INCONCLUSIVE, Verdict.INCONCLUSIVE)])
def test_the_whole_interval_has_to_keep_or_break_the_limit(low_m, high_m, at_least, at_most):
    result = measured(1, low_m, high_m, (low_m + high_m) / 2.0)
    assert verdict_of(AT_LEAST, result) is at_least
    assert verdict_of(AT_MOST, result) is at_most


def test_an_open_end_keeps_or_breaks_a_limit_on_its_other_side():
    assert verdict_of(AT_LEAST, measured(1, None, 0.5)) is Verdict.FAIL
    assert verdict_of(AT_MOST, measured(1, None, 0.5)) is Verdict.PASS
    assert verdict_of(AT_LEAST, measured(1, 4.0, None)) is Verdict.PASS
    assert verdict_of(AT_MOST, measured(1, 4.0, None)) is Verdict.FAIL


def test_a_boundary_that_was_not_reached_lies_beyond_the_end_of_the_line():
    unreached = Circumstances(unreached=lambda _, __: (None, 0.5))
    results = [measured(1, None, None), measured(2, 1.0, 2.0, 1.5)]
    found = judge(Limits((AT_LEAST, AT_MOST)), LINES[:1], results, unreached)
    assert [judgement.verdict for judgement in found.judgements] == [Verdict.FAIL, Verdict.PASS]


def test_silence_on_every_line_passes_no_upper_limit():
    found = judge(Limits((AT_MOST,)), LINES[:2], [measured(1, None, 0.5), measured(2, None, 0.5)])
    assert found.verdict is Verdict.INCONCLUSIVE
    assert "asleep" in found.reason_of(1)
    assert found.undecided() == []


@pytest.mark.parametrize("low_m, high_m, value_m", [(math.nan, math.nan, math.nan), (None, None, 1.5)])
def test_a_distance_without_an_interval_decides_nothing(low_m, high_m, value_m):
    assert verdict_of(AT_LEAST, measured(1, low_m, high_m, value_m)) is Verdict.INCONCLUSIVE
    assert verdict_of(AT_MOST, measured(1, low_m, high_m, value_m)) is Verdict.INCONCLUSIVE


def test_an_invalid_line_is_inconclusive_with_its_reason():
    result = Measured(1, MeasuredDistance("press", LineStatus.INVALID, None, None), reason="The bus fell silent.")
    found = judge(Limits((AT_LEAST,)), LINES[:1], [result])
    assert (found.of_line(1), found.reason_of(1)) == (Verdict.INCONCLUSIVE, "The bus fell silent.")
    assert found.undecided() == []


def test_an_error_that_no_repeat_shows_widens_the_guard_band():
    result = measured(1, 1.25, 1.45, 1.35)
    assert verdict_of(AT_LEAST, result, 0.05) is Verdict.PASS
    assert verdict_of(AT_LEAST, result, 0.07) is Verdict.INCONCLUSIVE


def test_a_hole_nearer_than_the_limit_fails_it():
    far = measured(1, 2.0, 2.4, 2.2)
    assert verdict_of(AT_LEAST, replace(far, holes_m=(1.5,))) is Verdict.PASS
    assert verdict_of(AT_LEAST, replace(far, holes_m=(0.8,))) is Verdict.FAIL
    assert verdict_of(AT_MOST, replace(far, holes_m=(0.8,))) is Verdict.PASS


def test_the_test_takes_the_worst_line_and_a_line_without_limit_is_not_set():
    on_the_left = replace(AT_LEAST, sides=("left",))
    results = [measured(line.number, 1.3, 1.5, 1.4) for line in LINES]
    found = judge(Limits((on_the_left,)), LINES, results)
    assert found.verdict is Verdict.PASS
    assert [found.of_line(line.number) for line in LINES] == 6 * [Verdict.NOT_SET] + [Verdict.PASS, Verdict.NOT_SET]
    assert worst([Verdict.NOT_SET, Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE]) is Verdict.FAIL
    assert worst([]) is Verdict.NOT_SET


def test_a_line_that_was_not_measured_aborts():
    assert judge(Limits((AT_LEAST,)), LINES[:1], []).verdict is Verdict.ABORTED


def test_only_lines_that_may_still_pass_are_measured_further():
    limits = Limits((AT_LEAST, AT_MOST))
    results = [measured(1, 1.0, 1.4, 1.2), measured(2, 1.3, 1.5, 1.4), measured(3, 3.1, 9.0, 4.0)]
    found = judge(limits, LINES[:3], results)
    assert found.undecided() == [1]


def test_a_requirement_names_sides_and_angles_through_the_front():
    front = replace(AT_LEAST, angles_deg=(315.0, 45.0))
    assert [line.number for line in LINES if front.names(line.ray)] == [1, 2, 8]
    assert [side_of(line.ray) for line in LINES] == ["front", "front_right", "right", "rear_right", "rear", "rear_left",
                                                     "left", "front_left"]
    assert all(replace(AT_LEAST, angles_deg=(0.0, 360.0)).names(line.ray) for line in LINES)
    assert [line.number for line in LINES if replace(AT_LEAST, angles_deg=(90.0, 90.0)).names(line.ray)] == [3]


@pytest.mark.parametrize("beyond_sigmas", [0.01, 1.0, 3.0])
def test_of_cars_beyond_the_limit_at_most_one_in_40_passes(beyond_sigmas):
    sigma_m, limit_m = 0.1, 1.2
    values = np.random.default_rng(1).normal(limit_m - beyond_sigmas * sigma_m, sigma_m, 4000)
    half_m = 1.96 * sigma_m
    passed = [verdict_of(AT_LEAST, measured(1, value - half_m, value + half_m, value)) is Verdict.PASS
              for value in values]
    # Half a percent more is twice the scatter of so many draws.
    assert np.mean(passed) <= 0.030
