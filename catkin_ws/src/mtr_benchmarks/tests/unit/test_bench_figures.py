"""The benchmark's figures follow from the errors: of scenes, kidnappings, a campaign, and of real time."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict, replace

import numpy as np
import pytest
from chosen_errors import CAR, SEGMENTS, errors, kidnapped_errors

from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.localization import real_time
from mtr_benchmarks.localization.judging import campaign, kidnapping
from mtr_benchmarks.localization.judging.figures import scene_figures
from mtr_benchmarks.localization.methods.errors import PoseErrors
from mtr_benchmarks.localization.methods.outcome import MethodOutcome


def outcome(key_m, standing=True):
    return MethodOutcome(errors(key_m, standing), 0.5, CAR)


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
    {(0.0, 20.0): float("nan")},
    {(3.0, 4.0): 0.5, (4.0, 20.0): float("nan")},
])
def test_kidnapping_that_is_noticed_late_or_never_or_before_or_recovered_wrongly_is_not_met(course):
    assert not kidnapped(course)[1].met


def test_campaign_compares_its_first_with_its_last_part():
    stamps = np.arange(0.0, 8.0 * 3600.0, 1.0)
    one = np.ones(len(stamps))
    grown = 0.001 + 0.01 * stamps / stamps[-1]
    found = campaign.figures(PoseErrors(stamps, grown, one, np.ones((len(stamps), 3)), one > 0, one < 0, one))
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


def test_rows_without_a_must_are_met_whatever_they_are():
    worse = campaign.rows(campaign.figures(errors(1.0)))
    assert [row.as_json()["must"] for row in worse] == [None, None] and all_met(worse)
