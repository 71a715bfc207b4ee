"""The command line with limits and a calibration record: refusals before the robot moves, verdicts, exit codes."""
# SPDX-License-Identifier: Apache-2.0
import csv
import json

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.results.line_result import MeasuredDistance
from mtr_operator.domain.scenarios.key_press import KeyPress
from mtr_operator.domain.scenarios.key_press_result import PRESS, KeyPressResult

# The Car of these tests obeys up to 5.2 m, and presses are half a metre apart.
HALF_WIDTH_M = 0.3
PARAMETERS = "angle_between_radials_deg: 90.0\n"


@pytest.fixture
def folder(tmp_path, monkeypatch, robot_link, car_link):
    monkeypatch.setattr("mtr_operator.cli.run.robot_link", lambda options, is_real_time: robot_link)
    monkeypatch.setattr("mtr_operator.cli.run.car_link", lambda options: car_link)
    monkeypatch.setattr(KeyPress, "judged_shares", lambda *_: (50,))
    monkeypatch.setattr(KeyPressResult, "distances", property(with_interval))
    (tmp_path / "parameters.yaml").write_text(PARAMETERS, encoding="utf-8")
    return tmp_path


def with_interval(result):
    """Distances of a radial as if the place of the press were the middle of an interval."""
    place_m = result.distance_m
    ends = (None, None) if place_m is None else (place_m - HALF_WIDTH_M, place_m + HALF_WIDTH_M)
    return (MeasuredDistance(PRESS, result.status, place_m, result.uncertainty_m, *ends),)


def run(folder, limits="", *extra, out="out"):
    """Exit code of a test with this limits file."""
    (folder / "limits.yaml").write_text(limits, encoding="utf-8")
    given = ["--limits", str(folder / "limits.yaml")] if limits else []
    return main(["run", "key_press", "--params", str(folder / "parameters.yaml"), "--out", str(folder / out),
                 *given, *map(str, extra)])


def limit(bound, **entry):
    """A limits file with one limit."""
    lines = {"what": "press", **dict([bound]), **entry}
    return f"further_time_limit_s: 60\nlimits:\n  - {json.dumps(lines)}\n"


@pytest.mark.parametrize("bound, code, word", [
    (("at_least_m", 4.0), 0, "pass"), (("at_least_m", 5.9), 3, "fail"), (("at_least_m", 5.0), 4, "inconclusive"),
    (("at_most_m", 5.9), 0, "pass"), (("at_most_m", 4.0), 3, "fail")])
def test_exit_code_and_files_tell_the_verdict(folder, capsys, bound, code, word):
    assert run(folder, limit(bound)) == code
    shown = capsys.readouterr().out
    assert f"Verdict: {word.upper()} (4 {word})" in shown
    text = (folder / "out" / "results.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert [row["verdict"] for row in rows] == 4 * [word]
    assert all(bool(row["verdict_reason"]) is (word != "pass") for row in rows)
    assert f"# verdict: {word}" in text
    assert "# limit limit 1: press at " in text


def test_one_line_beyond_its_limit_fails_the_test_and_names_the_line(folder, capsys):
    limits = "limits:\n  - {what: press, at_least_m: 4.0}\n  - {name: behind, "
    limits += "what: press, at_most_m: 4.1, sides: [rear]}\n"
    assert run(folder, limits) == 3
    shown = capsys.readouterr().out
    assert "FAIL: radial 3 (180°), behind: Wanted is press at most 4.1 m for 50 % of the attempts" in shown
    assert "Verdict: FAIL (3 pass, 1 fail)" in shown


def test_without_limits_the_verdict_is_not_set_and_the_code_0(folder, capsys):
    assert run(folder) == 0
    assert "Verdict" not in capsys.readouterr().out
    assert ",not_set," in (folder / "out" / "results.csv").read_text(encoding="utf-8")


@pytest.mark.parametrize("limits, piece", [
    ("limits: [", "is not valid YAML"), ("limits: []", "list of 1 to 200"),
    (limit(("at_least_m", 4.0), what="unlock"), "measures no 'unlock'"),
    (limit(("at_least_m", 4.0), share_percent=95), "for 50 % of the attempts, not for 95 %"),
    (limit(("at_least_m", 30.0)), "measures from 3 to 6.5 m only"),
    (limit(("at_least_m", 4.0), angles_deg=[10, 20]), "names no radial of this test"),
    ("limits:\n- {what: press, at_least_m: 5}\n- {what: press, at_most_m: 4}\n", "contradict each other on radial 1")])
def test_limits_that_do_not_suit_are_refused_before_the_robot_moves(folder, robot_link, capsys, limits, piece):
    assert run(folder, limits) == 2
    error = capsys.readouterr().err
    assert piece in error
    assert error.count("\n") == 1
    assert robot_link.answers == []
    assert not (folder / "out").exists()


def test_a_scenario_without_intervals_is_not_judged(folder, monkeypatch, capsys):
    monkeypatch.setattr(KeyPress, "judged_shares", lambda *_: ())
    assert run(folder, limit(("at_least_m", 4.0))) == 2
    assert "does not say how sure" in capsys.readouterr().err


def test_a_test_goes_on_with_its_limits_and_with_no_others(folder, capsys):
    path = folder / "out" / "progress.json"
    assert run(folder, limit(("at_least_m", 4.0))) == 0
    assert run(folder, "", "--continue", path) == 0
    assert "Verdict: PASS" in capsys.readouterr().out
    assert run(folder, limit(("at_least_m", 3.9)), "--continue", path) == 2
    assert "begun with other limits" in capsys.readouterr().err


def test_the_budget_lies_beside_the_results_and_names_its_calibration(folder, capsys):
    (folder / "robot.yaml").write_text("""
robot: MTR-7
date: 2020-01-31
by: J. Novak
valid_days: 30
key_ahead_m: 0.25
terms:
  mast_lean_deg: {value: 0, uncertainty: 2.0, distribution: normal, degrees_of_freedom: 4, source: plumb line}
  floor_slope_deg: {value: 0, uncertainty: 0.1, distribution: rectangular, source: survey}
  key_lever_m: {value: 0, uncertainty: 0.001, distribution: rectangular, source: rule}
  lidar_yaw_deg: {value: 0, uncertainty: 0.1, distribution: normal, source: wall}
""", encoding="utf-8")
    assert run(folder, "", "--calibration", folder / "robot.yaml") == 0
    assert "calibration record of 2020-01-31 is" in capsys.readouterr().err
    document = json.loads((folder / "out" / "budget.json").read_text(encoding="utf-8"))
    assert document["calibration"]["robot"] == "MTR-7"
    first = document["distances"][0]
    parts = {term["name"]: term["contribution_m"] for term in first["terms"]}
    # The key is 1 m above ground.
    assert parts["mast_lean_deg"] == pytest.approx(0.0349, abs=1e-4)
    assert first["sigma_m"] ** 2 == pytest.approx(sum(part ** 2 for part in parts.values()))
    assert first["common_sigma_m"] == pytest.approx(0.0349, abs=1e-3)
    assert document["correlations"]["matrix"][0][0] == 1.0
    text = (folder / "out" / "results.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert float(rows[0]["press_expanded_m"]) == pytest.approx(first["expanded_m"], abs=1e-4)


def test_a_damaged_calibration_record_is_refused_before_the_robot_moves(folder, robot_link, capsys):
    (folder / "robot.yaml").write_text("robot: MTR-7\n", encoding="utf-8")
    assert run(folder, "", "--calibration", folder / "robot.yaml") == 2
    assert "robot.yaml: date is missing." in capsys.readouterr().err
    assert robot_link.answers == []
