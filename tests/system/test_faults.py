"""Cables pulled in the middle of a test: the robot stands still, the Operator is told, nothing measured is lost."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import re
import signal
import subprocess

import pytest

from mtr_proto import robot_link_pb2
from mtr_simulation.demo import read_rows
from mtr_simulation.stack import Stack, StackOptions

PARAMETERS = pathlib.Path(__file__).parent / "parameters"
# A log's line that an Operator or a service has to look at.
WARNING = re.compile(r"\[ *(WARN|ERROR|FATAL)\]")
# Simulated time, which begins at 1 s. What is missing for 5 s after the start is a warning.
STARTED_S = 8.0
MOVING_MPS = 0.2
STANDING_MPS = 0.02


@pytest.fixture(scope="module")
def stack(out):
    """Paced and not in lock-step with the application: a robot that does not wait."""
    with Stack(StackOptions(out, seed=2, real_time_factor=4.0, lockstep_operator=False)) as running:
        yield running


def moves(status):
    return status.state.speed > MOVING_MPS


def stands(status):
    return abs(status.state.speed) < STANDING_MPS


def said(status, code):
    return code in {notification.code for notification in status.notifications}


def test_clean_start_says_nothing_that_looks_like_a_fault(stack, observer):
    ready = robot_link_pb2.MODE_READY_TO_MAP_CAR
    observer.wait_for(lambda status: status.sent_time_s > STARTED_S and status.mode == ready)
    log = stack.log.read_text(encoding="utf-8", errors="replace")
    assert "READY_TO_MAP_CAR" in log
    assert [line for line in log.splitlines() if WARNING.search(line) or "Traceback" in line] == []


def test_killed_application_stops_the_robot_and_the_test_can_be_continued(application, observer, out):
    folder = out / "autolock"
    running = application.start("autolock", PARAMETERS / "autolock.yaml", folder)
    progress = folder / "progress.json"
    observer.wait_for(lambda status: progress.exists() and moves(status))
    running.kill()
    running.communicate()
    measured = json.loads(progress.read_text(encoding="utf-8"))["results"]
    assert measured

    lost = observer.wait_for(lambda status: said(status, "link_lost"))
    stopped = observer.wait_for(stands)
    assert stopped.sent_time_s - lost.sent_time_s < 1.0

    done = application.run("autolock", PARAMETERS / "autolock.yaml", folder, "--continue", str(progress))
    assert done.returncode == 0, done.stderr
    assert json.loads(progress.read_text(encoding="utf-8"))["results"][:len(measured)] == measured
    assert len(read_rows(folder / "results.csv")) == 8


def test_ctrl_c_stops_the_robot_and_saves(application, observer, out):
    folder = out / "interrupted"
    running = application.start("autolock", PARAMETERS / "autolock.yaml", folder)
    observer.wait_for(lambda status: (folder / "progress.json").exists() and moves(status))
    running.send_signal(signal.SIGINT)
    _, said_to_operator = running.communicate(timeout=30)
    assert running.returncode == 130, said_to_operator
    assert json.loads((folder / "progress.json").read_text(encoding="utf-8"))["results"]
    observer.wait_for(stands)


def test_dead_planner_means_standstill_and_a_sentence(application, observer, out, stack):
    running = application.start("autolock", PARAMETERS / "autolock.yaml", out / "planner")
    observer.wait_for(moves)
    subprocess.run(["rosnode", "kill", "/motion_planner"], env=stack.environment(), check=True, capture_output=True)
    faulty = observer.wait_for(lambda status: any("planner" in note.text for note in status.notifications))
    stopped = observer.wait_for(stands)
    assert stopped.sent_time_s - faulty.sent_time_s < 1.0
    later = observer.wait_for(lambda status: status.sent_time_s > stopped.sent_time_s + 1.0)
    assert stands(later)
    running.send_signal(signal.SIGINT)
    running.communicate(timeout=30)
