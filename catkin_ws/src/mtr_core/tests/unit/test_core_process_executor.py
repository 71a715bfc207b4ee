"""Work in a separate process: results, errors, and the death of either process."""
# SPDX-License-Identifier: Apache-2.0
import math
import os
import pathlib
import signal
import subprocess
import sys
import threading

import pytest

from mtr_core.errors import RobotError
from mtr_core.executors import ProcessesExecutor, ProcessExecutor
from mtr_core.executors.worker import NICENESS
from mtr_core.problems import Problem, ProblemError

LIMIT_S = 60.0
# Creates an executor, prints the id of its process and waits.
OWNER = """
import sys
from mtr_core.executors import ProcessExecutor
executor = ProcessExecutor([], print)
print(executor.submit(len, "four").result(), executor.process_id, flush=True)
sys.stdin.read()
"""


@pytest.fixture
def told():
    return []


@pytest.fixture
def executor(told):
    with ProcessExecutor(["mtr_core.problems"], told.append) as made:
        yield made


@pytest.fixture
def pipe(tmp_path):
    """Return a named pipe; opening it for reading blocks until a writer opens it."""
    path = tmp_path / "pipe"
    os.mkfifo(path)
    return path


def test_work_is_done_in_another_process_which_comes_second(executor):
    assert executor.submit(os.getpid).result() == executor.process_id != os.getpid()
    assert executor.submit(os.getsid, 0).result() == executor.process_id
    assert executor.submit(os.nice, 0).result() == os.nice(0) + NICENESS


def test_one_piece_after_another_with_its_own_result(executor):
    assert [executor.submit(math.sqrt, number * number).result() for number in range(10)] == list(range(10))
    assert executor.submit(sorted, [1, 3, 2], reverse=True).result() == [3, 2, 1]


def test_error_comes_back_as_it_was_raised(executor):
    with pytest.raises(ValueError, match="math domain error"):
        executor.submit(math.sqrt, -1.0).result()
    assert executor.submit(math.sqrt, 4.0).result() == 2.0


def test_problem_comes_back_whole(executor):
    problem = Problem("core.test", "Nothing is there.", (("length_m", "3.5"),))
    # The worker process cannot import a function of a test module.
    error = executor.submit(ProblemError, problem).result()
    assert isinstance(error, RobotError) and error.problem == problem and str(error) == problem.text


def test_after_its_death_the_work_is_done_all_the_same(executor, told):
    dead = executor.process_id
    os.kill(dead, signal.SIGKILL)
    assert executor.submit(math.sqrt, 4.0).result() == 2.0
    assert len(told) == 1 and f"process {dead}" in told[0] and "status -9" in told[0]
    assert executor.submit(os.getpid).result() == executor.process_id != dead
    assert len(told) == 1


def test_killed_while_it_works_it_is_replaced(executor, told):
    assert executor.submit(os.kill, executor.process_id, 0).result() is None
    # This process repeats the work, and so tries to kill the dead process again.
    with pytest.raises(ProcessLookupError):
        executor.submit(os.kill, executor.process_id, signal.SIGKILL).result()
    assert len(told) == 1 and executor.submit(math.sqrt, 9.0).result() == 3.0


@pytest.mark.parametrize("size", [10, 10_000_000], ids=["small", "more than is taken in"])
def test_stopped_it_is_waited_for_so_long_and_replaced(told, size):
    with ProcessExecutor([], told.append, patience_s=1.0) as executor:
        executor.submit(len, "four").result()
        stopped = executor.process_id
        os.kill(stopped, signal.SIGSTOP)
        assert executor.submit(len, bytes(size)).result() == size
        assert len(told) == 1 and f"process {stopped}" in told[0] and "has not answered for 1 s" in told[0]
        assert executor.submit(os.getpid).result() == executor.process_id != stopped


def test_process_that_imports_for_longer_than_a_piece_may_take_is_waited_for(told, pipe, tmp_path, monkeypatch):
    (tmp_path / "slow_to_import.py").write_text(f"open({str(pipe)!r}).read()\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    ends = threading.Timer(1.5, pipe.write_text, ["imported"])
    ends.daemon = True
    with ProcessExecutor(["slow_to_import"], told.append, patience_s=1.0) as executor:
        ends.start()
        assert executor.submit(os.getpid).result() == executor.process_id
    assert not told


def test_process_that_dies_while_it_imports_is_replaced(told):
    with ProcessExecutor(["no_such_module"], told.append) as executor:
        assert executor.submit(math.sqrt, 4.0).result() == 2.0
        assert executor.submit(math.sqrt, 9.0).result() == 3.0
    assert len(told) == 2 and all("status 1" in sentence for sentence in told)


def test_interrupted_with_all_of_a_service_it_waits_for_its_owner(executor, told):
    executor.submit(len, "four").result()
    os.kill(executor.process_id, signal.SIGINT)
    assert executor.submit(math.sqrt, 4.0).result() == 2.0 and not told


def test_it_ends_with_the_executor(told):
    executor = ProcessExecutor([], told.append)
    executor.submit(len, "four").result()
    executor.shutdown()
    assert not pathlib.Path(f"/proc/{executor.process_id}").exists() and not told


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT, signal.SIGTERM], ids=lambda how: how.name)
def test_it_ends_with_its_owner_however_that_ends(how):
    with subprocess.Popen([sys.executable, "-c", OWNER], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True) as owner:
        length, process = owner.stdout.readline().split()
        assert length == "4" and pathlib.Path(f"/proc/{process}").exists()
        owner.send_signal(how)
        owner.wait(LIMIT_S)
        # The worker inherits its owner's output, which ends when both processes have ended.
        owner.communicate(timeout=LIMIT_S)


def test_several_pieces_are_done_at_once_in_processes_of_their_own(told, pipe):
    with ProcessesExecutor(2, [], told.append) as executor:
        read = executor.submit(pathlib.Path.read_text, pipe)
        written = executor.submit(pathlib.Path.write_text, pipe, "from one to the other")
        assert read.result(LIMIT_S) == "from one to the other" and written.result(LIMIT_S) == len(read.result())
        assert os.getpid() not in {executor.submit(os.getpid).result() for _ in range(4)}
        with pytest.raises(ValueError, match="math domain error"):
            executor.submit(math.sqrt, -1.0).result()
    assert not told


def test_piece_that_waits_for_a_process_can_be_cancelled(told, pipe):
    with ProcessesExecutor(1, [], told.append) as executor:
        read = executor.submit(pathlib.Path.read_text, pipe)
        assert executor.submit(math.sqrt, 4.0).cancel()
        pipe.write_text("go on")
        assert read.result(LIMIT_S) == "go on" and executor.submit(math.sqrt, 4.0).result() == 2.0
