"""What a test's record says of the robot's preflight."""
# SPDX-License-Identifier: Apache-2.0
import math
import re
from dataclasses import replace

import pytest

from mtr_operator.domain.results.session_record import PREFLIGHT, preflight_record
from mtr_operator.domain.robot_status import PreflightItem, PreflightReport
from mtr_operator.domain.scenarios import SCENARIOS

FINE = PreflightReport(60.0, (PreflightItem("disk", False, "Free."),), 14, 0)


@pytest.mark.parametrize("report, steady_s, text", [
    (FINE, 100.0, "14 checks, 0 bad, 40.0 s before"),
    (replace(FINE, bad=2), 7260.0, "14 checks, 2 bad, 2 h 0 min before"),
    # Told in a Status that was stamped before the preflight ended.
    (FINE, 59.5, "14 checks, 0 bad, 0.0 s before")])
def test_it_says_how_many_checks_were_bad_and_how_long_ago(report, steady_s, text):
    assert preflight_record(report, steady_s) == {PREFLIGHT: text}


@pytest.mark.parametrize("report, steady_s", [
    (None, 100.0), (PreflightReport(), 100.0), (FINE, 10.0), (replace(FINE, made_s=math.nan), 100.0)],
    ids=["not told", "none made", "of another run", "not a number"])
def test_none_of_this_run_is_not_recorded(report, steady_s):
    assert preflight_record(report, steady_s) == {}


def test_a_test_keeps_it_above_its_table(run_scenario, world):
    world.spoil = lambda told: replace(told, sent_s=100.0 + told.stamp_s, steady_s=100.0 + told.stamp_s, preflight=FINE)
    scenario = SCENARIOS["autolock"]
    run_scenario(scenario, scenario.parameters_type.from_mapping({"measurements_distance_m": 10.0}))
    assert re.fullmatch(r"14 checks, 0 bad, \d+\.\d s before", run_scenario.progress.session[PREFLIGHT])
