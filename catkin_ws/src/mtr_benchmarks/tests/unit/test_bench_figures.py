"""The benchmark's figures and its table say what the errors say, and no failure hides behind them."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict, replace

import numpy as np
import pytest

from mtr_benchmarks.harness.lines import line
from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.localization import real_time, report
from mtr_benchmarks.localization.drives import selection
from mtr_benchmarks.localization.drives.selection import (
    ABDUCT,
    ANY_CAR,
    CAMPAIGN,
    KIDNAP,
    LIDAR_KINDS,
    LIDAR_SCENES,
    OPPOSED,
    PITCHED,
    PITCHED_SCENES,
    PLAIN,
    RANGE_BIAS,
    SCENES,
    TILT,
    BenchmarkDrive,
)
from mtr_benchmarks.localization.judging import abduction, any_car, campaign, consistency, kidnapping, position_rows
from mtr_benchmarks.localization.judging.any_car import CarVerdict
from mtr_benchmarks.localization.judging.figures import joined, scene_figures
from mtr_benchmarks.localization.methods.errors import PoseErrors
from mtr_benchmarks.localization.methods.outcome import (
    MRPT_ICP,
    ODOMETRY_GYRO,
    THIS_SYSTEM,
    CarErrors,
    MethodOutcome,
)
from mtr_benchmarks.localization.one_drive import RECORDING, DriveResult

CAR = CarErrors(
    position_error_m=0.003, along_error_m=0.003, across_error_m=0.0, yaw_error_deg=0.1, length_error_m=-0.004,
    width_error_m=0.006, length_plane_sigma_m=0.002, width_plane_sigma_m=0.002, length_error_body_m=-0.04,
    width_error_body_m=-0.03, length_sigma_m=0.01, width_sigma_m=0.01, sigmas=[0.001, 0.001, 0.001], only_wheels=False,
    warning="", key_frame_rmse_m=0.001)


FOUND_AGAIN = abduction.Fate(3.0, 90.0, True, 0.8, 6.0, abduction.RIGHT, 0.0, None, None)


def errors(key_m, standing=True, on_axis=False, beyond_m=2.0, nees=3.0):
    """A hundred rows of the same."""
    one = np.ones(100)
    return PoseErrors(0.02 * np.arange(100), key_m * one, 0.1 * one, nees * one, np.full(100, standing),
                  np.full(100, on_axis), beyond_m * one)


def outcome(key_m, standing=True):
    return MethodOutcome(errors(key_m, standing), 0.5, CAR)


def result(scene, variant, seed, key_m):
    """A drive with rows near the Car, far out, and on an axis."""
    parts = [errors(key_m), errors(key_m, beyond_m=9.9), errors(key_m, standing=False, on_axis=True)]
    return DriveResult(drive(scene, variant, seed), {THIS_SYSTEM: MethodOutcome(joined(parts), 0.5, CAR)}, {}, [])


def failed(scene, variant, method, sentence="The Car was not located."):
    """A drive that gave nothing."""
    return DriveResult(drive(scene, variant, 9), {}, {method: sentence}, [])


def drive(scene, variant, seed):
    return BenchmarkDrive(selection.options(scene, seed), variant)


def all_results(key_m=0.004, biased_m=0.006, tilted_m=0.005, opposed_m=0.0025, pitched_m=0.014):
    """Two seeds of everything that the table asks for."""
    found = [result(scene, variant, seed, each_m) for scene in SCENES for seed in (1, 2)
             for variant, each_m in ((PLAIN, key_m), (RANGE_BIAS, biased_m), (TILT, tilted_m),
                                    (OPPOSED, opposed_m))]
    found += [result(scene, PITCHED, seed, pitched_m) for scene in PITCHED_SCENES for seed in (1, 2)]
    found += [result(scene, variant, 1, key_m) for variant in LIDAR_KINDS for scene in LIDAR_SCENES]
    lifted = kidnapped_errors({(4.0, 4.5): 2.0, (4.5, 9.0): float("nan")})
    return [*found, result("lot", CAMPAIGN, 1, key_m),
            DriveResult(drive("lot", KIDNAP, 1), {THIS_SYSTEM: MethodOutcome(lifted, 0.5, CAR)}, {}, SEGMENTS),
            DriveResult(drive("lot", ABDUCT, 1), {}, {}, [], FOUND_AGAIN),
            DriveResult(drive("lot", ANY_CAR, 1), {}, {}, [], car=CarVerdict(any_car.RIGHT, "", {}, CAR))]


def rows(results):
    return {row["name"]: row for row in report.report(results, None).document()["table"]}


def test_table_has_every_row_of_the_goals_and_meets_them():
    found = rows(all_results())
    assert found["lot, standing"]["value"] == pytest.approx(0.004)
    assert found["lot, moving 0.5 m/s"]["value"] == pytest.approx(0.004)
    assert found["open, standing 10 m out"]["value"] == pytest.approx(0.004)
    assert found["yaw, all scenes, standing"]["value"] == pytest.approx(0.1)
    assert found["Car's length and width, in the LiDAR's plane"]["value"] == pytest.approx(0.006)
    assert found[position_rows.BIAS.name]["value"] == pytest.approx(0.002)
    assert found[position_rows.TILTED.name]["value"] == pytest.approx(1.25)
    assert all(row["met"] for name, row in found.items() if name != position_rows.SIZE_BODY.name)
    assert found[position_rows.SIZE_BODY.name]["met"] is False


def sure(scene, variant, seed, nees):
    """A drive whose normalised error squared is that."""
    return DriveResult(drive(scene, variant, seed),
                       {THIS_SYSTEM: MethodOutcome(errors(0.004, nees=nees), 0.5, CAR)}, {}, [])


@pytest.mark.parametrize(("variant", "nees", "surest", "most_cautious"), [
    (PLAIN, 3.0 * 1.79, True, True), (TILT, 3.0 * 1.81, False, True), (RANGE_BIAS, 3.0 * 0.51, True, True),
    (PLAIN, 3.0 * 0.49, True, False), (PITCHED, 3.0 * 9.0, True, True)])
def test_the_drive_that_is_worst_on_either_side_is_judged_and_named(variant, nees, surest, most_cautious):
    found = rows([*all_results(), sure("cones", variant, 7, nees)])
    assert found[consistency.SUREST.name]["met"] is surest
    assert found[consistency.MOST_CAUTIOUS.name]["met"] is most_cautious
    table = report.report([*all_results(), sure("cones", variant, 7, nees)], None).rows
    named = [row.remark for row in table if row.requirement in (consistency.SUREST, consistency.MOST_CAUTIOUS)]
    assert (f"cones_{variant}_7" in named) is (variant != PITCHED)


def test_drives_without_a_pose_are_no_honest_ones():
    found = rows([failed("lot", PLAIN, THIS_SYSTEM)])
    assert not found[consistency.SUREST.name]["met"] and not found[consistency.MOST_CAUTIOUS.name]["met"]


def test_a_pitched_lidar_is_judged_by_the_worse_scene():
    found = rows([*all_results(), result("cones", PITCHED, 3, 0.03), result("cones", PITCHED, 4, 0.03)])
    assert found[position_rows.PITCH.name]["value"] == pytest.approx(0.03)
    assert found[position_rows.PITCH.name]["met"] is False


def test_each_kind_of_lidar_has_a_row_by_its_data():
    found = rows(all_results())
    assert "open, standing, one LiDAR of 4000 beams over 360 deg at 5 Hz" in found
    assert "lot, standing, two LiDARs of 360 beams over 90 deg at 25 Hz" in found


@pytest.mark.parametrize(("key_m", "met", "goal_met"), [(0.0049, True, True), (0.0051, True, False),
                                                        (0.0121, False, False)])
def test_row_is_judged_by_its_own_limits(key_m, met, goal_met):
    row = rows(all_results(key_m=key_m, biased_m=key_m, tilted_m=key_m))["lot, standing"]
    assert (row["met"], row["goal_met"]) == (met, goal_met)


@pytest.mark.parametrize("method", [THIS_SYSTEM, RECORDING])
def test_row_with_a_failed_drive_is_not_met(method):
    found = rows([*all_results(), failed("lot", PLAIN, method)])
    assert found["lot, standing"]["met"] is False
    assert found["lot, standing"]["failed_drives"] == 1
    assert found["far, standing"]["met"] is True


def test_failure_of_another_method_does_not_count_against_this_system():
    assert rows([*all_results(), failed("lot", PLAIN, MRPT_ICP)])["lot, standing"]["met"] is True


def test_row_without_a_value_is_not_met():
    assert not rows([result("lot", PLAIN, 1, 0.001)])["far, standing"]["met"]


def test_failures_are_in_the_document_and_in_the_lines():
    found = report.report([*all_results(), failed("lot", PLAIN, THIS_SYSTEM, "No Car.")], None)
    assert found.document()["failures"] == {"lot_plain_9": {THIS_SYSTEM: "No Car."}}
    assert found.remarks == ["lot_plain_9, this_system: No Car."]


def test_scene_figures_have_every_key_for_every_method():
    written = report.report(all_results(), None).document()
    keys = {"online_rmse_m", "online_p95_m", "online_max_m", "standstill_p95_m", "yaw_p95_deg", "car_pose_p95_m",
            "car_yaw_p95_deg", "length_error_m", "width_error_m", "nees_ratio", "cpu_ms_per_scan"}
    for scene in SCENES:
        for method in (THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP):
            assert keys <= written["scenes"][scene][method].keys()


def test_scene_figures_join_the_rows_of_all_drives():
    found = asdict(scene_figures([outcome(0.01), outcome(0.03, standing=False)]))
    assert found["online_rmse_m"] == pytest.approx((0.5 * (0.01**2 + 0.03**2)) ** 0.5)
    assert found["standstill_p95_m"] == pytest.approx(0.01)
    assert found["online_max_m"] == pytest.approx(0.03)
    assert found["nees_ratio"] == pytest.approx(1.0)


def test_cars_that_show_only_wheels_do_not_count_for_length():
    wheels = MethodOutcome(errors(0.01), 0.5, replace(CAR, length_error_m=1.0, only_wheels=True))
    assert scene_figures([wheels, outcome(0.01)]).length_error_m == pytest.approx(0.004)


def test_unknown_poses_are_a_share_and_not_an_error_of_zero():
    found = asdict(scene_figures([outcome(float("nan")), outcome(0.01)]))
    assert found["unknown_share"] == pytest.approx(0.5)
    assert found["online_rmse_m"] == pytest.approx(0.01)


SEGMENTS = [{"kind": "kidnap", "begin_s": 4.0}]


def kidnapped_errors(key_m):
    """Errors of a robot that is lifted at 4 s; key_m has errors by (begin, end)."""
    stamps = np.arange(0.0, 20.0, 0.02)
    values = np.full(len(stamps), 0.005)
    for (begin_s, end_s), error_m in key_m.items():
        values[(stamps >= begin_s) & (stamps < end_s)] = error_m
    one = np.ones(len(stamps))
    return PoseErrors(stamps, values, one, one, one > 0, one < 0, one)


def kidnapped(key_m):
    fate = kidnapping.kidnapping(kidnapped_errors(key_m), SEGMENTS)
    found = kidnapping.figures([fate])
    assert all_met(kidnapping.rows(found)) == found.met
    return fate, found


def test_kidnapping_that_is_noticed_and_recovered_from_is_met():
    fate, figures = kidnapped({(4.0, 4.5): 2.0, (4.5, 9.0): float("nan")})
    assert fate.detected_s == pytest.approx(0.5, abs=0.03)
    assert fate.recovered_s == pytest.approx(5.0, abs=0.03)
    assert figures.met


def test_kidnapped_robot_that_stops_for_good_is_met():
    fate, figures = kidnapped({(4.0, 5.0): 2.0, (5.0, 20.0): float("nan")})
    assert fate.recovered_s is None
    assert figures.met


@pytest.mark.parametrize("course", [
    {(4.0, 7.0): 2.0, (7.0, 20.0): float("nan")},
    {(4.0, 20.0): 2.0},
    {(4.0, 4.5): 2.0, (4.5, 8.0): float("nan"), (8.0, 20.0): 1.5},
])
def test_kidnapping_that_is_noticed_late_or_never_or_recovered_wrongly_is_not_met(course):
    assert not kidnapped(course)[1].met


def test_campaign_compares_its_first_with_its_last_part():
    stamps = np.arange(0.0, 8.0 * 3600.0, 1.0)
    one = np.ones(len(stamps))
    grown = 0.001 + 0.01 * stamps / stamps[-1]
    found = campaign.figures(PoseErrors(stamps, grown, one, one, one > 0, one < 0, one))
    assert found.first_standstill_p95_m == pytest.approx(0.001 + 0.01 / 8.0, abs=2e-4)
    assert found.last_standstill_p95_m == pytest.approx(0.011, abs=2e-4)
    assert found.part_s == 3600.0


@pytest.mark.parametrize(("latencies_ms", "unanswered", "cpu_percent", "met"), [
    ([1.0] * 99 + [14.0], 0, 6.0, True), ([1.0] * 99 + [14.0], 1, 6.0, False),
    ([1.0] * 90 + [16.0] * 10, 0, 6.0, False),
    ([1.0] * 99 + [14.0], 0, 10.001, False)])
def test_real_time_is_met_only_when_every_sweep_is_answered_in_time(latencies_ms, unanswered, cpu_percent, met):
    found = real_time.figures(latencies_ms, unanswered, cpu_percent)
    assert found.as_json()["met"] is met and all_met(found.rows()) is met


def test_campaign_kidnapping_and_real_time_are_rows_of_the_table():
    found = report.report(all_results(), real_time.figures([1.0] * 100, 0, 6.0))
    values = {row.requirement.name: row.value for row in found.rows}
    assert values[campaign.FIRST.name] == values[campaign.LAST.name] == pytest.approx(0.004)
    assert values[kidnapping.DETECTION.name] == pytest.approx(0.5, abs=0.03)
    assert values[real_time.LATENCY.name] == 1.0 and values[real_time.UNANSWERED.name] == 0
    said = [line(row) for row in found.rows]
    assert any("1 of 1 noticed, 1 recovered, the others stood" in each for each in said)
    assert not [row.requirement.name for row in found.rows if not row.is_met
                and row.requirement is not position_rows.SIZE_BODY]


def test_rows_without_a_must_are_met_whatever_they_are():
    worse = campaign.rows(campaign.figures(errors(1.0)))
    assert [row.as_json()["must"] for row in worse] == [None, None] and all_met(worse)


@pytest.mark.parametrize(("variant", "name"), [
    (RANGE_BIAS, position_rows.BIAS.name), (TILT, position_rows.TILTED.name),
    (OPPOSED, position_rows.OPPOSED_BIAS.name), (KIDNAP, kidnapping.DETECTION.name),
    (ABDUCT, abduction.WRONG.name), (ANY_CAR, any_car.FOUND_CARS.name)])
def test_failed_drive_with_a_further_error_is_not_met(variant, name):
    assert rows(all_results())[name]["met"] is True
    assert rows([*all_results(), failed("lot", variant, THIS_SYSTEM)])[name]["met"] is False


@pytest.mark.parametrize("opposed_m, met", [(0.0025, True), (0.0035, False)])
def test_mean_error_with_opposed_ranges_is_judged_near_the_car(opposed_m, met):
    others = [DriveResult(drive("open", OPPOSED, seed), {THIS_SYSTEM: MethodOutcome(each, 0.5, CAR)}, {}, [])
              for seed, each in ((7, errors(np.nan)), (8, errors(1.0, beyond_m=9.9)))]
    found = rows([*all_results(opposed_m=opposed_m), *others])[position_rows.OPPOSED_BIAS.name]
    assert found["value"] == pytest.approx(opposed_m) and found["met"] is met


def test_row_says_for_how_long_the_position_was_unknown():
    half = joined([errors(0.004), errors(np.nan)])
    results = [DriveResult(drive("lot", PLAIN, 1), {THIS_SYSTEM: MethodOutcome(half, 0.5, CAR)}, {}, [])]
    found = rows(results)["lot, standing"]
    assert found["unknown_share"] == pytest.approx(0.5)
    assert found["value"] == pytest.approx(0.004)
    assert line(report.report(results, None).rows[0]).endswith("unknown for 50.0 % of the time")
