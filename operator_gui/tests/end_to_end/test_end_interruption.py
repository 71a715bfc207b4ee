"""Ctrl-C, a killed application and a full disk: the robot stands, what was measured is kept, and the test goes on."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import resource
import signal

import pytest


def results_in(folder):
    return json.loads((folder / "progress.json").read_text(encoding="utf-8"))["results"]


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
    assert (laptop.folder / "out").exists() is ("[1/8]" in said)


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
    assert results_in(laptop.folder / "out")[:len(measured)] == measured
    assert out.splitlines()[-1].startswith("8 lines measured")


def test_killed_application_leaves_a_file_to_go_on_with(laptop):
    run = laptop.start("--simulated-car")
    run.wait_until_said("[2/8]")
    # Shown before it is saved; the next line begins when it is.
    run.wait_until_said("axis 3 ")
    run.process.kill()
    assert run.finish()[0] == -signal.SIGKILL
    measured = results_in(laptop.folder / "out")
    assert len(measured) >= 2
    run = laptop.start("--simulated-car", "--continue", laptop.folder / "out" / "progress.json")
    code, _, said = run.finish()
    assert code == 0, said
    assert results_in(laptop.folder / "out")[:len(measured)] == measured


def test_file_that_cannot_grow_ends_the_test_with_a_sentence_and_keeps_the_former_one(laptop):
    run = laptop.start("--simulated-car")
    run.wait_until_said("[1/8]")
    run.wait_until_said("axis 2 ")
    size = (laptop.folder / "out" / "progress.json").stat().st_size
    resource.prlimit(run.process.pid, resource.RLIMIT_FSIZE, (size, size))
    code, _, said = run.finish()
    assert code == 2
    assert said.endswith(f"The file {laptop.folder / 'out' / 'progress.json'} cannot be written: File too large.\n")
    assert "the robot stands still" in said
    assert results_in(laptop.folder / "out")
    assert os.listdir(laptop.folder / "out") == ["progress.json"]
