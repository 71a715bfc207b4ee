"""Looks at lines that are measured further: what is recorded, what survives, and by which interval is judged."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from dataclasses import replace

import pytest

from mtr_operator.domain.estimation.looks import ERROR_PER_SIDE, deviate
from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.interfaces.scenario_parts import FurtherAttempts
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.domain.scenarios.key_press import SCENARIO
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.verdict.judgement import Circumstances, judge
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.looking import Looking
from mtr_operator.domain.verdict.requirement import Requirement
from mtr_operator.domain.verdict.verdict import Verdict
from mtr_operator.domain.verdict.widening import widened_text

PARAMETERS = KeyPressParameters(minimum_distance_m=3.0, maximum_distance_m=10.5)
LINES = radials_around(3.2)[:1]


def radial(worked, failed, **changes):
    """A radial that falls near 6 m, with its presses."""
    return replace(KeyPressResult(1, 0.0, LineStatus.OK, 5.9, 6.1, 0.002, worked + failed, 1.0, "", method="adaptive",
                                  reach="measured", d50_m=6.0, d50_sigma_m=0.1, d50_low_m=5.8, d50_high_m=6.2,
                                  worked_at_m=(worked * (4.4, 5.1, 5.45, 5.8))[:worked],
                                  failed_at_m=(failed * (6.15, 6.5, 6.85))[:failed],
                                  place_sigma_m=0.002), **changes)


def looking(*results):
    progress = Progress("key_press", PARAMETERS.to_mapping(), results=list(results))
    return progress, Looking(SCENARIO, PARAMETERS, progress, progress.revise, lambda: None)


def limit(at_least_m):
    return Limits((Requirement("reach", "press", at_least_m, None),))


def test_line_that_one_look_decides_is_judged_by_a_wider_interval_before_more_attempts_are_made():
    progress, looks = looking(radial(12, 12))
    looks.look_first([1])
    result = progress.results[0]
    assert result.look_shares == pytest.approx((24 / 72,)) and result.look_spent == pytest.approx((0.025 / 9,))
    assert result.d50_look_low_m < result.d50_low_m < result.d50_high_m < result.d50_look_high_m
    looks.look_first([1])
    assert progress.results[0] == result


def test_each_further_attempts_are_one_look_more_and_the_first_was_before_them():
    progress, looks = looking(radial(12, 12))
    after = looks.next(progress.results[0], radial(16, 16))
    assert after.look_shares == pytest.approx((24 / 72, 32 / 72))
    assert after.look_percent == pytest.approx(99.31, abs=0.01)
    again = looks.next(after, replace(radial(20, 20), look_shares=after.look_shares, look_spent=after.look_spent))
    assert again.look_shares == pytest.approx((24 / 72, 32 / 72, 40 / 72))


def test_looks_survive_in_the_file_so_that_a_continued_test_counts_them():
    progress, looks = looking(radial(12, 12))
    after = looks.next(progress.results[0], radial(16, 16))
    read = result_from_document(KeyPressResult, json.loads(json.dumps(after.to_document())))
    assert read == after and read.looks == after.looks
    progress, looks = looking(read)
    assert len(looks.next(read, replace(radial(20, 20), look_shares=read.look_shares,
                                        look_spent=read.look_spent)).looks) == 3


def test_last_look_takes_what_is_left_and_leaves_nothing_for_a_continued_test():
    progress, looks = looking(radial(12, 12))
    progress.revise(looks.next(progress.results[0], radial(16, 16)))
    looks.look_last()
    result = progress.results[0]
    assert result.look_spent[-1] == ERROR_PER_SIDE and deviate(result.looks) == pytest.approx(1.965, abs=0.001)
    judgement = judge(limit(result.d50_m), LINES, [result])
    assert judgement.of_line(1) is Verdict.INCONCLUSIVE and judgement.undecided() == []


def test_line_without_further_attempts_keeps_its_single_look():
    progress, looks = looking(radial(12, 12))
    looks.look_last()
    assert progress.results == [radial(12, 12)] and progress.results[0].look_percent is None


@pytest.mark.parametrize(("look_m", "verdict"), [((5.6, 6.4), Verdict.INCONCLUSIVE), ((5.75, 6.25), Verdict.PASS),
                                                 ((None, 6.25), Verdict.INCONCLUSIVE)])
def test_limit_is_judged_by_the_interval_of_the_last_look(look_m, verdict):
    looked = radial(12, 12, look_shares=(1 / 3,), look_spent=(0.0028,), d50_look_low_m=look_m[0],
                    d50_look_high_m=look_m[1])
    assert judge(limit(5.7), LINES, [looked]).of_line(1) is verdict
    assert judge(limit(5.7), LINES, [radial(12, 12)]).of_line(1) is Verdict.PASS


def test_guard_band_is_as_wide_as_the_look_is_strict():
    looked = radial(12, 12, look_shares=(1 / 3,), look_spent=(0.0028,), d50_look_low_m=5.75, d50_look_high_m=6.25)
    for sigma_m, verdict in ((0.05, Verdict.PASS), (0.065, Verdict.INCONCLUSIVE)):
        circumstances = Circumstances(lambda *_, sigma_m=sigma_m: sigma_m)
        assert judge(limit(5.71), LINES, [looked], circumstances).of_line(1) is verdict


@pytest.mark.parametrize(("spoilt", "is_read"), [
    ({}, True), ({"look_spent": (0.02,)}, False), ({"look_shares": (0.5, 0.4)}, False),
    ({"look_spent": (0.1, 0.2)}, False)])
def test_looks_of_a_damaged_file_are_refused(spoilt, is_read):
    values = {"look_shares": (0.3, 0.4), "look_spent": (0.002, 0.004), **spoilt}
    document = replace(radial(12, 12), **values).to_document()
    if is_read:
        result_from_document(KeyPressResult, document)
    else:
        with pytest.raises(ValueError, match="values that are none"):
            result_from_document(KeyPressResult, document)


@pytest.mark.parametrize(("name", "parameters"), [
    ("autolock", AutolockParameters(passes=2, measuring_speeds_mps=(0.4, 0.1))), ("key_press", PARAMETERS),
    ("handle_request", HandleRequestParameters())])
def test_every_scenario_that_measures_further_tells_which_share_of_the_most_attempts_was_made(name, parameters):
    scenario = SCENARIOS[name]
    assert type(scenario).measure_further is not FurtherAttempts.measure_further
    assert type(scenario).share_of_most is not FurtherAttempts.share_of_most


def test_conclusion_that_widens_an_interval_is_told():
    before, wider, little = radial(12, 12), radial(12, 12, d50_low_m=5.0), radial(12, 12, d50_low_m=5.75)
    assert widened_text("radial", [before], [little]) == ""
    assert widened_text("radial", [before], [wider]) == (
        "The last estimate, with all lines, has wider 95 % intervals: radial 1 from ±0.20 to ±0.60 m.")
    assert "to an open one" in widened_text("radial", [before], [radial(12, 12, d50_low_m=None)])
    assert widened_text("radial", [radial(12, 12, d50_low_m=None)], [wider]) == ""
