"""Table of the localization benchmark: every promised row exists, and figures do not hide failures."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from chosen_errors import CAR, all_results, drive, errors, failed, result, rows

from mtr_benchmarks.harness.lines import line
from mtr_benchmarks.localization import real_time, report
from mtr_benchmarks.localization.drives.selection import (
    ABDUCT,
    ANY_CAR,
    KIDNAP,
    OPPOSED,
    PITCHED,
    PLAIN,
    RANGE_BIAS,
    SCENES,
    TILT,
)
from mtr_benchmarks.localization.judging import abduction, any_car, campaign, consistency, kidnapping, position_rows
from mtr_benchmarks.localization.judging.figures import joined
from mtr_benchmarks.localization.methods.outcome import MRPT_ICP, ODOMETRY_GYRO, THIS_SYSTEM, MethodOutcome
from mtr_benchmarks.localization.one_drive import RECORDING, DriveResult


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
    """Return a drive with a given normalised squared error."""
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
    assert any(remark.startswith(f"cones_{variant}_7; of as many honest ones ") for remark in named) is (
        variant != PITCHED)


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


def partly_unknown(scene, variant, share):
    """Return a correct drive without a valid pose for a share of its time."""
    unknown = errors(0.003)
    unknown.key_m[:round(100 * share)] = np.nan
    return DriveResult(drive(scene, variant, 7), {THIS_SYSTEM: MethodOutcome(unknown, 0.5, CAR)}, {}, [])


@pytest.mark.parametrize(("share", "met"), [(0.05, True), (0.06, False), (1.0, False)])
def test_one_drive_on_level_ground_that_does_not_know_its_pose_for_long_is_not_met(share, met):
    results = [*all_results(), partly_unknown("open", PLAIN, share)]
    found = rows(results)["open, pose not valid, worst drive"]
    assert (found["value"], found["met"], found["must"]) == (pytest.approx(share), met, 0.05)
    assert rows(results)["lot, pose not valid, worst drive"]["value"] == 0.0
    assert any(line(row).endswith("open_plain_7") for row in report.report(results, None).rows)


def test_drive_without_any_instant_never_knew_its_pose():
    empty = DriveResult(drive("far", PLAIN, 7), {THIS_SYSTEM: MethodOutcome(joined([]), 0.5, CAR)}, {}, [])
    assert rows([*all_results(), empty])["far, pose not valid, worst drive"]["value"] == 1.0


def test_further_error_tells_for_how_long_the_pose_was_not_valid():
    found = rows([*all_results(), partly_unknown("cones", TILT, 0.3)])["1 deg of tilt, pose not valid, worst drive"]
    assert (found["value"], found["must"], found["met"]) == (pytest.approx(0.3), None, True)
    assert found["mean_share"] == pytest.approx(0.3 / 9.0)


def without(name, results):
    """Return all drives except those with a prefix of the name."""
    return [each for each in results if not each.drive.name.startswith(name)]


@pytest.mark.parametrize(("variant", "name"), [
    (TILT, position_rows.TILTED.name), (RANGE_BIAS, position_rows.BIAS.name)])
def test_position_that_is_unknown_with_a_further_error_may_be_the_worst(variant, name):
    lost = [result("cones", variant, seed, np.nan) for seed in (1, 2)]
    found = rows([*without(f"cones_{variant}_", all_results()), *lost])[name]
    assert (found["value"], found["met"]) == (None, False)


def test_pitched_lidars_without_a_pose_in_one_scene_are_not_met():
    others = without("cones_pitched_", all_results())
    assert not rows([*others, result("cones", PITCHED, 1, np.nan)])[position_rows.PITCH.name]["met"]


def test_drive_that_never_has_a_pose_is_not_left_out_of_the_honest_ones():
    silent = errors(np.nan, nees=np.nan)
    lost = DriveResult(drive("lot", TILT, 7), {THIS_SYSTEM: MethodOutcome(silent, 0.5, CAR)}, {}, [])
    found = rows([*all_results(), lost])
    assert not found[consistency.SUREST.name]["met"] and not found[consistency.MOST_CAUTIOUS.name]["met"]
