"""Figures of runs in Gazebo and MuJoCo: pose errors, real-time factor, and requirements."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_benchmarks.gazebo.judge import judged, rows_of
from mtr_benchmarks.gazebo.noted import Notes, between, pose_errors
from mtr_benchmarks.gazebo.run import GAZEBO, MUJOCO, Run, RunOptions, lines_of, stack_options, touched_in
from mtr_benchmarks.harness.rows import all_met
from mtr_core.se2 import Pose2
from mtr_simulation.truth.distance import Comparison
from mtr_simulation.truth.results import MeasuredEvent

MS = 1_000_000


def line(status="ok", error_m=0.01):
    measured = MeasuredEvent("1", "unlock", status, 10.0, 1.5 + error_m, 0.01, "front", (1.0, 0.0))
    return Comparison(measured, 1.5)


def notes(**changes):
    truth = {tick * 20 * MS: (tick * 0.01, 0.0, 0.0) for tick in range(1, 100)}
    return Notes(**{"truth": truth, "believed": [(30 * MS, 0.015, 0.02, 0.1)], "clock": [(5.0, 1.0), (15.0, 11.0)],
                    **changes})


def run_with(**changes):
    return Run(**{"notes": notes(), "statuses": {"autolock": 0}, "lines": {"autolock": [line(), line(error_m=-0.02)]},
                  "touched": (), **changes})


def test_a_believed_pose_is_compared_with_the_true_one_of_its_own_instant():
    (error,) = pose_errors(notes())
    assert error == pytest.approx((0.02, 0.1))


def test_a_believed_pose_without_a_true_one_near_it_in_time_does_not_count():
    assert pose_errors(notes(believed=[(5000 * MS, 0.0, 0.0, 0.0)])) == []
    assert pose_errors(notes(truth={20 * MS: (0.0, 0.0, 0.0), 200 * MS: (0.0, 0.0, 0.0)})) == []


def test_headings_are_interpolated_the_short_way_round():
    middle = between(Pose2(0.0, 0.0, math.pi - 0.1), Pose2(1.0, 2.0, -math.pi + 0.1), 0.5)
    assert (middle.x, middle.y) == (0.5, 1.0) and abs(middle.heading) == pytest.approx(math.pi)


def test_the_pace_is_simulated_by_wall_time():
    assert notes().real_time_factor == 1.0 and notes(clock=[(1.0, 1.0)]).real_time_factor is None


def test_a_run_that_is_what_it_must_be_meets_every_row():
    rows, figures = judged({GAZEBO: run_with(), MUJOCO: run_with()})
    assert all_met(rows)
    assert figures[GAZEBO]["lines"]["autolock"][1]["error_m"] == pytest.approx(-0.02)
    assert figures[MUJOCO]["pose"]["position_m_median"] == pytest.approx(0.02)


@pytest.mark.parametrize("wrong", [
    {"statuses": {"autolock": 1}}, {"lines": {"autolock": [line("aborted")]}}, {"lines": {"autolock": []}},
    {"lines": {"autolock": [line(error_m=0.06)]}}, {"touched": ("car",)}, {"notes": notes(blockages=1)},
    {"notes": notes(clock=[(5.0, 1.0), (15.0, 8.0)])},
])
def test_each_thing_that_goes_wrong_fails_the_run(wrong):
    assert not all_met(rows_of(GAZEBO, run_with(**wrong)))


def test_both_simulators_get_the_same_site_and_car_and_nothing_waits(tmp_path):
    options = RunOptions(tmp_path, site="/a/yard.yaml", car="honest")
    gazebo, mujoco = stack_options(GAZEBO, options), stack_options(MUJOCO, options)
    for each in (gazebo, mujoco):
        assert (each.arguments["scenario"], each.arguments["car"]) == ("/a/yard.yaml", "honest")
        assert each.real_time_factor == 1.0
    assert mujoco.arguments["lockstep"] == "false" and gazebo.launch == ("mtr_gazebo", "gazebo.launch")
    assert gazebo.lockstep_operator is None


def test_what_the_robot_touched_is_read_from_the_simulators_words():
    log = "[WARN] The robot touches car at 12.30 s.\nother\n[WARN] [9.1]: The robot touches parked_0 at 3 s.\n"
    assert touched_in(log) == ("car", "parked_0")


def test_a_scenario_without_results_has_no_lines(tmp_path, capsys):
    assert lines_of(RunOptions(tmp_path), "autolock") == []
    assert "results.csv" in capsys.readouterr().err
