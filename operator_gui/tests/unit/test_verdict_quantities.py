"""Limits of what is no distance: sleep time, error of a phone, probability that a relay attack works."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
import pathlib

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.errors import InvalidLimits
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.digital_key.places import MapPlace
from mtr_operator.domain.scenarios.digital_key.result import DigitalKeyResult
from mtr_operator.domain.scenarios.relay_resistance.result import RelayResistanceResult
from mtr_operator.domain.scenarios.relay_resistance.tally import lower_bound, upper_bound
from mtr_operator.domain.scenarios.sleep_time.result import SleepTimeResult
from mtr_operator.domain.verdict.judgement import Circumstances, judge
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_operator.domain.verdict.suitability import check_before_start
from mtr_operator.domain.verdict.verdict import Verdict

LINE = MapPlace(1, "left", Ray(0.0, 0.9, 0.0, 1.0), 1.0)
PASS, FAIL, OPEN = Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE
DEMO = pathlib.Path(__file__).resolve().parents[2] / "examples" / "demo"


def judged(result, what, guard_sigma_m=0.0, **bound):
    """Judgement of one limit on one line."""
    limits = limits_from({"limits": [{"what": what, **bound}]})
    assert limits_from(limits.to_document()) == limits
    found, = judge(limits, [LINE], [result], Circumstances(lambda _, __: guard_sigma_m)).judgements
    assert not found.is_undecided
    return found


def slept(low_s, high_s, status=LineStatus.OK, reason=""):
    """Result of a key that fell asleep between two rests."""
    return SleepTimeResult(1, "left", 1.0, status, answers_until_s=low_s, silent_from_s=high_s, reason=reason)


@pytest.mark.parametrize("low_s, high_s, at_least, at_most", [
    (60.0, 70.0, PASS, PASS), (61.0, 130.0, PASS, OPEN), (130.0, 140.0, PASS, FAIL), (40.0, 50.0, FAIL, PASS),
    (50.0, 65.0, OPEN, PASS), (None, 30.0, FAIL, PASS), (1800.0, None, PASS, FAIL)])
def test_sleep_time_is_judged_by_last_answer_and_first_silence(low_s, high_s, at_least, at_most):
    assert judged(slept(low_s, high_s), "sleep_time", at_least_s=60).verdict is at_least
    assert judged(slept(low_s, high_s), "sleep_time", at_most_s=120).verdict is at_most


def test_sentences_have_the_unit_and_no_share_of_attempts():
    assert judged(slept(130.0, 140.0), "sleep_time", at_most_s=120).reason == (
        "Wanted is sleep_time at most 120 s; it lies between 130.0 and 140.0 s.")
    assert judged(slept(None, 30.0), "sleep_time", at_least_s=60).reason.endswith("; it is below 30.0 s.")


def test_invalid_line_is_inconclusive_with_its_reason():
    bad = slept(40.0, 50.0, LineStatus.INVALID, "The bus fell silent.")
    found = judged(bad, "sleep_time", at_most_s=120)
    assert (found.verdict, found.reason) == (OPEN, "The bus fell silent.")


def ranged(error_m, sigma_m=0.01):
    """Result of a place at which the phone was off by so much."""
    return DigitalKeyResult(1, "left", 1.0, 1.0, LineStatus.OK, reported_m=1.0 + error_m, reported_sigma_m=sigma_m,
                            reference_m=1.0, uncertainty_m=0.02, error_m=error_m)


@pytest.mark.parametrize("error_m, sigma_m, verdict", [
    (0.1, 0.01, PASS), (-0.1, 0.01, PASS), (0.4, 0.01, FAIL), (-0.4, 0.01, FAIL), (0.3, 0.01, OPEN),
    (-0.29, 0.01, OPEN), (0.0, 0.1, PASS), (0.0, 0.2, OPEN)])
def test_phone_may_be_off_to_either_side(error_m, sigma_m, verdict):
    assert judged(ranged(error_m, sigma_m), "phone_error", at_most_error_m=0.3).verdict is verdict


def test_what_the_robot_does_not_know_of_its_own_distance_widens_the_phones_error():
    result = ranged(0.25)
    assert judged(result, "phone_error", 0.0, at_most_error_m=0.3).verdict is PASS
    assert judged(result, "phone_error", 0.05, at_most_error_m=0.3).verdict is OPEN


def test_place_without_an_answer_is_inconclusive():
    silent = DigitalKeyResult(1, "left", 1.0, 1.0, LineStatus.INVALID, answer="none", reason="It was told 0 times.")
    assert judged(silent, "phone_error", at_most_error_m=0.3).reason == "It was told 0 times."


def relayed(unlocks, requests):
    """Result of an axis on which so many requests unlocked with the extender on."""
    status = LineStatus.OK if unlocks else LineStatus.NOT_REACHED
    return RelayResistanceResult(1, "left", 1.0, status, requests_on=requests, unlocks_on=unlocks,
                                 bound_on=upper_bound(unlocks, requests))


@pytest.mark.parametrize("unlocks, requests, verdict", [
    (0, 60, PASS), (0, 58, OPEN), (1, 60, OPEN), (8, 60, FAIL), (60, 60, FAIL), (1, 100, PASS)])
def test_relay_attack_is_judged_by_the_bounds_of_its_probability(unlocks, requests, verdict):
    # 0 of 59 is the first that bounds it by 5 %: 1 - 0.05 ** (1 / 59) = 4.95 %.
    assert judged(relayed(unlocks, requests), "relay_probability", at_most_percent=5).verdict is verdict


def test_lower_bound_is_that_of_the_failures_upper_bound():
    assert lower_bound(0, 20) == 0.0
    assert lower_bound(3, 20) == pytest.approx(1.0 - upper_bound(17, 20))
    assert lower_bound(20, 20) == pytest.approx(0.05 ** (1.0 / 20.0))
    with pytest.raises(ValueError, match="3 of 2"):
        lower_bound(3, 2)


def refusal(scenario, **entry):
    """Sentence about a limit that does not suit the proposed parameters of a scenario."""
    parameters_type = SCENARIOS[scenario].parameters_type
    with pytest.raises(InvalidLimits) as caught:
        check_before_start(limits_from({"limits": [entry]}), SCENARIOS[scenario],
                           parameters_type.from_mapping(parameters_type.proposed()))
    return str(caught.value)


@pytest.mark.parametrize("scenario, entry, piece", [
    ("sleep_time", {"what": "sleep_time", "at_most_s": 7200}, "only one from 30 to 1800 s can be judged"),
    ("sleep_time", {"what": "sleep_time", "at_most_m": 1.0}, "limited by at_least_s or at_most_s, not by at_most_m"),
    ("sleep_time", {"what": "phone_error", "at_most_error_m": 1.0}, "it measures held, sleep_time"),
    ("relay_resistance", {"what": "relay_probability", "at_most_percent": 1}, "only one from 25.89 to 100 %"),
    ("digital_key", {"what": "phone_error", "at_most_m": 0.3}, "limited by at_most_error_m, not by at_most_m"),
    ("digital_key", {"what": "phone", "at_most_m": 0.3}, "does not say how sure a distance is"),
    ("autolock", {"what": "unlock", "at_most_s": 3}, "limited by at_least_m or at_most_m, not by at_most_s")])
def test_limit_that_does_not_suit_is_a_sentence_before_the_robot_moves(scenario, entry, piece):
    assert piece in refusal(scenario, **entry)


@pytest.mark.parametrize("entry, piece", [
    ({"at_most_s": -1}, "a time is -1 s"), ({"at_most_percent": 101}, "a probability is 101 %"),
    ({"at_most_error_m": math.nan}, "an error is nan m"), ({"at_most_s": 3, "at_least_s": 2}, "either at_least_m or"),
    ({}, "one of at_least_s, at_most_s, at_most_error_m, at_most_percent"),
    ({"at_most_s": 3, "share_percent": 50}, "share_percent is for distances; leave it out beside at_most_s")])
def test_bad_entry_is_refused_with_its_number(entry, piece):
    with pytest.raises(InvalidLimits) as caught:
        limits_from({"limits": [{"what": "sleep_time", **entry}]})
    assert str(caught.value).startswith("Limit 1: ") and piece in str(caught.value)


def test_two_limits_that_no_key_can_keep_contradict_each_other():
    entries = [{"what": "sleep_time", "at_least_s": 120}, {"what": "sleep_time", "at_most_s": 60}]
    limits = limits_from({"limits": entries})
    parameters_type = SCENARIOS["sleep_time"].parameters_type
    with pytest.raises(InvalidLimits, match="contradict each other on axis 1: sleep_time at least 120 s"):
        check_before_start(limits, SCENARIOS["sleep_time"], parameters_type.from_mapping(parameters_type.proposed()))


@pytest.mark.parametrize("case", [
    ("sleep_time", "{what: sleep_time, at_most_s: 110}", ("--simulated-key-sleep", "60"), 0, "pass"),
    ("sleep_time", "{what: sleep_time, at_most_s: 40}", ("--simulated-key-sleep", "60"), 3, "fail"),
    ("relay_resistance", "{what: relay_probability, at_most_percent: 45}", ("--simulated-extender", "5"), 3, "fail"),
    ("relay_resistance", "{what: relay_probability, at_most_percent: 45}", (), 0, "pass"),
    ("digital_key", "{what: phone_error, at_most_error_m: 0.6}", ("--phone-feed", "simulated:shadow_m=50"), 0, "pass"),
    ("digital_key", "{what: phone_error, at_most_error_m: 0.02}", ("--phone-feed", "simulated:shadow_m=50,bias_m=0.5"),
     3, "fail")])
def test_whole_test_ends_with_the_verdict(tmp_path, capsys, case):
    scenario, limit, options, code, word = case
    path, out = tmp_path / "limits.yaml", tmp_path / "out"
    path.write_text(f"limits:\n- {limit}\n", encoding="utf-8")
    assert main(["run", scenario, "--params", str(DEMO / f"{scenario}.yaml"), "--out", str(out), "--limits", str(path),
                 "--simulated-robot", "--simulated-car", *options]) == code
    assert f"Verdict: {word.upper()} " in capsys.readouterr().out
    lines = (out / "results.csv").read_text(encoding="utf-8").splitlines()
    assert f"# verdict: {word}" in lines
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert {row["verdict"] for row in rows} == {word}
    assert (out / "protocol.png").stat().st_size > 0
