"""Handle request against the simulated Car that unlocks on its handle only: output, bus and truth, without ROS."""
# SPDX-License-Identifier: Apache-2.0
import csv

import numpy as np
import pytest
from honest_car import HonestCarLink

from mtr_bringup.demo import HONEST_LIMITS
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.assistance import OUTPUT
from mtr_operator.domain.ports import HANDLE
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.handle_request import SCENARIO
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.report.results_csv import results_csv
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_simulation.car.honest.radio.key_antenna import Attitude
from mtr_simulation.truth import compare

PARAMETERS = HandleRequestParameters.from_mapping(
    {"measurements_distance_m": 2.0, "maximum_distance_m": 3.5, "interval_m": 0.25, "attempts_limit": 14,
     "self_check": False})


@pytest.fixture(name="measured", scope="module", params=[1, 2])
def measured_fixture(request, tmp_path_factory):
    """Lines, results and truth of a test; its folder has results.csv and the true events."""
    folder = tmp_path_factory.mktemp("handle")
    car = HonestCarLink(request.param, folder)
    robot = FakeRobotLink(request.param)
    robot.connect()
    progress = Progress(SCENARIO.name, PARAMETERS.to_mapping())
    Runner(SCENARIO, PARAMETERS, ControlLoop(robot, car), progress, lambda _: None).run()
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


def test_the_border_is_where_half_of_the_requests_work_in_truth(measured):
    lines, results, truth, _ = measured
    for line, result in zip(lines, results):
        assert true_share(truth, line, result.d50_low_m) > 0.5 > true_share(truth, line, result.d50_high_m)
        assert true_share(truth, line, max(result.failed_at_m)) < 0.5 < true_share(truth, line, min(result.worked_at_m))


def test_results_stand_beside_the_truth_of_the_simulation(measured, capsys):
    _, results, _, arguments = measured
    assert compare.main([*arguments, *HONEST_LIMITS]) == 0
    told = capsys.readouterr().out
    with open(f"{arguments[3]}/truth.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [(row["scenario"], row["event"]) for row in rows] == 3 * [("handle_request", "handle")]
    for row, result in zip(rows, results):
        assert float(row["true_distance_m"]) == pytest.approx(result.distance_m, abs=0.1)
        assert result.d50_low_m < float(row["p50_distance_m"]) < result.d50_high_m
        assert 0.0 <= float(row["true_border_share"]) <= 1.0
    assert "handle_request: 3 of 3 distances are ok and have their true event" in told
    assert "handle_request: handle, 50 %: 3 of 3 intervals hold the truth (100 %)" in told
    assert "inside at border" in told
