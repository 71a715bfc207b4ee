"""Content of the range benchmark's picture, and incomplete figures."""
# SPDX-License-Identifier: Apache-2.0
import json

import pytest

from mtr_benchmarks.ranges import picture
from mtr_benchmarks.ranges.campaigns import WIDTHS_M


def figures(bias_m, rms_m, coverage, time_s):
    return {f"steady/{width_m:g}": {"bias_m": bias_m, "rms_m": rms_m, "coverage_95": coverage,
                                    "robot_time_s_median": time_s, "lines": 24.0} for width_m in WIDTHS_M}


@pytest.fixture(name="details")
def details_fixture():
    return {"scan": figures(3.0, 5.0, 0.02, 150.0), "adaptive": figures(0.0, 0.2, 0.95, 60.0)}


def test_bar_is_the_spread_about_the_bias(details):
    assert [point.sigma_m for point in picture.points(details, "scan")] == pytest.approx(len(WIDTHS_M) * [4.0])


def test_note_states_coverage_and_times_of_the_benchmark(details):
    details["adaptive"]["steady/4"]["coverage_95"] = 0.97
    note = picture.note(details)
    assert "95 to 97 %" in note and "scan 150 s, search 60 s" in note and "24 radials" in note


def test_each_method_has_a_point_for_each_width(details):
    axes = picture.draw(details).axes[0]
    assert [len(container.lines[0].get_xdata()) for container in axes.containers] == 2 * [len(WIDTHS_M)]
    assert len(axes.get_xticks()) == len(WIDTHS_M)


def test_picture_is_written(details, tmp_path):
    (tmp_path / "range.json").write_text(json.dumps({"details": details}))
    assert picture.main([str(tmp_path / "range.json"), str(tmp_path / "figure.png")]) == 0
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")


def test_benchmark_without_one_of_the_widths_gives_no_picture(details):
    del details["scan"]["steady/4"]
    with pytest.raises(KeyError, match="steady/4"):
        picture.draw(details)
