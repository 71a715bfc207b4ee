"""Ctrl-C, a killed application and a full disk: the robot stands, what was measured is kept, and the test goes on."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import resource
import signal

import pytest


def results_in(folder):
    return json.loads((folder / "progress.json").read_text(encoding="utf-8"))["results"]


def assert_kept(before, after):
    """Every line is there, and as it was; one that was invalid is measured once more at the end."""
    assert [line["axis"] for line in after][:len(before)] == [line["axis"] for line in before]
    assert all(line in after for line in before if not line["reason"])


def points_in(folder):
    entries = [json.loads(line) for line in (folder / "progress.journal").read_text(encoding="utf-8").splitlines()]
    return [entry["values"] for entry in entries if entry["kind"] == "point"]


@pytest.mark.parametrize("stage", ["wait for robot", "map the Car", "axis 1 ", "approach until", "retreat until"])
def test_ctrl_c_stops_the_robot_and_leaves_no_folder_without_results(laptop, stage):
    run = laptop.start("--simulated-car")
    run.wait_until_said(stage)
    run.process.send_signal(signal.SIGINT)
    code, _, said = run.finish()
    assert code == 130, said
    assert "the robot stands still" in said
    assert said.endswith("The test was interrupted.\n")
    assert laptop.look().speed_mps == 0.0
    # What was measured before the retreat is something, too (C1); the Car may unlock while Ctrl-C is under way.
    out = laptop.folder / "out"
    has_points = out.exists() and bool(points_in(out))
    assert out.exists() is has_points
    assert has_points or "retreat until" not in said
    assert "approach until" in said or not has_points


def test_ctrl_c_after_a_result_keeps_it_and_the_test_can_be_continued(laptop):
    run = laptop.start("--simulated-car")
    run.wait_until_said("[2/8]")
    run.process.send_signal(signal.SIGINT)
    code, _, said = run.finish()
    assert code == 130, said
    measured = results_in(laptop.folder / "out")
    assert len(measured) >= 2
    assert f"go on with --continue {laptop.folder / 'out' / 'progress.json'}" in said

    run = laptop.start("--simulated-car", "--continue", laptop.folder / "out" / "progress.json")
    code, out, said = run.finish()
    assert code == 0, said
    assert_kept(measured, results_in(laptop.folder / "out"))
    assert out.splitlines()[-1].startswith("8 lines measured")


def test_killed_application_leaves_a_file_to_go_on_with(laptop):
    run = laptop.start("--simulated-car")
    run.wait_until_said("[2/8]")
    # What is shown is kept (N6).
    run.process.kill()
    assert run.finish()[0] == -signal.SIGKILL
    measured = results_in(laptop.folder / "out")
    assert len(measured) >= 2
    run = laptop.start("--simulated-car", "--continue", laptop.folder / "out" / "progress.json")
    code, _, said = run.finish()
    assert code == 0, said
    assert_kept(measured, results_in(laptop.folder / "out"))


def test_point_measured_before_a_kill_in_the_retreat_is_in_the_journal(laptop):  # C1
    run = laptop.start("--simulated-car")
    run.wait_until_said("retreat until")
    run.process.kill()
    assert run.finish()[0] == -signal.SIGKILL
    point, = points_in(laptop.folder / "out")
    assert point["word"] == "unlock"
    run = laptop.start("--simulated-car", "--continue", laptop.folder / "out" / "progress.journal")
    code, _, said = run.finish()
    assert code == 0, said
    assert points_in(laptop.folder / "out")[0] == point
    assert len(results_in(laptop.folder / "out")) == 8


def test_laptop_that_sleeps_in_the_middle_of_a_line_measures_that_line_anew(laptop):
    run = laptop.start("--simulated-car")
    run.wait_until_said("approach until")
    run.process.send_signal(signal.SIGSTOP)
    asleep_s = laptop.look().stamp_s
    # Long enough for the robot to stop by itself, and for all that waits to be old.
    while (status := laptop.look()).stamp_s < asleep_s + 40.0:
        pass
    run.process.send_signal(signal.SIGCONT)
    assert status.speed_mps == 0.0
    code, _, said = run.finish()
    assert code == 0, said
    results = results_in(laptop.folder / "out")
    assert [line["axis"] for line in results] == list(range(1, 9))
    assert not any(line["reason"] for line in results)


def test_second_application_is_told_and_the_first_loses_nothing(laptop):  # C2
    first = laptop.start("--simulated-car")
    first.wait_until_said("[2/8]")
    # On a busy machine the second one takes longer to start than the first one to its end.
    first.process.send_signal(signal.SIGSTOP)
    second = laptop.start("--simulated-car", "--continue", laptop.folder / "out" / "progress.json")
    code, _, said = second.finish()
    first.process.send_signal(signal.SIGCONT)
    assert code == 2
    assert said.endswith(f"Another application (process {first.process.pid}) is measuring the test in the folder "
                         f"{laptop.folder / 'out'}; end it there first, or choose another folder.\n")
    code, out, said = first.finish()
    assert code == 0, said
    assert len(results_in(laptop.folder / "out")) == 8


def test_file_that_cannot_grow_ends_the_test_with_a_sentence_and_keeps_the_former_one(laptop):
    # Many axes, so that it is not at its end before a busy machine has set the limit.
    parameters = laptop.folder / "autolock.yaml"
    parameters.write_text(parameters.read_text(encoding="utf-8").replace("10.0", "0.5"), encoding="utf-8")
    run = laptop.start("--simulated-car")
    run.wait_until_said("[1/")
    size = (laptop.folder / "out" / "progress.journal").stat().st_size
    # Of this process no file anywhere may grow beyond that: a second place is no way out.
    resource.prlimit(run.process.pid, resource.RLIMIT_FSIZE, (size, size))
    code, _, said = run.finish()
    assert code == 2
    assert said.endswith(f"The file {laptop.folder / 'out' / 'progress.journal'} cannot be written: File too large. No "
                         "second place could be written either; what was measured last is in this application only.\n")
    assert "the robot stands still" in said
    assert results_in(laptop.folder / "out")
    assert sorted(os.listdir(laptop.folder / "out")) == ["progress.journal", "progress.json", "recording"]
