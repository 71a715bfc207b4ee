"""Benchmark of ranges: properties of its Cars, figures and verdicts."""
# SPDX-License-Identifier: Apache-2.0
import math
import random

import numpy as np
import pytest

from mtr_benchmarks.ranges import referees
from mtr_benchmarks.ranges.campaigns import FADINGS, POLLINGS, WIDTHS_M, Amount, Task, run_task, tasks
from mtr_benchmarks.ranges.cars import Polling, Radial, Radio, noticed_at
from mtr_benchmarks.ranges.pass_methods import AxesDraw
from mtr_benchmarks.ranges.phones import Coverage, Phone, coverage
from mtr_benchmarks.ranges.phones import figures as feed
from mtr_benchmarks.ranges.press_methods import Draw, scan
from mtr_benchmarks.ranges.referees import up_and_down
from mtr_benchmarks.ranges.repeated import pairs_agree
from mtr_benchmarks.ranges.result import LineFound, false_passes, figures, point, without_interval
from mtr_benchmarks.ranges.table import BIAS, RATIO, WITHOUT, phone_rows, report
from mtr_operator.domain.estimation.interval import UNKNOWN


@pytest.mark.parametrize("share", [0.0, 0.88])
def test_share_of_presses_that_work_is_the_curve_with_and_without_fading(share):
    worked = []
    for seed in range(1500):
        radial = Radial(Radio(2.0, share, 0.0), np.random.default_rng([seed, 0]), np.random.default_rng([seed, 1]))
        worked.append([radial.press(radial.d50_m), radial.press(radial.d95_m), radial.press(radial.d50_m + 1.0)])
    assert np.mean(worked, axis=0) == pytest.approx([0.5, 0.95, 0.1], abs=0.045)


def test_presses_at_one_place_agree_under_fading():
    pairs = []
    for seed in range(400):
        radial = Radial(Radio(2.0, 0.88, 0.0), np.random.default_rng([seed, 0]), np.random.default_rng([seed, 1]))
        pairs.append(radial.press(radial.mean_d50_m) == radial.press(radial.mean_d50_m))
    # Expectation for a bivariate normal distribution with a correlation of 0.88: 1/2 + asin(0.88) / pi.
    assert np.mean(pairs) == pytest.approx(0.5 + math.asin(0.88) / math.pi, abs=0.07)


@pytest.mark.parametrize("share", [0.0, 0.88])
def test_truth_of_a_narrow_radial_is_where_its_own_presses_end(share):
    for seed in range(20):
        radial = Radial(Radio(0.1, share, 0.0), np.random.default_rng([seed, 0]), np.random.default_rng([seed, 1]))
        assert all(radial.press(radial.d50_m - 0.2) for _ in range(5))
        assert not any(radial.press(radial.d50_m + 0.2) for _ in range(5))
        assert 0.0 < radial.d50_m - radial.d95_m < 0.1


def test_key_is_noticed_later_by_the_reaction_time():
    rng = np.random.default_rng(1)
    depths = [noticed_at(Polling(), 0.4, rng) for _ in range(800)]
    # The mean reaction time is one and a half polls plus the delay.
    assert np.mean(depths) == pytest.approx(0.4 * (1.5 * 0.3 + 0.03), abs=0.01)


def test_all_methods_measure_the_same_radials():
    draw = Draw(Radio(0.4, 0.0, 0.0), 3, 4)
    first, second = scan(draw), up_and_down(draw)
    assert [line.truth_m for line in first] == [line.truth_m for line in second]
    assert figures(first)["rms_m"] < 0.6 and figures(second)["rms_m"] < 0.6


class FarDesign:
    """Replaces senpy's design: it requests presses beyond the range, which senpy rejects if it has bounds."""

    def __init__(self, **options):
        assert not [name for name in options if "bound" in name]
        self.pressed_m = []

    def next_pt(self):
        return 25.0 if len(self.pressed_m) % 2 else -1.0

    def post_test_outcome(self, _worked, place_m):
        self.pressed_m.append(place_m)
        assert 3.0 <= place_m <= 20.0


def test_place_that_a_referee_wants_beyond_the_range_is_pressed_at_its_end(monkeypatch):
    monkeypatch.setattr(referees, "Neyer", FarDesign)
    found = referees.neyer(Draw(Radio(0.4, 0.0, 0.0), 3, 4), 2)
    assert [line.presses for line in found] == [24, 24]
    assert all(3.0 <= line.found.value_m <= 20.0 for line in found)


def test_method_without_intervals_has_no_coverage():
    found = figures([LineFound(1.0, point(1.1, math.nan)), LineFound(1.0, point(0.9, math.nan))])
    assert found["coverage_95"] is None and found["half_width_median_m"] is None
    assert found["rms_m"] == pytest.approx(0.1)


def test_passes_of_one_campaign_hold_their_boundaries():
    found = run_task(Task(("poll",), AxesDraw(Polling(), 11, 11)))
    assert figures(found[("passes", "poll")])["coverage_95"] >= 0.85
    assert figures(found[("passes", "poll")])["rms_m"] < 0.03 < figures(found[("single", "poll")])["rms_m"]


def test_seeds_of_all_campaigns_differ():
    made = [task.draw for task in tasks(Amount(100, 100, 1, 1)) if not task.key[0].startswith("again")]
    assert len({draw.place for draw in made}) == len(made)


