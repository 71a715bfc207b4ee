"""Intervals of results.csv compared with the truth, and the share of intervals that contain it."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_simulation.truth.distance import Comparison, Expected
from mtr_simulation.truth.intervals import coverage, interval_table, read_intervals
from mtr_simulation.truth.results import MeasuredEvent, ResultsError

NAN = math.nan
AUTOLOCK = """# scenario: Autolock
axis,unlock_static_m,unlock_static_low_m,unlock_static_high_m,lock_static_m,lock_static_low_m,lock_static_high_m
1,1.50,1.40,1.60,2.50,2.40,2.60
2,1.20,1.10,1.30,,,
"""
KEY_PRESS = """radial,d50_m,d50_low_m,d50_high_m,d95_m,d95_low_m,d95_high_m
1,5.0,4.8,,4.0,3.5,4.2
2,,,,,,
"""


def truth(line, event, **distances_m):
    """Comparison of an event with the distances expected from the Car's model."""
    return Comparison(MeasuredEvent(line, event, "ok", NAN, NAN, NAN, "", (0.0, 0.0)), None, Expected(**distances_m))


@pytest.fixture
def file_of(tmp_path):
    def write(text):
        (tmp_path / "results.csv").write_text(text, encoding="utf-8")
        return tmp_path / "results.csv"
    return write


def test_static_boundaries_are_compared_with_their_intervals(file_of):
    told = read_intervals(file_of(AUTOLOCK), "autolock", [
        truth("1", "unlock", static_m=1.55), truth("1", "lock", static_m=2.7), truth("2", "unlock", static_m=1.0)])
    assert [(each.line, each.event, each.holds) for each in told] == [
        ("1", "unlock", True), ("1", "lock", False), ("2", "unlock", False)]
    assert "missed" in interval_table(told)[2] and "missed" not in interval_table(told)[1]
    assert coverage("autolock", told) == [
        "autolock: unlock, static: 1 of 2 intervals hold the truth (50 %); error rms 0.146 m, half width median "
        "0.100 m.",
        "autolock: lock, static: 0 of 1 intervals hold the truth (0 %); error rms 0.200 m, half width median 0.100 m."]


HANDLE = """axis,requests,d50_m,d50_low_m,d50_high_m,d95_m,d95_low_m,d95_high_m
2,14,1.6,1.4,1.8,1.2,,1.3
"""
ZONES = """zone,side,distance_m,low_m,high_m,coverage,coverage_low,coverage_high
1,front,3.0,2.5,3.5,0.50,0.40,0.60
2,front_right,,,,0.10,0.05,0.20
"""


def test_border_of_handle_requests_is_compared_with_its_intervals(file_of):
    told = read_intervals(file_of(HANDLE), "handle_request", [
        truth("2", "handle", p50_distance_m=1.7, p95_distance_m=1.4)])
    assert [(each.what, each.value, each.low, each.holds) for each in told] == [
        ("50 %", 1.6, 1.4, True), ("95 %", 1.2, -math.inf, False)]
    assert coverage("handle_request", told)[0] == (
        "handle_request: handle, 50 %: 1 of 1 intervals hold the truth (100 %); error rms 0.100 m, half width median "
        "0.200 m.")


def test_zone_s_reach_and_covered_part_are_compared_each_in_its_unit(file_of):
    told = read_intervals(file_of(ZONES), "zone_map", [
        truth("1", "reach", p50_distance_m=3.6, coverage=0.45), truth("2", "reach", coverage=0.3)])
    assert [(each.line, each.what, each.holds) for each in told] == [
        ("1", "50 %", False), ("1", "area", True), ("2", "area", False)]
    lines = interval_table(told)
    assert "found m" in lines[0] and "missed" in lines[1]
    assert lines[2].split() == ["line", "event", "what", "found", "95", "%", "interval", "true"]
    assert "missed" not in lines[3] and "missed" in lines[4]
    assert coverage("zone_map", told)[1] == (
        "zone_map: reach, area: 1 of 2 intervals hold the truth (50 %); error rms 0.146, half width median 0.087.")


def test_interval_without_an_end_is_open_there(file_of):
    told = read_intervals(file_of(KEY_PRESS), "key_press", [
        truth("1", "press", p50_distance_m=9.0, p95_distance_m=4.1), truth("2", "press", p50_distance_m=1.0)])
    assert [(each.what, each.holds) for each in told] == [("50 %", True), ("95 %", True)]
    assert "half width" not in coverage("key_press", told)[0]


def test_line_without_truth_or_interval_is_left_out(file_of):
    assert read_intervals(file_of(AUTOLOCK), "autolock", [truth("1", "unlock")]) == []
    assert read_intervals(file_of("axis,side\n1,left\n"), "autolock", [truth("1", "unlock", static_m=1.0)]) == []
    assert interval_table([]) == coverage("autolock", []) == []


def test_broken_number_is_told(file_of):
    with pytest.raises(ResultsError, match="unlock_static_m is 'x'"):
        read_intervals(file_of(AUTOLOCK.replace("1.50", "x")), "autolock", [])
