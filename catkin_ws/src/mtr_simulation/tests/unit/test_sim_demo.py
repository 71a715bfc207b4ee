"""The demo says what is wrong or missing in its results."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import pathlib
import subprocess
import types

import pytest
import yaml

from mtr_car_locator.parameters import DataSheet
from mtr_core.errors import ConfigurationError
from mtr_dispatcher.parameters import Parameters as DispatcherParameters
from mtr_operator.domain.actions.control_loop import SILENCE_LIMIT_S
from mtr_simulation import demo, stack
from mtr_simulation.car_sheet import car_file_of, data_sheet_of
from mtr_simulation.demo import (
    MIN_LINES,
    OUTPUTS,
    DemoOptions,
    DemoResult,
    keep_in_store,
    last_event,
    parameters_of,
    parts_of,
    problems_of,
    read_rows,
    run_demo,
    run_scenario,
)
from mtr_simulation.site.scenario import named_scenario

TOP = pathlib.Path(__file__).resolve().parents[5]
HEADER = "line,unlock_robot_time_s,lock_robot_time_s\n"


@pytest.fixture
def agrees(monkeypatch):
    """Measured and true events are the same."""
    monkeypatch.setattr(demo, "compare", lambda events, folder: 0)


def test_port_is_given_once(monkeypatch):
    first, other = stack.free_port(), stack.free_port()
    wanted = itertools.chain([first, other, first, other], stack.LISTENING_PORTS)
    monkeypatch.setattr(stack, "secrets", types.SimpleNamespace(choice=lambda _: next(wanted)))
    assert stack.free_port() not in (first, other)


def results(folder, lines):
    """Everything that a scenario leaves, with so many lines."""
    folder.mkdir()
    for file in OUTPUTS:
        (folder / file).write_text("", encoding="utf-8")
    rows = "".join(f"{number},{number}.5,\n" for number in range(lines))
    (folder / "results.csv").write_text(f"# robot: simulated\n{HEADER}{rows}", encoding="utf-8")


@pytest.mark.usefixtures("agrees")
def test_complete_results_have_no_problem(tmp_path):
    results(tmp_path / "key_press", MIN_LINES["key_press"])
    assert problems_of(tmp_path, "key_press", tmp_path / "events.csv") == []


@pytest.mark.usefixtures("agrees")
def test_missing_file_and_missing_lines_are_named(tmp_path):
    results(tmp_path / "key_press", 3)
    (tmp_path / "key_press" / "protocol.png").unlink()
    assert problems_of(tmp_path, "key_press", tmp_path / "events.csv") == [
        "key_press: protocol.png is missing", "key_press: 3 lines instead of at least 8"]


def test_results_that_do_not_match_the_truth_are_a_problem(tmp_path, monkeypatch):
    monkeypatch.setattr(demo, "compare", lambda events, folder: 1)
    results(tmp_path / "autolock", MIN_LINES["autolock"])
    problems = problems_of(tmp_path, "autolock", tmp_path / "events.csv")
    assert problems == ["autolock: measured and true events do not match"]


def test_distances_of_the_demo_are_held_against_the_truth_as_its_car_allows(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(demo, "run_part", lambda part, names: None)
    monkeypatch.setattr(demo, "compare", lambda events, folder, *arguments: asked.append(arguments) or 0)
    for car in ("gentle", "honest"):
        run_demo(DemoOptions(tmp_path / car, car=car, scenarios=("autolock",)))
    assert asked == [("--car", "gentle", "--seed", "1", "--max-error", "0.05"),
                     ("--car", "honest", "--seed", "1", "--max-error", "0.15", "--max-sigmas", "4")]


def test_last_event_is_read_past_metadata_and_empty_cells(tmp_path):
    results(tmp_path / "autolock", 2)
    assert last_event(read_rows(tmp_path / "autolock" / "results.csv")) == 1.5
    assert read_rows(tmp_path / "missing.csv") == [] and last_event([]) == 0.0


def test_car_of_a_file_is_found_from_any_folder_and_the_comparison_knows_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert DemoOptions(tmp_path).car_argument == "gentle"
    options = DemoOptions(tmp_path, seed=4, car="mine.yaml")
    assert options.car_argument == str(tmp_path / "mine.yaml")
    assert options.model == ("--car", "mine.yaml", "--seed", "4")


def test_button_is_tried_with_passive_entry_switched_off_where_a_car_has_it(tmp_path):
    assert [DemoOptions(tmp_path, car="honest").car_for(name) for name in MIN_LINES] == [
        "honest", "honest_far_button", "honest_button", "honest_handle"]
    assert {DemoOptions(tmp_path, car="gentle").car_for(name) for name in MIN_LINES} == {"gentle"}


@pytest.mark.parametrize(("car", "asked", "parts"), [
    ("gentle", (), [("gentle", ["autolock", "key_press"])]),
    ("honest", (), [("honest", ["autolock"]), ("honest_far_button", ["key_press"])]),
    ("honest_handle", (), [("honest_handle", ["handle_request"])]),
    ("honest", ("key_press", "handle_request", "zone_map"),
     [("honest_far_button", ["key_press"]), ("honest_handle", ["handle_request"]), ("honest_button", ["zone_map"])]),
])
def test_scenarios_that_suit_the_car_are_run_unless_others_are_asked_for_and_each_car_once(tmp_path, car, asked, parts):
    found = parts_of(DemoOptions(tmp_path, car=car, scenarios=asked))
    assert [(part.car, names) for part, names in found] == parts


def test_key_that_works_from_afar_has_a_site_and_parameters_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(TOP)
    (part, _), = parts_of(DemoOptions(tmp_path, car="honest", scenarios=("key_press",)))
    assert (part.site, DemoOptions(tmp_path).site) == ("far", "lot")
    far, usual = (yaml.safe_load(parameters_of("key_press", car).read_text(encoding="utf-8"))["maximum_distance_m"]
                  for car in (part.car, "gentle"))
    assert far > usual


def test_scenario_that_does_not_exist_is_refused(capsys):
    with pytest.raises(SystemExit):
        demo.main(["--scenarios", "parking"])
    assert "'parking'" in capsys.readouterr().err


def test_unknown_car_is_refused_before_anything_is_deleted(tmp_path):
    (tmp_path / "kept").write_text("", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="car is 'unreal'"):
        run_demo(DemoOptions(tmp_path, car="unreal"))
    assert (tmp_path / "kept").exists()


def test_speed_is_robot_time_by_wall_time():
    assert DemoResult(700.0, 100.0, ()).real_time_factor == 7.0


def test_tests_of_the_demo_end_in_a_store_and_the_address_is_told(tmp_path, monkeypatch, capsys):
    began = []
    done = subprocess.CompletedProcess([], 0)
    monkeypatch.setattr(demo.subprocess, "run", lambda command, **_: began.append(command) or done)
    assert keep_in_store(tmp_path) == []
    assert began[0][1:4] == ["-m", "mtr_results", "import"] and began[0][-1] == str(tmp_path)
    said = capsys.readouterr().out
    assert "http://127.0.0.1:8321/" in said and str(tmp_path / "results.sqlite") in said


def test_a_store_that_takes_nothing_is_a_problem_of_the_demo(tmp_path, monkeypatch):
    monkeypatch.setattr(demo.subprocess, "run", lambda command, **_: subprocess.CompletedProcess(command, 2))
    assert "could not be put into the store" in keep_in_store(tmp_path)[0]


def test_with_other_parameters_nobody_knows_how_many_lines_there_are(tmp_path):
    assert DemoOptions(tmp_path).least_lines("autolock") == 16
    assert DemoOptions(tmp_path, parameters=tmp_path / "mine.yaml").least_lines("autolock") == 1


def test_record_of_a_test_names_the_simulated_car(tmp_path, monkeypatch):
    commands = []

    def run(command, check):
        commands.append(command)
        return subprocess.CompletedProcess(command, 0)

    monkeypatch.setattr(subprocess, "run", run)
    stack = types.SimpleNamespace(status_port=1, command_port=2, can_link="can")
    assert run_scenario(stack, "autolock", tmp_path / "autolock", DemoOptions(tmp_path, car="honest")) == 0
    (command,) = commands
    identity = yaml.safe_load(pathlib.Path(command[command.index("--identity") + 1]).read_text(encoding="utf-8"))
    assert identity == {"car_model": "simulated honest"}


@pytest.mark.parametrize("site", ["lot", "far", "suv"])
def test_robot_of_the_demo_is_given_the_data_sheet_of_its_car(site):
    sheet = DataSheet(**yaml.safe_load(car_file_of(site)))
    assert sheet == data_sheet_of(site)
    shape = named_scenario(site).car
    assert (sheet.known_length_m, sheet.known_width_m) == (shape.length_m, shape.width_m)
    assert sheet.wheelbase_m + 2.0 * sheet.front_overhang_m == pytest.approx(shape.length_m)


def test_nodes_of_the_demo_wait_for_each_other_and_for_the_application_on_a_busy_machine(monkeypatch, tmp_path):
    started = []

    def stack(options):
        started.append(yaml.safe_load(pathlib.Path(options.arguments["node_parameters"]).read_text(encoding="utf-8")))
        raise demo.StackError("enough")

    monkeypatch.setattr(demo, "Stack", stack)
    with pytest.raises(demo.StackError, match="enough"):
        run_demo(DemoOptions(tmp_path / "demo", car="honest", scenarios=("autolock",)))
    (parameters,) = started
    operator_s = parameters["/dispatcher/operator_lost_after_wall_s"]
    assert DispatcherParameters(operator_lost_after_wall_s=operator_s).operator_lost_after_wall_s == operator_s
    # Before the application gives the robot up, and longer than anything of it takes on a busy machine.
    assert 10.0 <= operator_s == parameters["/lockstep_patience_s"] < SILENCE_LIMIT_S
