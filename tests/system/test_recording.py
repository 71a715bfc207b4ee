"""A recording of the robot that maps the Car, and its replay, which decides the same."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import signal
import subprocess
import sys

import pytest
from conftest import Application, Observer

from mtr_simulation.stack import Stack, StackOptions, free_port

TOP = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = TOP / "catkin_ws/src/mtr_recording/scripts"
PARAMETERS = pathlib.Path(__file__).parent / "parameters"
# Map and Car are fitted by workers, which take some seconds on a busy machine; the recording has to go on meanwhile.
AFTER_S = 30.0
# The recorder is stopped for so much robot time: farther than localization lets the wheels be silent.
LOCALIZED_FROM_S, RECORDER_STANDS_S = 3.0, 0.6
# The way round and what follows take about 90 s of robot time; the replay waits for nodes that do not follow.
REPLAY_LIMIT_S, END_LIMIT_S = 300.0, 60.0


@pytest.fixture(scope="module")
def recorded(out):
    """Prefix of the bags of a robot that has mapped the Car."""
    with Stack(StackOptions(out)) as stack:
        program = [sys.executable, str(SCRIPTS / "record"), "--profile", "full", "--out", str(out), "--limit", "800"]
        recording = subprocess.Popen(program, env=stack.environment(), text=True, stdout=subprocess.PIPE)
        # It says so when it hears everything: a robot that has gone meanwhile would have its map elsewhere.
        said = recording.stdout.readline()
        measuring = Application(stack).start("autolock", PARAMETERS / "autolock.yaml", out / "autolock")
        observer = Observer(stack.status_port)
        try:
            stop_recorder(recording.pid, observer)
            mapped = observer.wait_for(lambda status: status.car.mapped)
            observer.wait_for(lambda status: status.state.stamp_s > mapped.state.stamp_s + AFTER_S)
        finally:
            observer.close()
            for process in (recording, measuring):
                process.send_signal(signal.SIGINT)
            recording.communicate(timeout=END_LIMIT_S)
            measuring.communicate(timeout=END_LIMIT_S)
    return pathlib.Path(said.split()[1].partition("_*.bag")[0])


def stop_recorder(pid, observer):
    """Let the recorder stand as on a busy machine: the simulated robot's clock does not wait for it."""
    begun = observer.wait_for(lambda status: status.state.stamp_s > LOCALIZED_FROM_S)
    recorders = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
    groups = [os.getpgid(int(recorder)) for recorder in recorders]
    assert groups and os.getpgid(pid) not in groups
    try:
        for group in groups:
            os.killpg(group, signal.SIGSTOP)
        observer.wait_for(lambda status: status.state.stamp_s > begun.state.stamp_s + RECORDER_STANDS_S)
    finally:
        for group in groups:
            os.killpg(group, signal.SIGCONT)


def bags(prefix):
    """Files of a recording, in their order."""
    return sorted(prefix.parent.glob(f"{prefix.name}_*.bag"), key=lambda path: int(path.stem.rpartition("_")[2]))


def test_recording_is_whole_and_its_parameters_lie_beside_it(recorded):
    assert bags(recorded) and not list(recorded.parent.glob("*.active"))
    assert "robot_description" in recorded.with_suffix(".yaml").read_text(encoding="utf-8")


def test_replay_decides_the_same(recorded, out):
    replayed = out / "replayed.bag"
    done = subprocess.run(
        ["roslaunch", "-p", str(free_port()), str(TOP / "launch" / "launch" / "replay.launch"),
         f"bag:={' '.join(map(str, bags(recorded)))}", f"parameters:={recorded.with_suffix('.yaml')}",
         f"record:={replayed}", "rate:=2"], text=True, capture_output=True, timeout=REPLAY_LIMIT_S, check=False)
    assert replayed.exists(), done.stdout + done.stderr
    compared = subprocess.run([sys.executable, str(SCRIPTS / "same_decisions"), *map(str, bags(recorded)), "--replayed",
                               str(replayed)], text=True, capture_output=True, check=False)
    assert compared.returncode == 0, compared.stdout + compared.stderr
    assert compared.stdout == "The replay decided the same.\n"
