"""The benchmark's figures and its table say what the errors say, and no failure hides behind them."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from mtr_benchmarks.localization import campaign, drives, kidnapping, real_time, report, table
from mtr_benchmarks.localization.drives import Drive
from mtr_benchmarks.localization.errors import Errors
from mtr_benchmarks.localization.figures import joined, scene_figures
from mtr_benchmarks.localization.methods import MRPT_ICP, ODOMETRY_GYRO, THIS_SYSTEM, Outcome
from mtr_benchmarks.localization.one_drive import RECORDING, DriveResult

CAR = {"position_error_m": 0.003, "yaw_error_deg": 0.1, "length_error_m": -0.004, "width_error_m": 0.006,
       "length_error_body_m": -0.04, "width_error_body_m": -0.03, "only_wheels": False}


def errors(key_m, standing=True, on_axis=False, beyond_m=2.0):
    """A hundred rows of the same."""
    one = np.ones(100)
    return Errors(0.02 * np.arange(100), key_m * one, 0.1 * one, 3.0 * one, np.full(100, standing),
                  np.full(100, on_axis), beyond_m * one)


def outcome(key_m, standing=True):
    return Outcome(errors(key_m, standing), 0.5, CAR)


def result(scene, variant, seed, key_m):
    """A drive with rows near the Car, far out, and on an axis."""
    parts = [errors(key_m), errors(key_m, beyond_m=9.9), errors(key_m, standing=False, on_axis=True)]
    return DriveResult(Drive(drives.options(scene, seed), variant), {THIS_SYSTEM: Outcome(joined(parts), 0.5, CAR)},
                       {}, [])


def all_results(key_m=0.004, biased_m=0.006, tilted_m=0.005):
    """Two seeds of everything that the table asks for."""
    return [result(scene, variant, seed, each_m) for scene in drives.SCENES for seed in (1, 2)
            for variant, each_m in ((drives.PLAIN, key_m), (drives.RANGE_BIAS, biased_m), (drives.TILT, tilted_m))]


def rows(results):
    return {row["name"]: row for row in report.document(results, {})["table"]}


def test_table_has_every_row_of_the_goals_and_meets_them():
    found = rows(all_results())
    assert found["lot, standing"]["value"] == pytest.approx(0.004)
    assert found["lot, moving 0.5 m/s"]["value"] == pytest.approx(0.004)
    assert found["open, standing 10 m out"]["value"] == pytest.approx(0.004)
    assert found["yaw, all scenes, standing"]["value"] == pytest.approx(0.1)
    assert found["Car's length and width, in the LiDAR's plane"]["value"] == pytest.approx(0.006)
    assert found[table.BIAS.name]["value"] == pytest.approx(0.002)
    assert found[table.TILTED.name]["value"] == pytest.approx(1.25)
    assert all(row["met"] for name, row in found.items() if name != table.SIZE_BODY.name)
    assert found[table.SIZE_BODY.name]["met"] is False


@pytest.mark.parametrize(("key_m", "met", "goal_met"), [(0.0049, True, True), (0.0051, True, False),
                                                        (0.0121, False, False)])
def test_row_is_judged_by_its_own_limits(key_m, met, goal_met):
    row = rows(all_results(key_m=key_m, biased_m=key_m, tilted_m=key_m))["lot, standing"]
    assert (row["met"], row["goal_met"]) == (met, goal_met)


@pytest.mark.parametrize("method", [THIS_SYSTEM, RECORDING])
def test_row_with_a_failed_drive_is_not_met(method):
    failed = DriveResult(Drive(drives.options("lot", 9), drives.PLAIN), {}, {method: "The Car was not located."}, [])
    found = rows([*all_results(), failed])
    assert found["lot, standing"]["met"] is False
    assert found["lot, standing"]["failed_drives"] == 1
    assert found["far, standing"]["met"] is True


def test_failure_of_another_method_does_not_count_against_this_system():
    failed = DriveResult(Drive(drives.options("lot", 9), drives.PLAIN), {}, {MRPT_ICP: "It ended with 1."}, [])
    assert rows([*all_results(), failed])["lot, standing"]["met"] is True


def test_row_without_a_value_is_not_met():
    assert not rows([result("lot", drives.PLAIN, 1, 0.001)])["far, standing"]["met"]


def test_failures_are_in_the_document_and_in_the_lines():
    failed = DriveResult(Drive(drives.options("lot", 9), drives.PLAIN), {}, {THIS_SYSTEM: "No Car."}, [])
    written = report.document([*all_results(), failed], {})
    assert written["failures"] == {"lot_plain_9": {THIS_SYSTEM: "No Car."}}
    assert any("No Car." in line for line in report.lines(written))


def test_scene_figures_have_every_key_for_every_method():
    written = report.document(all_results(), {})
    keys = {"online_rmse_m", "online_p95_m", "online_max_m", "standstill_p95_m", "yaw_p95_deg", "car_pose_p95_m",
            "car_yaw_p95_deg", "length_error_m", "width_error_m", "nees_ratio", "cpu_ms_per_scan"}
    for scene in drives.SCENES:
        for method in (THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP):
            assert keys <= written["scenes"][scene][method].keys()


def test_scene_figures_join_the_rows_of_all_drives():
    found = scene_figures([outcome(0.01), outcome(0.03, standing=False)])
    assert found["online_rmse_m"] == pytest.approx((0.5 * (0.01**2 + 0.03**2)) ** 0.5)
    assert found["standstill_p95_m"] == pytest.approx(0.01)
    assert found["online_max_m"] == pytest.approx(0.03)
    assert found["nees_ratio"] == pytest.approx(1.0)


def test_cars_that_show_only_wheels_do_not_count_for_length():
    wheels = Outcome(errors(0.01), 0.5, {**CAR, "length_error_m": 1.0, "only_wheels": True})
    assert scene_figures([wheels, outcome(0.01)])["length_error_m"] == pytest.approx(0.004)


def test_unknown_poses_are_a_share_and_not_an_error_of_zero():
    found = scene_figures([outcome(float("nan")), outcome(0.01)])
    assert found["unknown_share"] == pytest.approx(0.5)
    assert found["online_rmse_m"] == pytest.approx(0.01)


def kidnapped(key_m):
    stamps = np.arange(0.0, 20.0, 0.02)
    values = np.full(len(stamps), 0.005)
    for (begin_s, end_s), error_m in key_m.items():
        values[(stamps >= begin_s) & (stamps < end_s)] = error_m
    one = np.ones(len(stamps))
    fate = kidnapping.kidnapping(Errors(stamps, values, one, one, one > 0, one < 0, one),
                                 [{"kind": "kidnap", "begin_s": 4.0}])
    return fate, kidnapping.figures([fate])


def test_kidnapping_that_is_noticed_and_recovered_from_is_met():
    fate, figures = kidnapped({(4.0, 4.5): 2.0, (4.5, 9.0): float("nan")})
    assert fate.detected_s == pytest.approx(0.5, abs=0.03)
    assert fate.recovered_s == pytest.approx(5.0, abs=0.03)
    assert figures["met"]


def test_kidnapped_robot_that_stops_for_good_is_met():
    fate, figures = kidnapped({(4.0, 5.0): 2.0, (5.0, 20.0): float("nan")})
    assert fate.recovered_s is None
    assert figures["met"]


@pytest.mark.parametrize("course", [
    {(4.0, 7.0): 2.0, (7.0, 20.0): float("nan")},
    {(4.0, 20.0): 2.0},
    {(4.0, 4.5): 2.0, (4.5, 8.0): float("nan"), (8.0, 20.0): 1.5},
])
def test_kidnapping_that_is_noticed_late_or_never_or_recovered_wrongly_is_not_met(course):
    assert not kidnapped(course)[1]["met"]


def test_campaign_compares_its_first_with_its_last_part():
    stamps = np.arange(0.0, 8.0 * 3600.0, 1.0)
    one = np.ones(len(stamps))
    grown = 0.001 + 0.01 * stamps / stamps[-1]
    found = campaign.figures(Errors(stamps, grown, one, one, one > 0, one < 0, one))
    assert found["first_standstill_p95_m"] == pytest.approx(0.001 + 0.01 / 8.0, abs=2e-4)
    assert found["last_standstill_p95_m"] == pytest.approx(0.011, abs=2e-4)
    assert found["part_s"] == 3600.0


def test_latency_is_met_only_when_every_sweep_is_answered_in_time():
    in_time = [1.0] * 99 + [14.0]
    assert real_time.figures(in_time, 0, 6.0)["met"]
    assert not real_time.figures(in_time, 1, 6.0)["met"]
    assert not real_time.figures([1.0] * 90 + [16.0] * 10, 0, 6.0)["met"]
    assert not real_time.figures(in_time, 0, 10.1)["met"]


def test_campaign_kidnapping_and_latency_are_told_to_a_person():
    written = report.document(all_results(), real_time.figures([1.0] * 100, 0, 6.0))
    written["campaign"] = [campaign.figures(errors(0.004))]
    written["kidnapped"] = kidnapping.figures([kidnapping.Kidnapping(0.5, None, 0.0)])
    said = report.lines(written)
    assert "Campaign of 0.0 h, standing: 0.40 cm at the beginning, 0.40 cm at the end." in said
    assert any(line.startswith("Kidnapped: 1 of 1 noticed, the slowest after 0.50 s; 0 recovered") for line in said)
    assert any(line.startswith("Sweep to tf: 1.0 ms (median), 1.0 ms (99 %), 0 of 100 without") for line in said)


@pytest.mark.parametrize(("variant", "name"), [(drives.RANGE_BIAS, table.BIAS.name), (drives.TILT, table.TILTED.name)])
def test_failed_drive_with_a_further_error_is_not_met(variant, name):
    failed = DriveResult(Drive(drives.options("lot", 9), variant), {}, {THIS_SYSTEM: "The Car was not located."}, [])
    assert rows(all_results())[name]["met"] is True
    assert rows([*all_results(), failed])[name]["met"] is False


def test_row_says_for_how_long_the_position_was_unknown():
    half = joined([errors(0.004), errors(np.nan)])
    found = rows([DriveResult(Drive(drives.options("lot", 1), drives.PLAIN), {THIS_SYSTEM: Outcome(half, 0.5, CAR)},
                              {}, [])])["lot, standing"]
    assert found["unknown_share"] == pytest.approx(0.5)
    assert found["value"] == pytest.approx(0.004)
    assert table.printed(found).endswith("unknown for 50.0 % of the time")
