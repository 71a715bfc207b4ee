"""Distances with different meanings or places are not compared, and the difference is reported."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import driven
import measured
import pytest

from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.digital_key.result import DigitalKeyResult
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.history.circumstances import differing_names
from mtr_operator.history.line_pairs import Side, line_pairs
from mtr_operator.history.same_lines import UNLIKE, Tests
from mtr_operator.history.spread import spread_of
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.history.statistics.difference import Change
from mtr_results.statistics.trend import trend

# A slow Car with boundaries at 2 m.
BOUNDARY_M, REACTION_S = 2.0, 1.5


def several(number):
    """Return a test with two passes and therefore static boundaries."""
    return driven.side(lambda *_: (BOUNDARY_M + 0.01 * number, BOUNDARY_M + 0.01 * number))


def one_pass(number, speed_mps=0.4):
    """Return a test of the same Car with one pass, which measures events only."""
    parameters = replace(driven.parameters(), passes=1, measuring_speeds_mps=(speed_mps,))
    event_m = BOUNDARY_M - REACTION_S * speed_mps + 0.01 * number
    nothing = {f"{word}_static_{name}": None for word in ("unlock", "lock")
               for name in ("m", "sigma_m", "low_m", "high_m", "common_sigma_m", "shared_sigma_m")}
    results = [replace(result, **nothing, unlock_distance_m=event_m, lock_distance_m=event_m,
                       **{f"{word}_pass_distances_m": (event_m,) for word in ("unlock", "lock")},
                       **{f"{word}_pass_speeds_mps": (speed_mps,) for word in ("unlock", "lock")})
               for result in several(number).progress.results]
    progress = Progress("autolock", parameters.to_mapping(), {"started": measured.STARTED}, driven.CAR, results)
    return Side(driven.SCENARIO, parameters, progress)


def scanned(place_m):
    """Return a test of one radial, measured with a scan."""
    parameters = replace(measured.parameters(), method="scan")
    result = KeyPressResult(1, 0.0, LineStatus.OK, place_m, place_m + 0.1, 0.01, 5, 1.0, "", method="scan")
    progress = Progress("key_press", parameters.to_mapping(), {}, measured.CAR, [result])
    return Side(measured.SCENARIO, parameters, progress)


@pytest.mark.parametrize("others", [
    [one_pass(number) for number in range(4)], [several(1), several(2), several(3), one_pass(0)]])
def test_event_of_one_pass_is_not_set_against_a_static_boundary(others):
    for first, second in (([several(number) for number in range(4)], others), (others, [several(number)
                                                                                        for number in range(4)])):
        found = compare_sets(first, second)
        assert {row.change for row in found.rows if row.line is not None} == {Change.NOT_KNOWN}
        assert not {row.change for row in found.rows} & {Change.FARTHER, Change.NEARER}
        assert any(UNLIKE in reason for reason in found.reasons)
        row = next(row for row in found.differing if row.name == "passes")
        assert {row.first, row.second} <= {"1", "2", "2, 1"} and row.is_parameter


def test_events_at_one_speed_are_compared_and_at_two_are_not():
    fast = [one_pass(number) for number in range(4)]
    alike = compare_sets(fast, [one_pass(number + 1) for number in range(4)])
    assert Change.NOT_KNOWN not in {row.change for row in alike.rows} and alike.reasons == []
    unlike = compare_sets(fast, [one_pass(number, 0.1) for number in range(4)])
    assert {row.change for row in unlike.rows if row.line is not None} == {Change.NOT_KNOWN}


def test_axis_that_was_not_reached_bounds_boundary_and_event():
    silent = one_pass(0)
    silent.progress.results[0] = replace(silent.progress.results[0], unlock_status=LineStatus.NOT_REACHED,
                                         unlock_distance_m=None)
    known = Tests([several(0), silent]).distance(1, 1, "unlock")
    assert (known.high, known.reason) == (0.5, "")


def test_spread_and_trend_leave_out_what_is_another_thing_and_say_so():
    sides = [*(several(number) for number in range(5)), one_pass(0)]
    spread = spread_of(sides)
    assert (spread.distances[0].without, spread.distances[0].mean.reason) == (1, UNLIKE)
    assert {"passes", "measuring_speeds_mps"} <= set(spread.differing) == set(differing_names(sides))
    tests = Tests(sides)
    found = trend([tests.distance(test, 1, "unlock") for test in range(6)])
    assert (found.beyond, found.unlike) == ([], UNLIKE)
    assert trend([Tests(sides[:5]).distance(test, 1, "unlock") for test in range(5)]).unlike == ""


def test_farthest_press_of_a_scan_is_not_set_against_a_border():
    scans = [scanned(5.5 + 0.01 * number) for number in range(3)]
    borders = [measured.side(5.0 + 0.01 * number) for number in range(3)]
    row, = (row for row in compare_sets(borders, scans).rows if row.line is not None)
    assert (row.change, row.second.reason) == (Change.NOT_KNOWN, UNLIKE)


@pytest.mark.parametrize("height_m, count", [(1.04, 1), (1.06, 0)])
def test_line_at_another_height_of_the_key_is_another_one(height_m, count):
    first, second = measured.side(5.0), measured.side(5.0)
    first, second = (replace(side, parameters=replace(side.parameters, key_height_m=each_m))
                     for side, each_m in ((first, 1.0), (second, height_m)))
    assert len(line_pairs(first, second)[0]) == count


def phone(number, least_m):
    """Return a test with one reading of a phone."""
    scenario = SCENARIOS["digital_key"]
    parameters = scenario.parameters_type(minimum_distance_m=least_m)
    place = scenario.lines(parameters, measured.CAR)[number - 1]
    result = DigitalKeyResult(number, place.side, place.distance_m, 1.0, LineStatus.INVALID, reason="no")
    return Side(scenario, parameters, Progress("digital_key", parameters.to_mapping(), {}, measured.CAR, [result]))


def test_place_of_a_phone_is_not_taken_for_another_one_on_its_ray():
    assert len(line_pairs(phone(1, 0.5), phone(1, 0.5))[0]) == 1
    assert line_pairs(phone(1, 0.5), phone(2, 0.5))[0] == line_pairs(phone(1, 0.5), phone(1, 0.7))[0] == []
