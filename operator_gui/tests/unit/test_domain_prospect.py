"""What a test is likely to take and to tell, before the start and with what is measured."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult

KEY_PRESS, AUTOLOCK = SCENARIOS["key_press"], SCENARIOS["autolock"]
PARAMETERS = KeyPressParameters.from_mapping({"method": "adaptive"})
FACTS = LockFacts(told_every_s=0.2)


def radial(number, d50_m, d95_m):
    return KeyPressResult(number, 0.0, LineStatus.OK, d95_m, None, 0.03, 12, 1.0, "", method="adaptive",
                          reach="measured", d50_m=d50_m, d50_sigma_m=0.1, d95_m=d95_m)


def test_search_takes_more_presses_and_tells_less_where_the_range_ends_softly():
    prospect = KEY_PRESS.prospect(PARAMETERS, FACTS, ())
    assert prospect.attempts[0] < prospect.attempts[1] == 24
    assert prospect.interval_m[0] == 0.25 < prospect.interval_m[1]
    assert prospect.line_s[0] < prospect.line_s[1]
    assert KEY_PRESS.expected_line_s(PARAMETERS) == pytest.approx(sum(prospect.line_s) / 2.0)
    assert prospect.text.startswith(
        f"attempts on each line: {prospect.attempts[0]} to 24; 95 % interval \N{PLUS-MINUS SIGN}0.25 to ")


def test_radials_that_are_measured_say_what_the_others_will_take():
    before = KEY_PRESS.prospect(PARAMETERS, FACTS, ())
    sharp = KEY_PRESS.prospect(PARAMETERS, FACTS, [radial(1, 5.0, 4.9), radial(2, 6.0, 5.9)])
    soft = KEY_PRESS.prospect(PARAMETERS, FACTS, [radial(1, 5.0, 3.0), radial(2, 6.0, 4.0)])
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
    assert KEY_PRESS.unreached(PARAMETERS, "press") == (None, None)
    assert KEY_PRESS.unreached(replace(PARAMETERS, method="scan"), "press") == (None, 3.0)


def test_passes_at_two_speeds_have_an_interval_and_one_pass_has_none():
    one = AUTOLOCK.prospect(AutolockParameters(), FACTS, ())
    assert (one.attempts, one.interval_m) == ((1, 1), None)
    assert one.text == "attempts on each line: 1; no 95 % interval"
    two = AUTOLOCK.prospect(AutolockParameters(passes=2), FACTS, ())
    assert two.attempts == (2, 2)
    assert 0.0 < two.interval_m[0] <= 1.96 * 1.05 * AutolockParameters().boundary_sigma_m
    assert two.line_s[0] > one.line_s[0] and two.line_s[0] == AUTOLOCK.expected_line_s(AutolockParameters(passes=2))
