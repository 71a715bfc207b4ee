"""Faults of processes, disk, processor and clock on this machine, as far as a test may inject them."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import struct
import subprocess
import sys
import time

import pytest

from mtr_fault_injection import processes
from mtr_fault_injection.machine import FullDisk
from mtr_fault_injection.parts import FaultError, Kind
from mtr_fault_injection.processes import ProcessFault, process_of
from mtr_fault_injection.set_clock import OFFSET, ClockFile

LIMIT_S = 20.0
COUNT = "import sys, itertools\nfor number in itertools.count(): print(number, flush=True)"


@pytest.fixture
def child():
    process = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    yield process
    process.kill()
    process.wait()


def state_of(process):
    """Return the state of a process; T: stopped."""
    return pathlib.Path(f"/proc/{process.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0]


def wait_for(condition):
    end_s = time.monotonic() + LIMIT_S
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(0.005)


def test_process_is_stopped_until_the_end(child):
    fault = ProcessFault(Kind.STOP, lambda: [child.pid])
    wait_for(lambda: state_of(child) == "T")
    fault.end()
    wait_for(lambda: state_of(child) != "T")


def test_slow_process_goes_on_and_stops_by_turns_and_runs_at_the_end(child):
    fault = ProcessFault(Kind.SLOW, lambda: [child.pid])
    for state in "TST":
        wait_for(lambda state=state: state_of(child) == state)
    fault.end()
    wait_for(lambda: state_of(child) == "S")


def test_killed_process_that_comes_back_is_killed_again(child):
    second = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    there = iter([[child.pid], [child.pid]])
    fault = ProcessFault(Kind.KILL, lambda: next(there, [second.pid]))
    assert child.wait(LIMIT_S) == -9 and second.wait(LIMIT_S) == -9
    fault.end()


def test_node_that_is_not_there_is_a_sentence(monkeypatch):
    with pytest.raises(FaultError, match="localization does not answer"):
        process_of("http://127.0.0.1:1", "localization")
    master = type("Master", (), {"lookupNode": lambda *_: (-1, "unknown node", "")})
    monkeypatch.setattr(processes.xmlrpc.client, "ServerProxy", lambda uri: master())
    with pytest.raises(FaultError, match="localization does not run: unknown node"):
        process_of("http://127.0.0.1:1", "localization")


def test_clock_is_set_for_whoever_reads_the_file(tmp_path):
    file = tmp_path / "offset"
    file.write_bytes(struct.pack("=q", 0))
    clock = ClockFile(str(file))
    clock.set_by(0.4)
    clock.set_by(-1.0)
    assert OFFSET.unpack(file.read_bytes()) == (-600_000_000,)


@pytest.mark.parametrize("make", [lambda: ClockFile(""), lambda: ClockFile("/nowhere/offset"),
                                  lambda: FullDisk("", 10), lambda: FullDisk("/nowhere", 10)])
def test_what_was_not_prepared_is_refused(make):
    with pytest.raises(FaultError, match=r"(clock_file|disk_folder)"):
        make()


def test_disk_with_more_free_space_than_allowed_is_not_filled(tmp_path):
    with pytest.raises(FaultError, match="at most 0 MiB are filled"):
        FullDisk(str(tmp_path), 0)


def test_full_disk_takes_all_that_is_there_and_gives_it_back(tmp_path, monkeypatch):
    written = []

    def write(_, piece):
        if sum(written) + len(piece) > 5_000_000:
            raise OSError(28, "No space left on device")
        written.append(len(piece))
    monkeypatch.setattr("mtr_fault_injection.machine.os.write", write)
    disk = FullDisk(str(tmp_path), 1 << 40)
    assert 5_000_000 - sum(written) < 65536 and not list(tmp_path.iterdir())
    disk.end()
    assert disk._file.closed
