"""Work in a process of its own: results, errors, and what happens when either side dies."""
# SPDX-License-Identifier: Apache-2.0
import math
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

from mtr_core.errors import RobotError
from mtr_core.executors import ProcessesExecutor, ProcessExecutor
from mtr_core.executors.worker import NICENESS
from mtr_core.problems import Problem, ProblemError

LIMIT_S = 60.0
# Makes an executor, tells its process and waits.
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


def wait_until(is_so):
    deadline_s = time.monotonic() + LIMIT_S
    while not is_so():
        assert time.monotonic() < deadline_s
        time.sleep(0.01)


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
    # A function of a test's module is not to be had in the process.
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
    # Done here, where it kills the dead process once more.
    with pytest.raises(ProcessLookupError):
        executor.submit(os.kill, executor.process_id, signal.SIGKILL).result()
    assert len(told) == 1 and executor.submit(math.sqrt, 9.0).result() == 3.0


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
    wait_until(lambda: not is_running(process))


def is_running(process):
    try:
        state = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()[0]
    except FileNotFoundError:
        return False
    return state not in "ZX"


def test_several_pieces_are_done_at_once_in_processes_of_their_own(told):
    with ProcessesExecutor(2, [], told.append) as executor:
        begun = executor.submit(time.sleep, 0.3), executor.submit(time.sleep, 0.3)
        waiting = executor.submit(math.sqrt, 9.0)
        assert not any(each.done() for each in (*begun, waiting))
        pids = {executor.submit(os.getpid).result() for _ in range(4)}
        assert waiting.result() == 3.0 and os.getpid() not in pids
        with pytest.raises(ValueError, match="math domain error"):
            executor.submit(math.sqrt, -1.0).result()
    assert not told


def test_piece_that_waits_for_a_process_can_be_cancelled(told):
    with ProcessesExecutor(1, [], told.append) as executor:
        executor.submit(time.sleep, 0.3)
        assert executor.submit(time.sleep, LIMIT_S).cancel()
        assert executor.submit(math.sqrt, 4.0).result() == 2.0
