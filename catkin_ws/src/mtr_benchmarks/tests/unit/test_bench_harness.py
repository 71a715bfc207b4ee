"""Rows of all benchmarks are evaluated, written and printed in the same way."""
# SPDX-License-Identifier: Apache-2.0
import json
import math

import pytest

from mtr_benchmarks.harness.lines import line
from mtr_benchmarks.harness.report import BenchmarkReport, finish
from mtr_benchmarks.harness.rows import Requirement, Row

ERROR = Requirement("error", "m", goal=0.01, must=0.02)
SPEED = Requirement("speed", "(x)", must=7.0, at_least=True)
TEMPERATURE = Requirement("temperature", "deg")


@pytest.mark.parametrize(("requirement", "value", "met", "goal_met"), [
    (ERROR, 0.01, True, True), (ERROR, 0.015, True, False), (ERROR, 0.021, False, False),
    (ERROR, None, False, False), (ERROR, math.nan, False, False), (ERROR, math.inf, False, False),
    (SPEED, 7.0, True, True), (SPEED, 6.99, False, False), (SPEED, None, False, False),
    (TEMPERATURE, 40.0, True, True), (TEMPERATURE, None, True, True)])
def test_row_is_met_within_its_limits_and_always_without(requirement, value, met, goal_met):
    row = Row(requirement, value)
    assert (row.is_met, row.is_goal_met) == (met, goal_met)


def test_row_that_is_not_complete_is_not_met():
    row = Row(ERROR, 0.0, is_complete=False)
    assert not row.is_met and not row.is_goal_met


def test_row_in_a_file_has_the_promised_keys():
    assert Row(ERROR, 0.015, details={"failed_drives": 0}).as_json() == {
        "name": "error", "unit": "m", "value": 0.015, "goal": 0.01, "must": 0.02, "bound": "at most",
        "failed_drives": 0, "met": True, "goal_met": False}
    assert Row(TEMPERATURE, math.nan).as_json() == {
        "name": "temperature", "unit": "deg", "value": None, "goal": None, "must": None, "bound": "at most",
        "met": True, "goal_met": True}


@pytest.mark.parametrize(("row", "shown"), [
    (Row(ERROR, 0.004), "error 0.40 cm must <= 2.00, goal <= 1.00: goal met"),
    (Row(ERROR, 0.0155, remark="in 3 drives"), "error 1.55 cm must <= 2.00, goal <= 1.00: met, in 3 drives"),
    (Row(ERROR, None), "error unknown cm must <= 2.00, goal <= 1.00: NOT MET"),
    (Row(SPEED, 10.34), "speed 10.3 x must >= 7.0: met"),
    (Row(Requirement("start", "s", goal=2.0), 3.49), "start 3.49 s goal <= 2.00: goal not met"),
    (Row(TEMPERATURE, 21.0), "temperature 21.00 deg"),
    (Row(TEMPERATURE, 21.0, remark="outside"), "temperature 21.00 deg outside"),
    (Row(Requirement("contacts", "(count)", must=0.0), 1), "contacts 1 must <= 0: NOT MET"),
    (Row(Requirement("wrong", "(share)", must=0.0), 0.015), "wrong 1.5 % must <= 0.0: NOT MET"),
])
def test_row_is_one_line(row, shown):
    assert line(row).split() == shown.split()


@pytest.mark.parametrize(("error_m", "status"), [(0.02, 0), (0.03, 1)])
def test_benchmark_leaves_a_file_and_a_status(tmp_path, capsys, error_m, status):
    path = tmp_path / "new" / "error.json"
    rows = [Row(ERROR, error_m), Row(TEMPERATURE, 21.0)]
    found = BenchmarkReport(rows, {"runs": 3, "worst": math.inf}, ["Nothing else."])
    assert finish(found, path) == status
    written = json.loads(path.read_text(encoding="utf-8"))
    assert written["runs"] == 3 and written["worst"] is None
    assert [row["name"] for row in written["table"]] == ["error", "temperature"]
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 3 and said[-1] == "Nothing else."
