"""Handle request against the simulated Car that unlocks on its handle only: output, bus and truth, without ROS."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math

import numpy as np
import pytest
from honest_car import HonestCarLink
from scipy.optimize import brentq
from scipy.stats import binom, chi2

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.assistance import OUTPUT
from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.ports import HANDLE
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.handle_request import SCENARIO
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.report.results_csv import results_csv
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_simulation.car.honest.radio.key_antenna import Attitude
from mtr_simulation.demo import HONEST_LIMITS
from mtr_simulation.truth import compare

GIVEN = {"measurements_distance_m": 2.0, "maximum_distance_m": 3.5, "interval_m": 0.25, "attempts_limit": 14,
         "self_check": False}
PARAMETERS = HandleRequestParameters.from_mapping(GIVEN)
# Tests whose intervals are counted; in each the requests are made at other distances from the border.
SEEDS, HALF_WAVELENGTH_M = range(1, 25), 0.35
# By chance alone a calibrated estimate is beyond each of the bounds once in a hundred sets of seeds.
LEVEL, BOUNDS = 0.95, (0.01, 0.99)


def run_of(car, seed, parameters):
    """Progress of a whole test."""
    robot = FakeRobotLink(seed)
    robot.connect()
    progress = Progress(SCENARIO.name, parameters.to_mapping())
    Runner(SCENARIO, parameters, ControlLoop(robot, car), progress, lambda _: None).run()
    return progress


@pytest.fixture(name="measured", scope="module", params=[1, 2])
def measured_fixture(request, tmp_path_factory):
    """Lines, results and truth of a test; its folder has results.csv and the true events."""
    folder = tmp_path_factory.mktemp("handle")
    car = HonestCarLink(request.param, folder)
    progress = run_of(car, request.param, PARAMETERS)
    (folder / "results.csv").write_text(results_csv(SCENARIO, progress), encoding="utf-8")
    size = progress.measured_car
    arguments = ["--events", str(car.log.path), "--results", str(folder), "--car-length", str(size.length),
                 "--car-width", str(size.width), "--car", "honest_handle", "--seed", str(request.param)]
    return SCENARIO.lines(PARAMETERS, size), progress.results, car.truth, arguments


def true_share(truth, line, distance_m):
    """Of the requests that work."""
    x, y = line.ray.point(distance_m)
    return float(truth.unlock(np.array([[x, y, line.key_height_m]]), Attitude(line.ray.heading))[0])


def test_every_axis_of_the_drivers_side_is_measured_by_the_output(measured):
    lines, results, _, _ = measured
    assert len(results) == len(lines) == 3
    for result in results:
        assert (result.status.value, result.reason) == ("ok", "")
        assert (result.requested_by, result.cause) == (OUTPUT, HANDLE)
        assert result.inside and result.outside


def test_requests_work_nearer_than_the_border_in_truth_and_fail_beyond(measured):
    lines, results, truth, _ = measured
    for line, result in zip(lines, results):
        assert true_share(truth, line, max(result.failed_at_m)) < 0.5 < true_share(truth, line, min(result.worked_at_m))


@pytest.fixture(name="intervals", scope="module")
def intervals_fixture(tmp_path_factory):
    """Of whole tests: low and high end of each interval, open where unknown, and where half of the requests work."""
    found = []
    for seed in SEEDS:
        chance = np.random.default_rng(seed)
        parameters = HandleRequestParameters.from_mapping(
            {**GIVEN, "minimum_distance_m": 0.5 + HALF_WAVELENGTH_M * chance.random(),
             "border_distance_m": 1.0 + chance.random()})
        car = HonestCarLink(seed, tmp_path_factory.mktemp("handle"))
        progress = run_of(car, seed, parameters)
        for line, result in zip(SCENARIO.lines(parameters, progress.measured_car), progress.results):
            assert result.status.value == "ok"
            truth_m = brentq(lambda at_m, car=car, line=line: true_share(car.truth, line, at_m) - 0.5, 0.5, 3.0)
            low_m, high_m = result.d50_low_m, result.d50_high_m
            found.append((-math.inf if low_m is None else low_m, math.inf if high_m is None else high_m, truth_m))
    return np.array(found)


def test_95_percent_of_the_intervals_hold_where_half_of_the_requests_work_in_truth(intervals):
    low_m, high_m, truth_m = intervals.T
    held, (least, most) = np.sum((low_m <= truth_m) & (truth_m <= high_m)), binom.ppf(BOUNDS, len(intervals), LEVEL)
    assert len(intervals) == 3 * len(SEEDS) and least <= held <= most


def test_errors_are_as_large_as_the_intervals_say(intervals):
    low_m, high_m, truth_m = intervals[np.all(np.isfinite(intervals), axis=1)].T
    sigma_m = (high_m - low_m) / (2.0 * SIGMAS_OF_LEVEL)
    squares = np.sum(((truth_m - (low_m + high_m) / 2.0) / sigma_m) ** 2)
    least, most = chi2.ppf(BOUNDS, len(truth_m))
    assert least <= squares <= most
    # So many are enough to notice intervals that are a quarter too narrow.
    assert squares / 0.75 ** 2 > most


def test_results_stand_beside_the_truth_of_the_simulation(measured, capsys):
    _, results, _, arguments = measured
    assert compare.main([*arguments, *HONEST_LIMITS]) == 0
    told = capsys.readouterr().out
    with open(f"{arguments[3]}/truth.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [(row["scenario"], row["event"]) for row in rows] == 3 * [("handle_request", "handle")]
    for row, result in zip(rows, results):
        assert float(row["true_distance_m"]) == pytest.approx(result.distance_m, abs=0.1)
        assert 0.0 <= float(row["true_border_share"]) <= 1.0
    assert "handle_request: 3 of 3 distances are ok and have their true event" in told
    held = sum(result.d50_low_m < float(row["p50_distance_m"]) < result.d50_high_m
               for row, result in zip(rows, results))
    assert f"handle_request: handle, 50 %: {held} of 3 intervals hold the truth ({100 * held // 3} %)" in told
    assert "inside at border" in told
