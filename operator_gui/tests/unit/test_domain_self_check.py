"""The self-check before a test, and the Car coordinate systems that its lines were measured in."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import queue
from dataclasses import replace

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.robot import CHECK_LIMIT_S, Robot
from mtr_operator.domain.errors import ProgressFileError, RobotFailed
from mtr_operator.domain.robot_status import CarCheck, CarDimensions, CarFrame, CheckState
from mtr_operator.domain.scenarios.autolock import SCENARIO
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.report.results_csv import results_csv
from mtr_operator.storage.progress_document import progress_from_document

PARAMETERS = AutolockParameters(measurements_distance_m=10.0)
PASSED = CarCheck(0, CheckState.PASSED, 0.003, 0.001, 0.02, 0.0087, "The Car stands where it was.")
NOT_PASSED = replace(PASSED, state=CheckState.FAILED, difference_m=0.035, message="The Car stands 3.5 cm off.")
UNSEEN = replace(NOT_PASSED, difference_m=math.nan, difference_rad=math.nan, message="The Car was not seen.")


class Actions(RunObserver):
    """Keeps what the robot says that it does."""

    def __init__(self):
        self.said = []

    def on_action(self, text):
        self.said.append(text)


def test_car_is_checked_before_the_first_line_and_the_difference_is_kept(world, run_scenario):
    world.check, world.frame = PASSED, CarFrame(revision=2)
    actions = Actions()
    assert len(run_scenario(SCENARIO, PARAMETERS, observer=actions)) == 8
    assert actions.said.index("check where the Car stands") < actions.said.index("axis 1 (front): go to the start")
    record = run_scenario.progress.frame_record
    check, = record.checks
    assert (check.state, check.difference_m, check.frame) == ("passed", 0.003, 0)
    assert [frame.revision for frame in record.frames] == [2]
    assert record.lines == {str(number): 0 for number in range(1, 9)}


@pytest.mark.parametrize("answer", [NOT_PASSED, UNSEEN])
def test_test_does_not_begin_when_the_car_stands_elsewhere(world, run_scenario, robot_link, answer):
    world.check = answer
    with pytest.raises(RobotFailed, match=answer.message):
        run_scenario(SCENARIO, PARAMETERS)
    assert not run_scenario.progress.results and run_scenario.progress.frame_record.checks[0].state == "failed"
    assert robot_link.answers[-1][1].stop


def test_check_can_be_left_out(world, run_scenario):
    world.check = NOT_PASSED
    assert len(run_scenario(SCENARIO, replace(PARAMETERS, self_check=False))) == 8
    assert not run_scenario.progress.frame_record.checks


def test_robot_that_knows_no_check_measures_after_a_warning(world, run_scenario):
    actions = Actions()
    assert len(run_scenario(SCENARIO, PARAMETERS, observer=actions)) == 8
    assert any(text.startswith("warning: the robot's software is too old") for text in actions.said)


def test_check_that_never_ends_is_an_error_with_what_the_robot_says(world, robot_link, car_link):
    world.check = replace(PASSED, state=CheckState.RUNNING)
    robot = Robot(ControlLoop(robot_link, car_link))
    with pytest.raises(RobotFailed, match=f"within {CHECK_LIMIT_S:g} s"):
        robot.check_car()


def test_each_check_is_a_new_order(world, robot_link, car_link):
    world.check = PASSED
    robot = Robot(ControlLoop(robot_link, car_link))
    assert [robot.check_car().id for _ in range(2)] == [1, 2]


def test_lines_stay_in_the_frame_in_which_they_were_measured(world, run_scenario):
    before, after = CarFrame(1), CarFrame(2, 0.031, -0.004, 0.0017)
    world.frame = before

    def correct(status):
        world.frame = after if status.waypoint_id >= 13 else before
        return replace(status, car_frame=world.frame)
    world.spoil = correct
    results = run_scenario(SCENARIO, PARAMETERS)
    record = run_scenario.progress.frame_record
    assert [frame.revision for frame in record.frames] == [1, 2]
    assert record.frames[1].correction_x_m == 0.031
    assert set(record.lines.values()) == {0, 1} and len(record.lines) == 8
    assert all(result.unlock_status.value == "ok" for result in results)
    notice = results_csv(SCENARIO, replace_session(run_scenario.progress))
    assert "# Car frame 2: revision 2 since" in notice
    assert "corrected by 3.1 cm ahead, -0.4 cm to the left, 0.10 deg; measured in it: " in notice


def replace_session(progress):
    """What the runner adds in the application."""
    progress.session = {"started": "today"}
    return progress


def test_line_during_which_the_frame_changed_is_measured_again(world, run_scenario):
    frames = {"now": CarFrame(1)}

    def correct(status):
        if world.speed_mps > 0.0 and status.stamp_s > 20.0:
            frames["now"] = CarFrame(2, 0.02)
        return replace(status, car_frame=frames["now"])
    world.spoil = correct
    saved = []

    class Lines(RunObserver):
        def on_result(self, result, done, total):
            saved.append(result)
    results = run_scenario(SCENARIO, PARAMETERS, observer=Lines())
    assert sum("corrected during the measurement" in result.reason for result in saved) == 1
    assert len(saved) == 9 and all(result.unlock_status.value == "ok" for result in results)


def test_poses_of_two_frames_are_not_mixed(world, robot_link, car_link):
    session = ControlLoop(robot_link, car_link)
    world.frame = CarFrame(1)
    for _ in range(5):
        session.step()
    before_s = session.now_s
    world.frame = CarFrame(2, 0.05)
    session.step()
    assert session.poses.at(session.now_s)
    with pytest.raises(Exception, match="No poses"):
        session.poses.at(before_s)


@pytest.fixture
def progress(world, run_scenario):
    world.check, world.frame = PASSED, CarFrame(2, 0.01, 0.0, 0.0)
    world.car = CarDimensions(4.5, 1.8, 0.02, 0.01, ((2.25, 0.9), (-2.25, 0.9), (0.0, -0.9)))
    run_scenario(SCENARIO, PARAMETERS)
    return run_scenario.progress


def test_record_and_outline_survive_the_progress_file(progress):
    document = json.loads(json.dumps(progress.to_document(), allow_nan=False))
    read = progress_from_document(document, SCENARIO, PARAMETERS.to_mapping())
    assert read == progress and read.car.outline[0] == (2.25, 0.9)


def test_progress_file_without_a_record_can_be_continued_with_and_without_the_check(progress):
    document = json.loads(json.dumps(progress.to_document()))
    del document["frame_record"], document["parameters"]["self_check"]
    for is_checked in (True, False):
        parameters = replace(PARAMETERS, self_check=is_checked).to_mapping()
        assert progress_from_document(document, SCENARIO, parameters).frame_record.frames == []


@pytest.mark.parametrize("damage", [
    {"frames": 3}, {"lines": {"1": 9}}, {"lines": {"1": "0"}}, {"frames": [{"revision": 1}]},
    {"checks": [{"robot_time_s": "x", "state": "passed"}]},
    {"checks": [{"robot_time_s": 1.0, "state": "passed", "difference_m": "x", "difference_rad": 0.0}]}])
def test_damaged_record_is_a_sentence(progress, damage):
    document = json.loads(json.dumps(progress.to_document()))
    document["frame_record"].update(damage)
    with pytest.raises(ProgressFileError, match="damaged"):
        progress_from_document(document, SCENARIO, PARAMETERS.to_mapping())


def test_checks_are_told_in_the_results(progress):
    notice = results_csv(SCENARIO, replace_session(progress))
    assert "difference 0.3 cm, 0.06 deg (limits 2.0 cm, 0.50 deg)" in notice
    assert "# parameter self_check: true" in notice


@pytest.fixture
def command(robot_link, monkeypatch):
    """Runs the command line's check on the world's robot; its exit code."""
    monkeypatch.setattr("mtr_operator.cli.orders.checking.robot_link", lambda options: robot_link)
    return lambda: main(["check"])


def test_check_command_prints_the_answer(world, robot_link, command, capsys):
    world.check = PASSED
    assert command() == 0
    assert capsys.readouterr().out == "The Car stands where it was.\n"
    assert robot_link.closed and robot_link.answers[-1][1].stop


@pytest.mark.parametrize("case", [(NOT_PASSED, True, "3.5 cm off"), (None, True, "too old"),
                                  (PASSED, False, "has not found the Car yet")])
def test_check_command_ends_with_a_sentence(world, command, capsys, case):
    world.check, is_found, part = case
    world.car = world.car if is_found else None
    assert command() == 2
    assert part in capsys.readouterr().err.splitlines()[-1]


class Keyboard:
    """A standard input on which a line is ready as soon as `lines` has one."""

    def __init__(self):
        self.lines = queue.Queue()

    def readline(self):
        return self.lines.get()


def test_robot_that_is_held_on_its_way_is_had_go_on_by_enter(world, robot_link, command, capsys, monkeypatch):
    world.check, keyboard, asked = PASSED, Keyboard(), []
    monkeypatch.setattr("sys.stdin", keyboard)

    def held(status):
        wanted = world.desired
        if wanted is None or not wanted.check_car_id or wanted.resume_hold_id == 77:
            return status
        asked.append(status)
        if len(asked) == 3:
            # The question was asked at the first of them.
            keyboard.lines.put("\n")
        return replace(status, hold_id=77)
    world.spoil = held
    assert command() == 0
    said = capsys.readouterr()
    assert "press Enter" in said.out + said.err and "The Car stands where it was." in said.out
    assert len(asked) >= 3
    keyboard.lines.put("")


def test_virtual_robot_checks_too(tmp_path, capsys):
    parameters = tmp_path / "p.yaml"
    parameters.write_text("measurements_distance_m: 10.0\nself_check: true\n", encoding="utf-8")
    assert main(["run", "autolock", "--params", str(parameters), "--out", str(tmp_path / "out"), "--simulated-robot",
                 "--simulated-car"]) == 0
    assert "self-check at" in (tmp_path / "out" / "results.csv").read_text(encoding="utf-8")
