"""Rows of the benchmark of the Operator's window."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_benchmarks.gui.__main__ import percentile_ms, report
from mtr_benchmarks.gui.day import DayFigures
from mtr_benchmarks.gui.robot import PATH_POINTS, POINTS, SeeingRobot
from mtr_benchmarks.gui.window import Times, Watch, WindowFigures
from mtr_operator.robot_link.conversions import status_message_from

GOOD = WindowFigures(99 * [0.004] + [0.02], 20 * [0.03], 31.0, 0.03, 0.1, 190.0, 0.5)

FLAT = DayFigures(8.0, 30, 9000, 6 * [190.0, 191.0, 189.0, 190.0])


def met(figures, starts_s=(1.0, 1.5, 3.0), day=FLAT):
    rows = report(figures, starts_s, Times(), day).rows
    assert len({row.requirement.name for row in rows}) == len(rows) == 10
    return [row.is_met for row in rows]


def test_good_figures_are_met_and_the_start_is_the_median():
    assert all(met(GOOD))
    assert report(GOOD, (1.0, 1.5, 3.0), Times(), FLAT).rows[-1].value == 1.5


@pytest.mark.parametrize(("changes", "row"), [
    ({"stop_s": 97 * [0.004] + 3 * [0.2]}, 0), ({"stop_s": [math.inf]}, 0), ({"stop_s": []}, 0),
    ({"picture_s": 10 * [0.03] + 2 * [0.3]}, 1), ({"frames_per_s": 20.0}, 2), ({"measuring_cores": 0.2}, 3),
    ({"rest_cores": 0.06}, 4), ({"memory_growth_mib": 20.0}, 6)])
def test_a_bad_figure_is_not_met(changes, row):
    assert [index for index, is_met in enumerate(met(GOOD._replace(**changes))) if not is_met] == [row]


def test_memory_that_grows_over_a_day_is_not_met():
    grown = DayFigures(8.0, 30, 9000, [190.0, 196.0, 202.0, 208.0])
    assert grown.slope_mib_per_h == pytest.approx((3.0, 3.0, 3.0))
    assert grown.growth_mib == pytest.approx(18.0)
    assert [index for index, is_met in enumerate(met(GOOD, day=grown)) if not is_met] == [7, 8]


def test_memory_of_which_chance_may_hide_growth_is_not_met():
    scattered = DayFigures(8.0, 30, 9000, [190.0, 230.0, 170.0, 225.0, 180.0, 235.0, 185.0, 200.0])
    slope, low, high = scattered.slope_mib_per_h
    assert low < 0.0 < slope < 2.0 < high
    assert [index for index, is_met in enumerate(met(GOOD, day=scattered)) if not is_met] == [8]


def test_one_odd_look_at_the_memory_is_no_growth():
    odd = DayFigures(8.0, 30, 9000, [190.0, 190.0, 190.0, 190.0, 240.0])
    assert odd.growth_mib == 0.0
    assert DayFigures(8.0, 30, 9000, 12 * [190.0] + [240.0] + 11 * [190.0]).slope_mib_per_h == (0.0, 0.0, 0.0)


def test_nothing_measured_is_not_known():
    assert percentile_ms([], 99.0) is None


def test_picture_counts_from_the_status_that_it_shows_first(monkeypatch):
    watch = Watch()
    now_s = iter([10.04, 10.07, 10.14])
    monkeypatch.setattr("mtr_benchmarks.gui.window.time.monotonic", lambda: next(now_s))
    watch.came_s = {1: 10.0, 2: 10.1}
    for newest in (1, 1, 2):
        watch.newest_id = lambda newest=newest: newest
        watch.painted()
    assert watch.picture_s == pytest.approx([0.04, 0.04])
    assert len(watch.paints_s) == 3


def test_robot_sees_as_much_as_the_link_carries():
    robot = SeeingRobot(1)
    robot.step()
    robot.step()
    told = [robot.status() for _ in range(2)]
    seen = next(status.surroundings for status in told if status.surroundings is not None)
    assert (len(seen.points), len(seen.path)) == (POINTS, PATH_POINTS)
    assert len(status_message_from(next(each for each in told if each.surroundings)).SerializeToString()) < 10_000
