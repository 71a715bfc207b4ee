"""What a test is likely to take and to tell, before the start and with what is measured."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.estimation.field.forecast import SHARP, SOFT, USUAL, zone_forecast
from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.scenarios.zone_map.parameters import ZoneMapParameters
from mtr_operator.domain.scenarios.zone_map.result import ZoneMapResult

KEY_PRESS, AUTOLOCK, ZONE_MAP = SCENARIOS["key_press"], SCENARIOS["autolock"], SCENARIOS["zone_map"]
PARAMETERS = KeyPressParameters.from_mapping({"method": "adaptive"})
FACTS = LockFacts(told_every_s=0.2)


def radial(number, d50_m, d95_m):
    return KeyPressResult(number, 0.0, LineStatus.OK, d95_m, None, 0.03, 12, 1.0, "", method="adaptive",
                          reach="measured", d50_m=d50_m, d50_sigma_m=0.1, d95_m=d95_m)


def test_search_takes_more_presses_and_tells_less_where_the_range_ends_softly():
    forecast = KEY_PRESS.forecast(PARAMETERS, FACTS, ())
    assert forecast.attempts[0] < forecast.attempts[1] == 24
    assert forecast.interval_m[0] == 0.25 < forecast.interval_m[1]
    assert forecast.line_s[0] < forecast.line_s[1]
    assert KEY_PRESS.expected_line_s(PARAMETERS) == pytest.approx(sum(forecast.line_s) / 2.0)
    assert forecast.text.startswith(
        f"attempts on each line: {forecast.attempts[0]} to 24; 95 % interval \N{PLUS-MINUS SIGN}0.25 to ")


def test_radials_that_are_measured_say_what_the_others_will_take():
    before = KEY_PRESS.forecast(PARAMETERS, FACTS, ())
    sharp = KEY_PRESS.forecast(PARAMETERS, FACTS, [radial(1, 5.0, 4.9), radial(2, 6.0, 5.9)])
    soft = KEY_PRESS.forecast(PARAMETERS, FACTS, [radial(1, 5.0, 3.0), radial(2, 6.0, 4.0)])
    assert sharp.attempts[1] < before.attempts[1] and sharp.interval_m[1] < before.interval_m[1]
    assert soft.interval_m[0] > before.interval_m[0]


def test_interval_within_reach_is_no_reason_for_a_caution():
    assert KEY_PRESS.cautions(PARAMETERS, FACTS) == ()
    assert KEY_PRESS.cautions(replace(PARAMETERS, method="scan", attempts_limit=6), FACTS) == ()


def test_interval_out_of_reach_is_told_with_the_presses_that_would_reach_it():
    parameters = replace(PARAMETERS, attempts_limit=10, interval_m=0.2)
    caution, = KEY_PRESS.cautions(parameters, FACTS)
    assert caution.startswith("10 presses on each radial reach an interval of 0.")
    assert "interval_m asks for 0.20 m: allow " in caution
    presses = int(caution.split("allow ")[1].split()[0])
    assert KEY_PRESS.cautions(replace(parameters, attempts_limit=presses), FACTS) == ()
    interval_m = float(caution.rsplit("ask for ", 1)[1].split()[0])
    assert KEY_PRESS.cautions(replace(parameters, interval_m=interval_m), FACTS) == ()


def test_interval_that_no_number_of_presses_reaches_is_told_with_a_wider_one_only():
    caution, = KEY_PRESS.cautions(replace(PARAMETERS, interval_m=0.05), FACTS)
    assert "allow" not in caution and "ask for 0." in caution


def test_side_to_which_a_search_has_no_bound_is_not_taken_for_near_the_car():
    searched = radial(1, 5.0, 4.9)
    assert KEY_PRESS.unreached(PARAMETERS, searched, "press") == (None, None)
    assert KEY_PRESS.unreached(replace(PARAMETERS, method="scan"), replace(searched, method="scan"),
                               "press") == (None, 3.0)


def test_passes_at_two_speeds_have_an_interval_and_one_pass_has_none():
    one = AUTOLOCK.forecast(AutolockParameters(), FACTS, ())
    assert (one.attempts, one.interval_m) == ((1, 1), None)
    assert one.text == "attempts on each line: 1; no 95 % interval"
    two = AUTOLOCK.forecast(AutolockParameters(passes=2), FACTS, ())
    assert two.attempts == (2, 2)
    assert 0.0 < two.interval_m[0] <= 1.96 * 1.05 * AutolockParameters().boundary_sigma_m
    assert two.line_s[0] > one.line_s[0] and two.line_s[0] == AUTOLOCK.expected_line_s(AutolockParameters(passes=2))


def test_scan_takes_presses_from_the_first_place_to_the_last_and_gives_no_interval():
    scan = KeyPressParameters.from_mapping({"attempts": 2})
    forecast = KEY_PRESS.forecast(scan, FACTS, ())
    places = len(scan.press_distances_m)
    assert forecast.attempts == (2, 2 * (places - 1) + 2) and forecast.interval_m is None
    assert forecast.line_s[0] < KEY_PRESS.expected_line_s(scan) < forecast.line_s[1]
    one, more = (replace(radial(number, None, None), method="scan", attempts=attempts)
                 for number, attempts in ((1, 5), (2, 7)))
    assert KEY_PRESS.forecast(scan, FACTS, [one, more]).attempts == (5, 7)


def zone(number, presses, low, high):
    return ZoneMapResult(number, "front", 1.0, LineStatus.OK, presses, 3.0, 2.5, 3.5, 0.01, 0.5, low, high)


def test_zone_takes_more_presses_and_tells_less_of_its_coverage_where_the_field_falls_softly():
    forecast = ZONE_MAP.forecast(ZoneMapParameters(presses_limit=60), FACTS, ())
    assert 24 < forecast.attempts[0] < forecast.attempts[1] == 60
    assert forecast.coverage_percent[0] <= 10.0 < forecast.coverage_percent[1] < 13.0
    assert forecast.interval_m is None and forecast.line_s[0] < forecast.line_s[1]
    assert forecast.text.endswith(
        " to 60; 95 % interval of the coverage \N{PLUS-MINUS SIGN}10 to \N{PLUS-MINUS SIGN}11 %")


@pytest.mark.parametrize(("width", "low", "high"), [(0, 0.12, 0.14), (1, 0.15, 0.17), (2, 0.16, 0.18)])
def test_zone_s_forecast_is_what_was_measured_with_24_presses(width, low, high):
    found = zone_forecast(0.01, 24, (SHARP, USUAL, SOFT)[width])
    assert low < found.half_width < high and not found.is_reached and found.presses == 24


def test_zones_that_are_measured_say_what_the_others_will_take():
    forecast = ZONE_MAP.forecast(ZoneMapParameters(), FACTS, [zone(1, 16, 0.40, 0.70), zone(2, 9, 0.45, 0.63)])
    assert forecast.attempts == (9, 16)
    assert forecast.coverage_percent == pytest.approx((9.0, 15.0))


def test_coverage_out_of_reach_is_told_with_the_presses_and_the_interval_that_would_do():
    parameters = ZoneMapParameters(presses_limit=16, coverage_percent=10.0)
    caution, = ZONE_MAP.cautions(parameters, FACTS)
    assert caution.startswith("16 presses in each zone reach an interval of the coverage of ")
    assert "coverage_percent asks for 10 %: allow " in caution
    presses = int(caution.split("allow ")[1].split()[0])
    assert ZONE_MAP.cautions(replace(parameters, presses_limit=presses), FACTS) == ()
    percent = float(caution.rsplit("ask for ", 1)[1].split()[0])
    assert ZONE_MAP.cautions(replace(parameters, coverage_percent=percent), FACTS) == ()


def test_coverage_that_no_number_of_presses_reaches_is_told_with_a_wider_one_only():
    caution, = ZONE_MAP.cautions(ZoneMapParameters(coverage_percent=2.0), FACTS)
    assert "allow" not in caution and "ask for " in caution


def test_speed_of_a_single_pass_that_the_cycle_makes_meaningless_is_told_with_its_sigma_and_one_that_would_do():
    slow_bus = LockFacts(told_every_s=0.8)
    caution, = AUTOLOCK.cautions(AutolockParameters(), slow_bus)
    assert caution == ("At 1.00 m/s, with a message of the Car every 0.80 s, the distance of a pass has a sigma of "
                       "0.231 m by that message alone; boundary_sigma_m asks for 0.030 m. Pass at 0.12 m/s.")
    assert AUTOLOCK.cautions(AutolockParameters(measuring_speed_mps=0.12), slow_bus) == ()
    assert AUTOLOCK.cautions(AutolockParameters(), LockFacts(told_every_s=0.02)) == ()
    assert AUTOLOCK.cautions(AutolockParameters(last_step_m=0.05), slow_bus) == ()


def test_speeds_of_two_passes_beyond_the_budget_are_told_with_one_that_would_do():
    parameters = AutolockParameters(passes=2, measuring_speeds_mps=(0.8, 0.4))
    caution, = AUTOLOCK.cautions(parameters, FACTS)
    slow_mps = float(caution.split("Pass at ")[1].split()[0])
    assert AUTOLOCK.cautions(replace(parameters, measuring_speeds_mps=(0.8, slow_mps)), FACTS) == ()


@pytest.mark.parametrize("parameters", [AutolockParameters(boundary_sigma_m=0.005),
                                        AutolockParameters(passes=2, boundary_sigma_m=0.005)])
def test_budget_below_what_any_speed_gives_is_told_with_the_one_that_the_slowest_gives(parameters):
    facts = LockFacts(told_every_s=0.8)
    caution, = AUTOLOCK.cautions(parameters, facts)
    sigma_m = float(caution.split("Ask for ")[1].split()[0])
    speeds = {"measuring_speed_mps": 0.05} if parameters.passes == 1 else {"measuring_speeds_mps": (0.4, 0.05)}
    assert AUTOLOCK.cautions(replace(parameters, boundary_sigma_m=sigma_m, **speeds), facts) == ()
