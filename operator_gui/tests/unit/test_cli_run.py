"""The command line from arguments to files and exit codes, on the shipped substitutes or the fakes of these tests."""
# SPDX-License-Identifier: Apache-2.0
import io
import json
import os
import pathlib
import signal
import sys
from dataclasses import replace

import pytest

from mtr_operator.cli import main
from mtr_operator.cli.display import Display
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import LogMessage, Mode, Notification, RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.report.files import write_report

DEMO = pathlib.Path(__file__).resolve().parents[2] / "examples" / "demo"


@pytest.fixture
def fakes(monkeypatch, robot_link, car_link):
    monkeypatch.setattr("mtr_operator.cli.run.robot_link", lambda options, is_real_time: robot_link)
    monkeypatch.setattr("mtr_operator.cli.run.car_link", lambda options: car_link)


@pytest.fixture
def parameters(tmp_path, fakes):
    path = tmp_path / "parameters.yaml"
    path.write_text("measurements_distance_m: 10.0\n", encoding="utf-8")
    return path


def run(scenario, parameters, out, *extra):
    return main(["run", scenario, "--params", str(parameters), "--out", str(out), *map(str, extra)])


@pytest.mark.parametrize("scenario", list(SCENARIOS))
def test_demo_runs_on_the_substitutes(scenario, tmp_path, capsys):
    arguments = (scenario, DEMO / f"{scenario}.yaml", tmp_path / "out", "--simulated-robot", "--simulated-car")
    assert run(*arguments) == 0
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "budget.json", "progress.journal", "progress.json", "protocol.pdf", "protocol.png", "recording", "results.csv"]
    assert "lines measured" in capsys.readouterr().out


def test_same_seed_gives_the_same_results(tmp_path):
    texts = []
    for name in ("one", "two"):
        run("key_press", DEMO / "key_press.yaml", tmp_path / name, "--simulated-robot", "--simulated-car", "--seed", 5)
        text = (tmp_path / name / "results.csv").read_text(encoding="utf-8")
        texts.append([line for line in text.splitlines() if not line.startswith("# started")])
    assert texts[0] == texts[1]


def test_lines_are_told_once_each_without_a_terminal(parameters, tmp_path, capsys):
    assert run("autolock", parameters, tmp_path / "out") == 0
    notice = capsys.readouterr().err
    assert notice.count("[8/8] axis 8 (front left): unlock 1") == 1
    assert "8 of 8 lines to measure" in notice


def test_tables_of_all_lines_and_of_the_sides_end_a_test(parameters, tmp_path, capsys):
    assert run("autolock", parameters, tmp_path / "out") == 0
    heading, *rows, last = capsys.readouterr().out.splitlines()
    rows, meaning, sides = rows[:8], rows[8], rows[9:]
    assert heading.split() == ["axis", "unlock", "m", "key", "±", "m", "lock", "m", "key", "±", "m"]
    assert meaning.startswith("Beside each distance stands 1 sigma of where the Remote key was")
    assert [row.split()[0] for row in rows] == [str(number) for number in range(1, 9)]
    assert [row.split("  ")[0] for row in sides if "all sides" in row or "side " in row] == [
        "unlock: side", "all sides", "lock: side", "all sides"]
    assert last == f"8 lines measured; results are in {tmp_path / 'out'}."


def test_ctrl_c_stops_the_robot_saves_and_can_be_continued(parameters, tmp_path, world, robot_link, capsys):
    out = tmp_path / "out"
    handler = signal.getsignal(signal.SIGINT)

    def interrupt(status):
        if status.id == 200:
            os.kill(os.getpid(), signal.SIGINT)
        return status
    world.spoil = interrupt
    assert run("autolock", parameters, out) == 130
    assert robot_link.answers[-1][1].stop
    assert robot_link.closed
    measured = json.loads((out / "progress.json").read_text(encoding="utf-8"))["results"]
    assert 0 < len(measured) < 8
    assert not (out / "results.csv").exists()
    assert "--continue" in capsys.readouterr().err
    assert signal.getsignal(signal.SIGINT) is handler

    assert run("autolock", parameters, out, "--continue", out / "progress.json") == 0
    results = json.loads((out / "progress.json").read_text(encoding="utf-8"))["results"]
    assert results[:len(measured)] == measured
    assert len(results) == 8


