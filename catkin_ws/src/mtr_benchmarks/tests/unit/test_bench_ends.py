"""The end of a benchmark, for whatever reason, ends its robot and releases all of its resources."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

from mtr_benchmarks.harness.own_process import OwnProcessError, in_own_process

LIMIT_S = 30.0
# Replacement of roslaunch: it accepts connections like a robot, and writes a file when it was ended in order. Both
# programs sleep in steps, because a signal that arrives just before pause(2) is only handled after the next one.
ROBOT = """#!{python}
import pathlib, signal, socket, sys, time
arguments = dict(each.split(":=", 1) for each in sys.argv if ":=" in each)
folder = pathlib.Path(arguments["truth_dir"])
ports = [socket.create_server(("127.0.0.1", int(arguments[name]))) for name in ("status_port", "command_port")]
signal.signal(signal.SIGINT, lambda *_: sys.exit((folder / "ended").write_text("in order")))
(folder / "can").touch()
while True:
    time.sleep(0.05)
"""
# Program with a robot in its own process, like the soak, or in a child process, like the matrix.
BENCHMARK = """
import contextlib, os, pathlib, sys, time
from mtr_benchmarks.harness.own_process import end_in_order, in_own_process
from mtr_simulation.stack import Stack, StackOptions

def work(folder):
    with contextlib.ExitStack() as opened:
        opened.callback((folder / "closed").touch)
        opened.enter_context(Stack(StackOptions(folder)))
        (folder / "begun.part").write_text(str(os.getpid()))
        (folder / "begun.part").rename(folder / "begun")
        while True:
            time.sleep(0.05)

if __name__ == "__main__":
    end_in_order()
    folder = pathlib.Path(sys.argv[1])
    in_own_process(work, folder) if sys.argv[2] == "own" else work(folder)
"""


def waited(condition):
    end_s = time.monotonic() + LIMIT_S
    while not condition() and time.monotonic() < end_s:
        time.sleep(0.02)
    return condition()


def is_gone(process):
    # A terminated process that was not waited for is a zombie.
    stat = pathlib.Path(f"/proc/{process}/stat")
    try:
        return stat.read_text(encoding="ascii").rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


@pytest.fixture(name="benchmark_in")
def fixture_benchmark_in(tmp_path):
    """Return a function that starts the benchmark and returns its process when its robot runs."""
    (tmp_path / "roslaunch").write_text(ROBOT.format(python=sys.executable), encoding="utf-8")
    (tmp_path / "roslaunch").chmod(0o755)
    (tmp_path / "benchmark.py").write_text(BENCHMARK, encoding="utf-8")
    started = []

    def start(place):
        environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
        started.append(subprocess.Popen([sys.executable, str(tmp_path / "benchmark.py"), str(tmp_path), place],
                                        env=environment))
        assert waited((tmp_path / "begun").exists)
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.wait()


@pytest.mark.parametrize("place", ["here", "own"])
def test_a_request_to_terminate_closes_everything(benchmark_in, tmp_path, place):
    benchmark = benchmark_in(place)
    benchmark.send_signal(signal.SIGTERM)
    assert benchmark.wait(LIMIT_S) == 128 + signal.SIGTERM
    assert (tmp_path / "ended").exists() and (tmp_path / "closed").exists()


def test_a_robot_ends_with_a_benchmark_that_is_killed(benchmark_in, tmp_path):
    benchmark_in("here").kill()
    assert waited((tmp_path / "ended").exists)


def test_a_process_of_its_own_closes_everything_when_the_benchmark_is_killed(benchmark_in, tmp_path):
    benchmark_in("own").kill()
    worker = int((tmp_path / "begun").read_text(encoding="ascii"))
    assert waited(lambda: is_gone(worker))
    assert (tmp_path / "ended").exists() and (tmp_path / "closed").exists()


def test_result_of_a_process_of_its_own_comes_back():
    assert in_own_process(divmod, 17, 5) == (3, 2)


def test_a_process_that_ends_without_a_result_is_told(capfd):
    with pytest.raises(OwnProcessError, match="divmod ended with status 1"):
        in_own_process(divmod, 1, 0)
    assert "ZeroDivisionError" in capfd.readouterr().err
