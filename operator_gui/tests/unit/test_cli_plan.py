"""The planner of the test on the command line: before the start, and after each line."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re

import pytest

from mtr_operator.cli import main
from mtr_operator.cli.planning import duration_text
from mtr_operator.domain.scenarios import SCENARIOS

DEMO = pathlib.Path(__file__).resolve().parents[2] / "examples" / "demo"


def plan(scenario, parameters, *extra):
    return main(["plan", scenario, "--params", str(parameters), *map(str, extra)])


@pytest.fixture
def file_of(tmp_path):
    def write(text, name="parameters.yaml"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        return tmp_path / name
    return write


@pytest.mark.parametrize(("scenario", "lines", "attempts"), [
    ("autolock", "16 lines (axis)", "attempts in all: 32"), ("key_press", "8 lines (radial)", "attempts in all: "),
    ("zone_map", "8 lines (zone)", "attempts in all: 80"), ("handle_request", "3 lines (axis)", "attempts in all: ")])
def test_plan_tells_lines_time_attempts_and_interval_of_every_scenario(scenario, lines, attempts, capsys):
    assert scenario in SCENARIOS and plan(scenario, DEMO / f"{scenario}.yaml") == 0
    first, each, in_all, *warnings = capsys.readouterr().out.splitlines()
    assert re.fullmatch(re.escape(lines) + r", about \d+ min of robot time", first)
    assert each.startswith("attempts on each line: ") and "; 95 % interval " in each
    assert in_all.startswith(attempts)
    assert all(warning.startswith("warning: ") for warning in warnings)


@pytest.mark.parametrize(("scenario", "text", "warning"), [
    ("key_press", "method: adaptive\nattempts_limit: 8\n", r"8 presses on each radial reach .*: allow \d+ presses "),
    ("handle_request", "attempts_limit: 6\n", r"6 requests on each axis reach .*: allow \d+ requests "),
    ("zone_map", "presses_limit: 6\n", r"6 presses in each zone reach .*: allow \d+ presses "),
    ("autolock", "passes: 2\nmeasuring_speeds_mps: [0.8, 0.4]\n",
     r"At 0\.40 m/s, with a message .*\. Pass at 0\.\d\d ")])
def test_interval_out_of_reach_is_told_with_what_would_reach_it(scenario, text, warning, file_of, capsys):
    assert plan(scenario, file_of(text)) == 0
    *_, last = capsys.readouterr().out.splitlines()
    assert re.match("warning: " + warning, last)


def test_speed_is_judged_by_the_cycle_of_the_cars_profile(file_of, capsys):
    assert plan("autolock", file_of("measuring_speed_mps: 0.4\n"), "--car-profile", "mtr_honest_car_slow") == 0
    assert "warning: At 0.40 m/s, with a message of the Car every 0.80 s, " in capsys.readouterr().out
    assert plan("autolock", file_of("measuring_speed_mps: 0.4\n"), "--car-profile", "mtr_demo_car") == 0
    assert "warning" not in capsys.readouterr().out


LIMITS = "limits:\n  - {{what: {0}, at_least_m: 2.0}}\n  - {{what: {0}, {1}}}\n"


@pytest.mark.parametrize("measured", [("autolock", "unlock", "passes: 2\n"), ("zone_map", "reach", "heights: 1\n"),
                                      ("handle_request", "handle", "side: all\n")])
@pytest.mark.parametrize(("second", "words"), [
    ("at_most_m: 1.5", "contradict each other on"),
    ("at_least_m: 1.0, sides: [front], angles_deg: [170, 190]", "names no"),
    ("at_most_m: 40", "no measurement could judge it")])
def test_limits_that_do_not_suit_the_test_are_refused_in_a_sentence(measured, second, words, file_of, capsys):
    scenario, word, text = measured
    limits = file_of(LIMITS.format(word, second), "limits.yaml")
    assert plan(scenario, file_of(text), "--limits", limits) == 2
    refused = capsys.readouterr()
    assert words in refused.err and refused.out == "" and len(refused.err.splitlines()) == 1


def test_file_that_is_no_parameters_is_one_sentence(file_of, capsys):
    assert plan("autolock", file_of("passes: 0\n")) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


@pytest.fixture
def fakes(monkeypatch, robot_link, car_link):
    monkeypatch.setattr("mtr_operator.cli.run.robot_link", lambda options, is_real_time: robot_link)
    monkeypatch.setattr("mtr_operator.cli.run.car_link", lambda options: car_link)
    car_link.world.unlock_m = car_link.world.lock_m = -1.0


@pytest.mark.usefixtures("fakes")
def test_run_tells_what_to_expect_before_the_robot_moves_and_after_each_line(file_of, tmp_path, capsys):
    parameters = file_of("method: adaptive\nangle_between_radials_deg: 120.0\nattempts_limit: 9\n")
    assert main(["run", "key_press", "--params", str(parameters), "--out", str(tmp_path / "out")]) == 0
    told = capsys.readouterr().err.splitlines()
    expected = [line for line in told if line.startswith("expected: ")]
    assert re.fullmatch(r"expected: about \d+ (s|min); attempts on each line: 9; 95 % interval .*", expected[0])
    assert len(expected) == 3 and all(" left; attempts on each line: 9; " in line for line in expected[1:])
    warning = next(index for index, line in enumerate(told) if line.startswith("warning: 9 presses on each radial"))
    moved = next(index for index, line in enumerate(told) if line.startswith("move the key to"))
    assert told.index(expected[0]) < warning < moved


@pytest.mark.parametrize(("seconds", "text"), [(-1.0, "0 s"), (89.4, "89 s"), (90.0, "2 min"), (3540.0, "59 min"),
                                               (3599.0, "1 h 00 min"), (7500.0, "2 h 05 min")])
def test_duration_is_in_the_unit_that_a_person_reads(seconds, text):
    assert duration_text(seconds) == text
