"""One home for all fuzzers: cases by number and seed, time and memory bounded, counts that must be zero.

A border is where bytes of others come in. Its case takes a random generator and returns what became of the bytes: a
word, and a sentence where they were accepted and cannot be meant. What it raises is found. Each case has a generator of
its own, so that its number and the seed bring it back.
"""
# SPDX-License-Identifier: Apache-2.0
import collections
import contextlib
import random
import resource
import signal
import sys
import time
import traceback
from typing import Any, Callable, Dict, Iterator, Tuple

# What takes more is a fault: the largest need of a border is below 0.3 GB.
MEMORY_BYTES = 3 * 1000 ** 3
# Of processor time; what goes on beyond the second is ended, so that the rest is tried too.
LIMIT_S, END_S = 1.0, 10.0
UNCAUGHT, HANGS, NONSENSE = MUST = ("uncaught exceptions", "hangs of more than 1 s", "accepted nonsense")
MAX_SHOWN = 5
# What became of a case, and why that cannot be; empty where it can.
Result = Tuple[str, str]
Case = Callable[[random.Random], Result]


class EndlessCase(BaseException):
    """A case goes on and on. No code that is tried catches it."""


class Trial:
    """Runs cases of one border and counts what they come to.

    Attributes:
        counts: cases by what became of them. worst_s: processor time of the slowest, worst: its number.
    """

    def __init__(self, name: str, seed: int):
        self.name, self.counts = name, collections.Counter({"cases": 0})  # type: str, Counter[str]
        self.worst_s, self.worst = 0.0, 0
        self._seed = seed

    def run(self, case: Case, number: int) -> None:
        """The case of a number."""
        began_s = time.process_time()
        nonsense = ""
        try:
            with ended_in_time():
                word, nonsense = case(random.Random(f"{self._seed} {self.name} {number}"))
        except EndlessCase:
            word = "never ending"
        # Whatever it is: that is what is looked for.
        except Exception:
            word = UNCAUGHT
            self._show(word, number, traceback.format_exc())
        used_s = time.process_time() - began_s
        if used_s > self.worst_s:
            self.worst_s, self.worst = used_s, number
        self.counts["cases"] += 1
        self.counts[word] += 1
        if used_s > LIMIT_S:
            self._show(HANGS, number, f"{used_s:.1f} s")
            self.counts[HANGS] += 1
        if nonsense:
            self._show(NONSENSE, number, nonsense)
            self.counts[NONSENSE] += 1

    def figures(self) -> Dict[str, Any]:
        """Counts, and the slowest case."""
        return {**self.counts, "slowest, ms": round(1000.0 * self.worst_s), "slowest case": self.worst,
                "memory, MiB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024}

    def _show(self, what: str, number: int, text: str) -> None:
        if self.counts[what] < MAX_SHOWN:
            print(f"{self.name}, case {number}, {what}: {text}", file=sys.stderr)


@contextlib.contextmanager
def ended_in_time() -> Iterator[None]:
    """Context that raises EndlessCase beyond the time."""
    def end(*_: object) -> None:
        raise EndlessCase
    signal.signal(signal.SIGPROF, end)
    signal.setitimer(signal.ITIMER_PROF, END_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)


def bound_memory() -> None:
    """Let this process have so much memory and no more."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
