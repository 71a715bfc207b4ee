"""Measures many lines on all processors, and summarizes them."""
# SPDX-License-Identifier: Apache-2.0
import collections
import concurrent.futures
import functools
import os
from dataclasses import dataclass
from typing import Dict, List, Sequence

from .judge import Verdict
from .line import Line, run_line

UNDISTURBED = "none"
_CHUNK = 50
_EXAMPLES = 20


@dataclass(frozen=True)
class TruthFigures:
    """Counts of lines. by_kind: number of lines, wrong and invalid ones by disturbance. examples: some of the lines."""

    seed: int
    lines: int
    wrong_and_ok: int
    invalid: int
    invalid_without_cause: int
    undisturbed: int
    undisturbed_invalid: int
    by_kind: Dict[str, Dict[str, int]]
    wrong_examples: List[str]
    without_cause_examples: List[str]

    @property
    def share_without_cause(self) -> float:
        """Share of all lines."""
        return self.invalid_without_cause / self.lines


def run_campaign(seed: int, lines: int, processes: int = 0) -> TruthFigures:
    """Measure the given number of lines; 0 processes: one per processor."""
    work = functools.partial(run_line, seed)
    if processes == 1:
        return figures(seed, [work(number) for number in range(lines)])
    with concurrent.futures.ProcessPoolExecutor(processes or os.cpu_count()) as pool:
        return figures(seed, list(pool.map(work, range(lines), chunksize=_CHUNK)))


def figures(seed: int, lines: Sequence[Line]) -> TruthFigures:
    """Return the figures of these lines."""
    wrong = [line for line in lines if line.verdict is Verdict.WRONG]
    invalid = [line for line in lines if line.verdict is Verdict.INVALID]
    groundless = [line for line in invalid if not line.is_disturbed]
    undisturbed = [line for line in lines if line.kind == UNDISTURBED]
    by_kind: Dict[str, Dict[str, int]] = collections.defaultdict(lambda: {"lines": 0, "wrong": 0, "invalid": 0})
    for line in lines:
        counts = by_kind[line.kind]
        counts["lines"] += 1
        counts["wrong"] += line.verdict is Verdict.WRONG
        counts["invalid"] += line.verdict is Verdict.INVALID
    return TruthFigures(seed, len(lines), len(wrong), len(invalid), len(groundless), len(undisturbed),
                        sum(line.kind == UNDISTURBED for line in invalid), dict(by_kind), _examples(wrong),
                        _examples(groundless))


def _examples(lines: Sequence[Line]) -> List[str]:
    return [f"line {line.number}, {line.kind}: {', '.join(line.told)} {line.reason}".rstrip()
            for line in lines[:_EXAMPLES]]