def test_verdict_passes_no_car_that_is_to_fail_when_intervals_hold():
    honest = [LineFound(1.0, point(1.0 + error, 0.1)) for error in np.random.default_rng(2).normal(0.0, 0.1, 2000)]
    shares = false_passes(honest)
    assert shares["at least, missed by 0 m"] == pytest.approx(0.025, abs=0.012)
    assert shares["at most, missed by 0 m"] == pytest.approx(0.025, abs=0.012)
    assert shares["at least, missed by 1 m"] == 0.0
    too_far = false_passes([LineFound(1.0, point(1.3, 0.01))] * 3)
    assert too_far["at least, missed by 0.1 m"] == 1.0 and too_far["at least, missed by 1 m"] == 0.0


def test_pairs_of_campaigns_agree_within_their_sigmas():
    rng = np.random.default_rng(3)
    campaigns = [[LineFound(2.0, point(2.0 + error, 0.05)) for error in rng.normal(0.0, 0.05, 60)] for _ in range(4)]
    assert np.mean(pairs_agree(campaigns)) == pytest.approx(0.95, abs=0.04)


def test_line_without_an_interval_holds_nothing():
    known, unknown = LineFound(1.0, point(1.0, 0.1), 1, 1.0, 1.0, 0.9, point(0.9, 0.1)), LineFound(1.0, UNKNOWN)
    assert figures([known] * 3 + [unknown])["coverage_95"] == 0.75
    assert without_interval([known, unknown, known._replace(found_95=UNKNOWN)]) == 2
    assert math.isnan(figures([known, unknown])["bias_m"])


def test_line_without_an_interval_makes_no_share_of_false_passes_smaller():
    too_far, unknown = LineFound(1.0, point(1.3, 0.01)), LineFound(1.0, UNKNOWN)
    assert false_passes([too_far, unknown, unknown])["at least, missed by 0 m"] == 1.0
    assert all(math.isnan(value) for value in false_passes([unknown]).values())


def test_every_row_has_a_value_and_its_details():
    made = report(measured())
    assert [row.value is not None and row.value >= 0.0 for row in made.rows] == [True] * 14
    values = {row.requirement.name: row.value for row in made.rows}
    assert values["rms of d50 by the scan's, equal time, worst"] == pytest.approx(0.2, abs=0.06)
    assert values["presses for +-0.3 m, width 1 m"] == 9.0
    assert made.document()["details"]["adaptive"]["fading/6.6"]["lines"] == 300.0


@pytest.mark.parametrize("key", [("adaptive", "steady", "4"), ("adaptive", "fading", "0.4"),
                                 ("adaptive_scan_time", "fading", "1"), ("passes", "poll_300_cycle_200"),
                                 ("adaptive", "again_key_press")])
def test_one_line_without_an_interval_fails_the_table(key):
    found = measured()
    first, *others = found[key][1]
    found[key][1] = [first._replace(found=UNKNOWN), *others]
    row, = (each for each in report(found).rows if each.requirement is WITHOUT)
    assert row.value == 1 and not row.is_met and row.details == {"/".join(key): 1.0}


def test_value_that_is_no_number_is_the_worst_one():
    found = measured()
    for key in (("adaptive", "steady", "0.4"), ("adaptive_scan_time", "fading", "4")):
        found[key][0][7] = found[key][0][7]._replace(found=UNKNOWN)
    unmet = {row.requirement for row in report(found).rows if not row.is_met}
    assert {BIAS, RATIO} <= unmet


def measured():
    """Return lines of all methods and Cars with correct intervals."""
    rng = np.random.default_rng(4)

    def lines(sigma_m):
        return [[LineFound(9.0, point(9.0 + error, sigma_m), 9, 30.0, 10.0, 8.0, point(8.0 + error, sigma_m))
                 for error in rng.normal(0.0, sigma_m, 100)] for _ in range(3)]

    found = {("passes", kind): lines(0.012) for kind in POLLINGS}
    found.update({("adaptive", "again_key_press"): lines(0.1), ("passes", "again_autolock"): lines(0.012)})
    for fading in FADINGS:
        for width_m in WIDTHS_M:
            kind = (fading, f"{width_m:g}")
            found.update({("adaptive", *kind): lines(0.1), ("adaptive_scan_time", *kind): lines(0.1),
                          ("scan_beside", *kind): lines(0.5)})
    return found


def test_feed_of_a_phone_repeats_each_figure_until_the_next_one():
    heard = list(feed(Phone(2.0, has_age=True), 3.0, 20.0, random.Random(1)))
    changes = sum(before.distance_m != after.distance_m for before, after in zip(heard, heard[1:]))
    assert 9 <= changes <= 11 and len(heard) == pytest.approx(210, abs=2)
    assert 1.8 <= max(each.age_s for each in heard) <= 2.0 and min(each.age_s for each in heard) < 0.11


@pytest.mark.parametrize(("period_s", "valid"), [(0.5, 200), (4.0, 0)])
def test_places_of_a_phone_are_covered_or_invalid(period_s, valid):
    found = coverage(Phone(period_s), 5.0, 200, 1)
    assert found.valid == valid and (found.share is None) is (valid == 0)
    assert found.share is None or found.share >= 0.92


def test_row_of_phones_is_about_the_worst_kind_that_has_valid_places():
    least, most = phone_rows({"good": Coverage(100, 100, 95), "bad": Coverage(100, 50, 40), "none": Coverage(9, 0, 0)})
    assert (least.value, least.remark, most.value) == (0.8, "bad", 0.95)
    assert phone_rows({}) == []
