"""Measures lines of both scenarios in a simulated world with one random disturbance each; figures go to truth.json.

Usage: python -m mtr_benchmarks.truth --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from dataclasses import asdict
from typing import List, Optional

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .campaign import TruthFigures, run_campaign

LINES = 10_000
# A car maker relies on an ok distance; an invalid line only costs a repetition.
WRONG = Requirement("wrong and ok: more than 3 sigma or 5 cm off, or of another cause", "(count)", must=0.0)
WITHOUT_CAUSE = Requirement("invalid without a cause, of all lines", "(share)", must=0.01)
UNDISTURBED = Requirement("undisturbed lines invalid", "(count)", must=0.0)
INVALID = Requirement("invalid, of all lines", "(share)")


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--lines", type=int, default=LINES)
    options = parser.parse_args(arguments)
    return finish(report(run_campaign(options.seed, options.lines)), options.out / "truth.json")


def report(found: TruthFigures) -> BenchmarkReport:
    """Return figures and rows."""
    rows = [Row(WRONG, found.wrong_and_ok), Row(WITHOUT_CAUSE, found.share_without_cause),
            Row(UNDISTURBED, found.undisturbed_invalid), Row(INVALID, found.invalid / found.lines)]
    remarks = [f"{kind}: {counts['lines']} lines, {counts['wrong']} wrong, {counts['invalid']} invalid"
               for kind, counts in found.by_kind.items()]
    return BenchmarkReport(rows, asdict(found), [*remarks, *found.wrong_examples, *found.without_cause_examples])


if __name__ == "__main__":
    sys.exit(main())
