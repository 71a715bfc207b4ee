"""What a search records of a line: columns of its estimate, attempts of two measurements joined, limits on shares."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.distance import Distance
from mtr_operator.domain.estimation.interval import UNKNOWN, Interval
from mtr_operator.domain.estimation.press.radial_estimate import RadialEstimate, Reach
from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios.handle_request.result import HandleRequestResult
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import SCAN, KeyPressResult
from mtr_operator.domain.scenarios.line_search.attempt import AttemptMade, AttemptsMade
from mtr_operator.domain.scenarios.line_search.campaign import concluded, with_estimate
from mtr_operator.domain.scenarios.press.record import invalid_result, joined, result_of

RADIAL = radials_around(math.radians(22.5))[1]
# Presses from 3 to 9.5 m.
PLAN = KeyPressParameters(maximum_distance_m=10.0).search_plan
MEASURED = RadialEstimate(Reach.MEASURED, Interval(5.0, 4.8, 5.3, 0.1), Interval(4.5, 4.2, 4.7, 0.1), 4.9, 5.1, 10, (),
                          0.01, 0.6)


def made(distance_m, worked, sigma_m=0.03):
    """An attempt."""
    return AttemptMade(Distance(distance_m, sigma_m, 10.0 + distance_m, 0.01, 0.0, 1.0, 0.0, "key_button"), worked)


def result(*attempts, unconfirmed=()):
    """Of a radial with these presses."""
    return result_of(RADIAL, AttemptsMade([*attempts, *unconfirmed], list(unconfirmed)))


# The attempts of a line


def test_farthest_press_that_worked_is_told_with_the_next_one_that_failed():
    found = result(made(3.0, True), made(5.0, True), made(4.0, False), made(6.0, False), made(5.5, False))
    assert (found.distance_m, found.failed_distance_m, found.robot_time_s, found.attempts) == (5.0, 5.5, 15.0, 5)
    assert (found.worked_at_m, found.failed_at_m) == ((3.0, 5.0), (4.0, 6.0, 5.5))
    assert (found.uncertainty_m, found.place_sigma_m, found.cause) == (0.03, 0.03, "key_button")
    assert (found.place, found.reason, found.unconfirmed_m) == ("22.5\N{DEGREE SIGN}", "", "")


def test_press_that_failed_where_the_farthest_one_worked_is_not_farther():
    assert result(made(5.0, True), made(5.0, False), made(4.0, False)).failed_distance_m is None


def test_without_a_press_that_worked_the_nearest_one_that_failed_is_told():
    found = result(made(4.0, False), made(3.0, False))
    assert (found.distance_m, found.uncertainty_m, found.failed_distance_m) == (None, None, 3.0)


def test_press_that_worked_against_all_expectation_is_told_and_not_counted():
    found = result(made(5.0, True), unconfirmed=[made(8.0, True, 0.2), made(8.123, False, 0.2)])
    assert (found.unconfirmed_m, found.attempts, found.distance_m) == ("8.00 8.12", 3, 5.0)
    assert (found.worked_at_m, found.failed_at_m, found.place_sigma_m) == ((5.0,), (), 0.03)


def test_press_that_is_like_an_unconfirmed_one_counts():
    assert result(made(8.0, True), unconfirmed=[made(8.0, True)]).worked_at_m == (8.0,)


def test_places_are_recorded_to_micrometres_with_the_largest_sigma_that_is_known():
    found = result(made(5.0000004, True, 0.03), made(6.0000006, False, 0.05))
    assert (found.worked_at_m, found.failed_at_m, found.place_sigma_m) == ((5.0,), (6.000001,), 0.05)
    assert result(made(5.0, True, math.nan)).place_sigma_m is None
    assert result().place_sigma_m is None


def test_invalid_radial_keeps_its_presses_with_the_reason():
    found = invalid_result(RADIAL, AttemptsMade([made(5.0, True), made(6.0, False)]), "The bus is off.", ("frame",))
    assert (found.status, found.distance_m, found.attempts) == (LineStatus.INVALID, None, 2)
    assert (found.reason, found.evidence, found.worked_at_m) == ("The bus is off.", ("frame",), (5.0,))


@pytest.mark.parametrize("farther_first", [False, True])
def test_radial_that_is_measured_further_has_the_presses_of_both_and_the_farthest_of_them(farther_first):
    near, far = result(made(4.0, True, 0.05), made(6.0, False, 0.05)), result(made(5.0, True), made(5.5, False))
    before, after = (far, near) if farther_first else (near, far)
    both = joined(replace(before, unconfirmed_m="8.00"), after)
    assert (both.attempts, both.distance_m, both.robot_time_s, both.failed_distance_m) == (4, 5.0, 15.0, 5.5)
    assert both.worked_at_m == before.worked_at_m + after.worked_at_m
    assert both.failed_at_m == before.failed_at_m + after.failed_at_m
    assert (both.place_sigma_m, both.uncertainty_m, both.unconfirmed_m) == (0.05, 0.03, "8.00")


@pytest.mark.parametrize("worked_first", [False, True])
def test_press_that_worked_is_kept_beside_a_measurement_in_which_none_did(worked_first):
    worked, failed = result(made(4.0, True)), result(made(6.0, False))
    both = joined(worked, failed) if worked_first else joined(failed, worked)
    assert (both.distance_m, both.failed_distance_m) == (4.0, 6.0)


# The estimate's columns


def columns(found, place_sigma_m=0.0):
    """d50, d95 with the ends of their intervals."""
    with_columns = with_estimate(PLAN, replace(result(made(5.0, True)), place_sigma_m=place_sigma_m), found)
    return [tuple(getattr(with_columns, f"{name}_{end}") for end in ("m", "low_m", "high_m"))
            for name in ("d50", "d95")]


def test_estimate_is_recorded_with_what_else_it_says():
    told = with_estimate(PLAN, result(made(5.0, True)), replace(MEASURED, holes_m=(3.1, 4.204)))
    assert (told.status, told.reach, told.nearest_failure_m) == (LineStatus.OK, "measured", 5.1)
    assert (told.holes_m, told.lapse, told.fit_quality) == ("3.10 4.20", 0.01, 0.6)
    assert told.d50_sigma_m == pytest.approx(math.hypot(0.1, 0.03), abs=1e-6)
    assert columns(MEASURED) == [pytest.approx((5.0, 4.8, 5.3)), pytest.approx((4.5, 4.2, 4.7))]
    # 1.96 sigma of the places, and the estimate's own half of the interval.
    assert columns(MEASURED, 0.1)[0][1:] == pytest.approx((5.0 - math.hypot(0.2, 0.196), 5.0 + math.hypot(0.3, 0.196)),
                                                          abs=1e-4)


def test_end_of_an_interval_at_the_last_place_is_told_and_one_beyond_is_not():
    at_ends = replace(MEASURED, d50=Interval(5.0, 3.0, 9.5, 1.0), d95=Interval(3.0, 2.9, 9.6, 1.0))
    assert columns(at_ends) == [pytest.approx((5.0, 3.0, 9.5)), (3.0, None, None)]
    assert columns(replace(MEASURED, d95=Interval(2.9, 2.8, 3.4, 0.2)))[1] == (None, None, pytest.approx(3.4))


@pytest.mark.parametrize(("reach", "status", "low_m", "high_m"), [
    (Reach.NEARER, LineStatus.NOT_REACHED, None, 5.3), (Reach.FARTHER, LineStatus.NOT_REACHED, 4.8, None)])
def test_boundary_beyond_the_places_has_one_end_and_no_value(reach, status, low_m, high_m):
    found = replace(MEASURED, reach=reach)
    assert columns(found)[0] == (None, low_m and pytest.approx(low_m), high_m and pytest.approx(high_m))
    told = with_estimate(PLAN, result(made(5.0, True)), found)
    assert (told.status, told.reach, told.d50_sigma_m) == (status, reach.value, None)


def test_what_nobody_knows_is_left_empty():
    told = with_estimate(PLAN, result(made(5.0, True)), replace(MEASURED, d95=UNKNOWN, nearest_failure_m=None,
                                                                quality=math.nan))
    assert (told.d95_m, told.d95_low_m, told.nearest_failure_m, told.fit_quality) == (None, None, None, None)


def test_only_lines_that_were_searched_and_are_valid_speak_for_the_others():
    good = result(made(3.0, True), made(5.0, True), made(5.5, False), made(9.0, False))
    searched = replace(good, status=LineStatus.OK)
    assert [new.number for new in concluded(PLAN, [searched])] == [searched.number]
    scanned, invalid = replace(searched, method=SCAN), replace(searched, radial=2, status=LineStatus.INVALID)
    assert concluded(PLAN, [scanned, invalid]) == []


# What limits ask of a result

ESTIMATED = KeyPressResult(2, 22.5, LineStatus.OK, 4.9, None, 0.03, 12, 1.0, "", method="adaptive", reach="measured",
                           d50_m=5.0, d50_sigma_m=0.1, d50_low_m=4.8, d50_high_m=5.3, d95_m=4.5, d95_low_m=4.2,
                           d95_high_m=4.7)


def at(found, share_percent):
    """Distance and ends of a share."""
    distance, = found.distances_at(share_percent)
    assert (distance.word, distance.status) == ("press", found.status)
    return distance.distance_m, distance.low_m, distance.high_m


def test_share_of_5_percent_lies_as_far_beyond_the_half_as_95_percent_do_before_it():
    assert at(ESTIMATED, 95) == (4.5, 4.2, 4.7)
    assert at(ESTIMATED, 50) == (5.0, 4.8, 5.3)
    assert at(ESTIMATED, 5) == pytest.approx((5.5, 2 * 4.8 - 4.7, 2 * 5.3 - 4.2))


def test_end_that_is_open_on_one_side_of_the_half_is_open_on_the_other():
    assert at(replace(ESTIMATED, d95_low_m=None), 5)[1:] == (pytest.approx(4.9), None)
    assert at(replace(ESTIMATED, d50_low_m=None), 5)[1:] == (None, pytest.approx(6.4))


def test_share_without_an_interval_and_any_but_the_boundary_of_a_scan_are_not_known():
    assert ESTIMATED.distances_at(90) == ()
    scanned = replace(ESTIMATED, method=SCAN)
    assert scanned.distances_at(95) == scanned.distances_at(5) == ()
    assert at(scanned, 50) == (4.9, None, None)


def test_axis_of_handle_requests_is_always_searched_and_has_its_share_of_95_percent():
    axis = HandleRequestResult(1, "left", 1.0, LineStatus.OK, 4, 2, 2, d50_m=1.5, d95_m=1.3, d95_low_m=1.2,
                               d95_high_m=1.4)
    sure, = axis.distances_at(95)
    assert (sure.word, sure.distance_m, sure.low_m, sure.high_m) == ("handle", 1.3, 1.2, 1.4)


def test_holes_nearer_than_a_limit_are_those_before_it():
    holes = replace(ESTIMATED, holes_m="3.10 4.20 6")
    assert holes.holes_nearer_than(4.2) == (3.1,) and holes.holes_nearer_than(7.0) == (3.1, 4.2, 6.0)


def test_result_may_hold_a_thousand_presses_and_no_more():
    assert replace(ESTIMATED, worked_at_m=600 * (4.0,), failed_at_m=400 * (6.0,)).is_possible
    assert not replace(ESTIMATED, worked_at_m=600 * (4.0,), failed_at_m=401 * (6.0,)).is_possible