def test_continued_test_refuses_another_car_profile_before_the_robot_moves(parameters, tmp_path, world, robot_link,
                                                                           capsys):
    out = tmp_path / "out"
    world.spoil = lambda status: status if status.id < 200 else None
    assert run("autolock", parameters, out, "--car-profile", "mtr_demo_car", "--robot", "192.168.0.10") == 2
    measured, world.spoil = (out / "progress.json").read_text(encoding="utf-8"), lambda status: status
    count = robot_link.status_id
    for others, sentence in ((["--car-profile", "mtr_honest_car"], "demo_car, and now it is mtr_honest_car;"),
                             (["--simulated-car"], "begun at a real Car"), (["--simulated-robot"], "a real robot")):
        capsys.readouterr()
        assert run("autolock", parameters, out, "--continue", out / "progress.json", *others) == 2
        assert sentence in capsys.readouterr().err
    assert (robot_link.status_id, (out / "progress.json").read_text(encoding="utf-8")) == (count, measured)

    assert run("autolock", parameters, out, "--continue", out / "progress.json", "--robot", "192.168.0.11") == 0
    assert json.loads((out / "progress.json").read_text(encoding="utf-8"))["session"]["robot"] == \
        "192.168.0.10, 192.168.0.11"


def test_lost_link_keeps_the_lines_and_says_how_to_go_on(parameters, tmp_path, world, capsys):
    world.spoil = lambda status: status if status.id < 200 else None
    assert run("autolock", parameters, tmp_path / "out") == 2
    notice = capsys.readouterr().err
    assert "The robot has been silent for 30 s" in notice
    assert "no answer from the robot for 1 s" in notice
    assert "--continue" in notice
    assert json.loads((tmp_path / "out" / "progress.json").read_text(encoding="utf-8"))["results"]


def test_finished_test_is_not_overwritten(parameters, tmp_path, capsys):
    assert run("autolock", parameters, tmp_path / "out") == 0
    assert run("autolock", parameters, tmp_path / "out") == 2
    assert "holds results of another test" in capsys.readouterr().err


def test_unreachable_robot_is_one_sentence_and_leaves_no_file(parameters, tmp_path, robot_link, monkeypatch,
                                                              capsys):
    def fail():
        raise ConnectionFailed("Nothing listens on port 3334.")
    monkeypatch.setattr(robot_link, "connect", fail)
    assert run("autolock", parameters, tmp_path / "out") == 2
    assert capsys.readouterr().err == "Nothing listens on port 3334.\n"
    assert not (tmp_path / "out").exists()


def test_folder_that_cannot_be_written_is_found_before_the_robot_moves(parameters, tmp_path, robot_link, capsys):
    (tmp_path / "file").write_text("x", encoding="utf-8")
    assert run("autolock", parameters, tmp_path / "file" / "out") == 2
    assert "cannot be written" in capsys.readouterr().err
    assert robot_link.status_id == 0


@pytest.mark.parametrize(("text", "part"), [
    ("maximum_distance_m: 4,0\n", "write a decimal point: 4.0"),
    ("maximum_distance_m: 99\n", "allowed is 0.1 to 50 m"),
])
def test_bad_parameter_is_one_sentence_and_leaves_nothing(tmp_path, capsys, text, part):
    path = tmp_path / "parameters.yaml"
    path.write_text(text, encoding="utf-8")
    assert run("autolock", path, tmp_path / "out") == 2
    notice = capsys.readouterr().err
    assert part in notice
    assert notice.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_foreign_progress_file_is_one_sentence(parameters, tmp_path, capsys):
    (tmp_path / "progress.json").write_text('{"a": 1}', encoding="utf-8")
    assert run("autolock", parameters, tmp_path / "out", "--continue", tmp_path / "progress.json") == 2
    assert "not a progress file" in capsys.readouterr().err


def test_unknown_scenario_is_refused(tmp_path, capsys):
    with pytest.raises(SystemExit) as caught:
        run("parking", tmp_path / "none.yaml", tmp_path)
    assert caught.value.code == 2
    assert "autolock" in capsys.readouterr().err


@pytest.mark.parametrize("scenario", list(SCENARIOS))
def test_parameters_are_listed_with_unit_range_and_default(scenario, capsys):
    assert main(["params", scenario]) == 0
    notice = capsys.readouterr().out
    for declared in SCENARIOS[scenario].parameters_type.declarations().values():
        assert any(line.startswith(declared.file_key) and declared.allowed in line for line in notice.splitlines())


