"""Lines with one random disturbance each: the judge, the world's own truth, and a short form of the benchmark."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.truth.__main__ import report
from mtr_benchmarks.truth.campaign import figures
from mtr_benchmarks.truth.car import CarBody, Change, Order, Place
from mtr_benchmarks.truth.judge import Verdict, Window, judge_autolock
from mtr_benchmarks.truth.line import run_line
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineStatus, MeasuredDistance

SEED = 1
LINES = 200
RAY = Ray(0.0, 0.9, 0.0, 1.0)
WINDOW = Window(10.0, 20.0, 1.0)
UNLOCKED = Change(12.0, False, True, 0, Place(0.0, 2.4, 1.0))


class Seen:
    """As much of a world as a judge of Autolock looks at."""

    def __init__(self, *changes):
        self.car = CarBody(1.5, 2.5, 0.0)
        self.car.changes = list(changes)


def verdict(told_m, *changes):
    """Of a line that tells an unlock distance, or None for not reached, and no lock distance."""
    status = LineStatus.NOT_REACHED if told_m is None else LineStatus.OK
    told = (MeasuredDistance("unlock", status, told_m, 0.03),
            MeasuredDistance("lock", LineStatus.NOT_REACHED, None, None))
    return judge_autolock(Seen(*changes), RAY, told, WINDOW)


@pytest.mark.parametrize("told_m, change, expected", [
    (1.5, UNLOCKED, Verdict.RIGHT),
    (1.54, UNLOCKED, Verdict.RIGHT),
    (1.56, UNLOCKED, Verdict.WRONG),
    (None, UNLOCKED, Verdict.WRONG),
    (1.5, UNLOCKED._replace(by_key=False), Verdict.WRONG),
    (1.5, UNLOCKED._replace(time_s=9.0), Verdict.WRONG),
    (1.5, UNLOCKED._replace(place=Place(0.5, 2.4, 1.0)), Verdict.WRONG),
    (1.5, UNLOCKED._replace(place=Place(0.0, 2.4, 1.2)), Verdict.WRONG)])
def test_judge_believes_only_the_true_place_time_and_cause(told_m, change, expected):
    assert verdict(told_m, change) is expected


def test_cars_frames_tell_a_change_from_the_first_one_after_it():
    car = CarBody(-1.0, 0.0, 0.0)
    car.foreign.append(Order(0.05, False, 2))
    car.step(0.0, 0.1, 5.0, 5.0, Place(5.0, 0.0, 1.0))
    assert [(round(frame.time_s, 2), frame.data[0] & 3) for frame in car.frames(0.1)] == [
        (0.0, 0), (0.02, 0), (0.04, 0), (0.06, 1), (0.08, 1), (0.1, 1)]


@pytest.fixture(scope="module", name="lines")
def lines_fixture():
    """The short form."""
    return [run_line(SEED, number) for number in range(LINES)]


def test_the_same_seed_gives_the_same_line(lines):
    assert run_line(SEED, 8) == lines[8]


def test_every_disturbance_disturbs_lines(lines):
    disturbed = {line.kind for line in lines if line.is_disturbed}
    assert disturbed == {line.kind for line in lines} - {"none"} and len(disturbed) == 13


def test_no_undisturbed_line_is_invalid_or_wrong(lines):
    assert {line.verdict for line in lines if line.kind == "none"} == {Verdict.RIGHT}


def test_short_form_of_the_benchmark_is_what_it_must_be(lines):
    found = figures(SEED, lines)
    assert found.wrong_examples == []
    assert all_met(report(found).rows)


def test_one_wrong_line_fails_the_benchmark(lines):
    assert not all_met(report(replace(figures(SEED, lines), wrong_and_ok=1)).rows)
