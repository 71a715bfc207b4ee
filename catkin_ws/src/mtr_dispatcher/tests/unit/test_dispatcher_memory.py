"""The dispatcher ends before strangers fill the machine's memory. D1"""
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys

from mtr_dispatcher import memory
from mtr_dispatcher.memory import EXIT_STATUS, LAST_RESORT, MIB, give_back, resident_mib

FILL = f"""
import time
from mtr_dispatcher.memory import end_beyond
end_beyond(100.0)
kept = [b"x" * (10 * {MIB}) for _ in range({{tens}})]
time.sleep({{then_s}})
"""
LIMIT_S = 30.0


def ended(tens, then_s):
    """Return the ended process that allocated `tens` times 10 MiB and then lived for `then_s`."""
    return subprocess.run([sys.executable, "-c", FILL.format(tens=tens, then_s=then_s)], timeout=LIMIT_S, check=False,
                          capture_output=True, text=True)


def test_process_ends_with_a_sentence_when_its_memory_is_beyond_the_last_resort():
    process = ended(tens=20, then_s=2.0 * LIMIT_S)
    assert process.returncode == EXIT_STATUS and f"allowed are {100.0 * LAST_RESORT:.0f}" in process.stderr


def test_watch_goes_on_when_the_memory_could_not_be_read_once(monkeypatch):
    looks = iter((OSError("Too many open files"), 50.0, 160.0))

    def look():
        found = next(looks)
        if isinstance(found, OSError):
            raise found
        return found
    ended_with = []
    monkeypatch.setattr(memory, "resident_mib", look)
    monkeypatch.setattr(memory, "CHECK_PERIOD_S", 0.0)
    monkeypatch.setattr(memory.os, "_exit", ended_with.append)
    memory._watch(150.0)
    assert ended_with == [EXIT_STATUS] and not list(looks)


def test_process_within_the_limit_goes_on():
    assert ended(tens=2, then_s=1.0).returncode == 0


def test_memory_of_this_process_is_known_and_can_be_given_back():
    assert 5.0 < resident_mib() < 2000.0
    give_back()