def test_sentences_of_the_robot_are_told_once():
    stream = io.StringIO()
    display = Display(SCENARIOS["autolock"], stream)
    status = RobotStatus(id=1, robot_session_id=1, stamp_s=1.0, log=(LogMessage(1, 1.0, 2, "planner", "A box."),),
                         notifications=(Notification("low_battery", 2, "The battery is at 9 %."),))
    for _ in range(3):
        display.on_status(status)
    assert stream.getvalue() == "robot warning: A box.\nrobot warning: The battery is at 9 %.\n"


def test_what_a_starting_robot_still_lacks_is_not_told():
    stream = io.StringIO()
    display = Display(SCENARIOS["autolock"], stream)
    status = RobotStatus(id=1, robot_session_id=1, stamp_s=1.0, mode=Mode.STARTING,
                         notifications=(Notification("not_localized", 3, "Stand still."),))
    display.on_status(status)
    assert stream.getvalue() == ""
    display.on_status(replace(status, mode=Mode.FAULT))
    assert stream.getvalue() == "robot error: Stand still.\n"


def test_sentence_that_returns_is_told_again():
    stream = io.StringIO()
    display = Display(SCENARIOS["autolock"], stream)
    notice = RobotStatus(id=1, robot_session_id=1, stamp_s=1.0, notifications=(Notification("blocked", 2, "A box."),))
    for status in (notice, RobotStatus(id=2, robot_session_id=1, stamp_s=1.1), notice):
        display.on_status(status)
    assert stream.getvalue().count("A box.") == 2


def test_terminal_gets_a_bar():
    class Terminal(io.StringIO):
        def isatty(self):
            return True
    stream = Terminal()
    display = Display(SCENARIOS["autolock"], stream)
    display.on_plan(2, 8)
    display.on_action("approach until the Car unlocks")
    display.on_result(AutolockResult(3, "rear_left", -2.25, 0.9, -0.7, 0.7, LineStatus.OK, 1.2351, 0.0321, 12.0,
                                     LineStatus.NOT_REACHED, None, None, None, ""), 3, 8)
    display.close()
    assert "3 of 8" in stream.getvalue()
    assert "[3/8] axis 3 (rear left): unlock 1.235 \N{PLUS-MINUS SIGN} 0.032 m, lock not reached" in stream.getvalue()


def test_ctrl_c_while_the_report_is_written_completes_it(parameters, tmp_path, monkeypatch, capsys):
    def interrupted(*arguments):
        os.kill(os.getpid(), signal.SIGINT)
        return write_report(*arguments)
    monkeypatch.setattr("mtr_operator.cli.run.write_report", interrupted)
    assert run("autolock", parameters, tmp_path / "out") == 130
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "budget.json", "progress.journal", "progress.json", "protocol.pdf", "protocol.png", "recording", "results.csv"]
    assert "the results are complete" in capsys.readouterr().err


def test_second_ctrl_c_breaks_off_and_keeps_the_lines(parameters, tmp_path, world, robot_link):
    def interrupt(status):
        if status.id in (200, 201):
            os.kill(os.getpid(), signal.SIGINT)
        return status
    world.spoil = interrupt
    assert run("autolock", parameters, tmp_path / "out") == 130
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "progress.journal", "progress.json", "recording"]
    assert robot_link.closed


def test_ctrl_c_before_anything_has_begun_is_no_traceback(monkeypatch, capsys):
    def interrupt(_):
        raise KeyboardInterrupt
    monkeypatch.setattr("mtr_operator.cli.commands.run_command", interrupt)
    assert main(["params", "autolock"]) == 130
    assert capsys.readouterr().err == "Interrupted.\n"


@pytest.mark.parametrize(("arguments", "part"), [
    (["fly"], "invalid choice"), (["run", "autolock"], "required: --params, --out"),
    (["run", "autolock", "--params", "a", "--out", "b", "--publisher-port", "x"], "'x' is not a whole number")])
def test_wrong_usage_is_one_line(capsys, arguments, part):
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    notice = capsys.readouterr().err
    assert caught.value.code == 2
    assert part in notice and notice.count("\n") == 1


def test_no_command_opens_the_window(monkeypatch):
    monkeypatch.setattr("mtr_operator.cli.commands.open_window", lambda options: 7)
    assert main([]) == 7


def test_missing_package_of_the_contract_is_named(tmp_path, monkeypatch, capsys):
    path = tmp_path / "parameters.yaml"
    path.write_text("", encoding="utf-8")
    for name in [name for name in sys.modules if name.startswith(("mtr_proto", "mtr_operator.robot_link"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "mtr_proto", None)
    assert run("autolock", path, tmp_path / "out", "--simulated-car") == 2
    assert "mtr_proto" in capsys.readouterr().err
