"""Mutated progress files, journals and Statuses: each is refused with a sentence or taken whole, within a second.

Usage: fuzz.py [--files N] [--statuses N] [--seed N] [--out FOLDER]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import collections
import pathlib
import random
import resource
import sys
import tempfile
import time
import traceback

import fuzz_files
import fuzz_statuses
import table

# What is found beyond it would be a fault; the fuzzer of before was killed at 23.7 GB.
MEMORY_BYTES = 6 * 1000 ** 3
LIMIT_S = 1.0
MUST = ("uncaught exceptions", "hangs of more than 1 s", "accepted nonsense")


class Trial:
    """Runs cases and counts what they come to.

    Attributes:
        counts: cases by what became of them. worst_s: processor time of the slowest.
    """

    def __init__(self, name):
        self.name, self.counts, self.worst_s = name, collections.Counter(), 0.0

    def run(self, case):
        """case() returns what became of it: a word, and a sentence where it is nonsense that was accepted."""
        began_s = time.process_time()
        try:
            word, nonsense = case()
        except Exception:
            word, nonsense = "uncaught exceptions", ""
            if self.counts[word] < 5:
                traceback.print_exc(file=sys.stdout)
        used_s = time.process_time() - began_s
        self.worst_s = max(self.worst_s, used_s)
        self.counts["cases"] += 1
        self.counts[word] += 1
        self.counts["hangs of more than 1 s"] += used_s > LIMIT_S
        if nonsense:
            if self.counts["accepted nonsense"] < 5:
                print(f"{self.name}: {nonsense}")
            self.counts["accepted nonsense"] += 1


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, default=10_000, help="default %(default)s")
    parser.add_argument("--statuses", type=int, default=100_000, help="default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default %(default)s")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    files, statuses = Trial("progress files"), Trial("statuses")
    with tempfile.TemporaryDirectory() as folder:
        for case in fuzz_files.cases(pathlib.Path(folder), options.files, random.Random(f"{options.seed} files")):
            files.run(case)
    for case in fuzz_statuses.cases(options.statuses, random.Random(f"{options.seed} statuses")):
        statuses.run(case)
    counts = {f"{trial.name}: {name}": trial.counts[name] for trial in (files, statuses) for name in MUST}
    figures = {trial.name: {**trial.counts, "slowest, ms": round(1000 * trial.worst_s)} for trial in (files, statuses)}
    figures["memory, MiB"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
    return table.finish(options.out / "fuzz.json", figures, counts)


if __name__ == "__main__":
    sys.exit(main())
