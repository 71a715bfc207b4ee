"""Lines with one random disturbance each: the judge, the world's own truth, and a short form of the benchmark."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
import statistics
from dataclasses import replace

import pytest

from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.truth import line
from mtr_benchmarks.truth.__main__ import report
from mtr_benchmarks.truth.campaign import figures
from mtr_benchmarks.truth.car import CarBody, Change, Order, Place
from mtr_benchmarks.truth.judge import Verdict, Window, judge_autolock
from mtr_benchmarks.truth.line import pose_error, run_line
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineStatus, MeasuredDistance

SEED = 1
LINES = 200
RAY = Ray(0.0, 0.9, 0.0, 1.0)
WINDOW = Window(10.0, 20.0, 1.0)
UNLOCKED = Change(12.0, False, True, 0, Place(0.0, 2.4, 1.0))


class Seen:
    """The part of a world that a judge of Autolock needs."""

    def __init__(self, *changes):
        self.car = CarBody(1.5, 2.5, 0.0)
        self.car.changes = list(changes)


NO_LOCK = MeasuredDistance("lock", LineStatus.NOT_REACHED, None, None)


def verdict(told_m, *changes, sigma_m=0.03):
    """Return the verdict on a line with an unlock distance, or None for not reached, and without a lock distance."""
    status = LineStatus.NOT_REACHED if told_m is None else LineStatus.OK
    told = (MeasuredDistance("unlock", status, told_m, sigma_m), NO_LOCK)
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


@pytest.mark.parametrize(("sigma_m", "expected"), [
    (0.011, Verdict.RIGHT), (0.009, Verdict.WRONG), (None, Verdict.WRONG), (math.nan, Verdict.WRONG)])
def test_judge_allows_no_more_than_three_of_the_told_sigmas(sigma_m, expected):
    assert verdict(1.53, UNLOCKED, sigma_m=sigma_m) is expected


@pytest.mark.parametrize("told", [(), (MeasuredDistance("unlock", LineStatus.OK, 1.5, 0.03),)])
def test_line_that_leaves_a_distance_out_is_not_right(told):
    assert judge_autolock(Seen(UNLOCKED), RAY, told, WINDOW) is Verdict.INVALID
    wrong = (MeasuredDistance("unlock", LineStatus.OK, 1.6, 0.03),)
    assert judge_autolock(Seen(UNLOCKED), RAY, wrong, WINDOW) is Verdict.WRONG


def test_position_is_as_far_off_as_its_sigma_allows():
    errors = [pose_error(random.Random(number)) for number in range(300)]
    sigmas_m = [error.sigma_m for error in errors]
    assert 0.002 <= min(sigmas_m) < 0.003 and 0.02 < max(sigmas_m) <= 0.03
    off_m = [math.hypot(*error.at(time_s)) for error in errors for time_s in (0.0, 7.0, 30.0)]
    in_sigmas = [each_m / error.sigma_m for error in errors for each_m in (math.hypot(*error.at(7.0)),)]
    assert 0.03 < max(off_m) <= 0.035 and 0.6 < statistics.median(in_sigmas) < max(in_sigmas) <= 2.0


@pytest.mark.parametrize("share", [1.0, 0.2])
def test_too_small_a_sigma_of_the_position_is_found(monkeypatch, share):
    """With the right sigma no line is wrong; with a fifth of it some are."""
    def too_sure(chance):
        error = pose_error(chance)
        return error._replace(sigma_m=share * error.sigma_m)

    monkeypatch.setattr(line, "pose_error", too_sure)
    found = [run_line(SEED, number).verdict for number in range(24)]
    assert (Verdict.WRONG in found) is (share < 1.0)


def test_cars_frames_tell_a_change_from_the_first_one_after_it():
    car = CarBody(-1.0, 0.0, 0.0)
    car.foreign.append(Order(0.05, False, 2))
    car.step(0.0, 0.1, 5.0, 5.0, Place(5.0, 0.0, 1.0))
    assert [(round(frame.time_s, 2), frame.data[0] & 3) for frame in car.frames(0.1)] == [
        (0.0, 0), (0.02, 0), (0.04, 0), (0.06, 1), (0.08, 1), (0.1, 1)]


@pytest.fixture(scope="module", name="lines")
def lines_fixture():
    """Return the lines of the short form."""
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
