"""Localizes on recordings of real robots: half of the sweeps on the map of the other half; figures go to real.json.

Usage: python -m mtr_benchmarks.real FOLDER [--mrpt PROGRAM] --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import List, Optional

from mtr_localization.any_bag.sources import Asked

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .one_bag import Outcome, measure

TRUTH_TOPIC = "/pose_ground_truth"
GOAL_OF_MRPT = 0.8


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="with bags; each is taken for what its topics say")
    parser.add_argument("--mrpt", type=pathlib.Path, help="program to be compared with, see make bench-localization")
    parser.add_argument("--truth", default=TRUTH_TOPIC, help="topic of an independent pose (%(default)s)")
    parser.add_argument("--time-increment", type=float, help="s from beam to beam, of scans that do not say it")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    options = parser.parse_args(arguments)
    bags = sorted(options.folder.glob("*.bag"))
    if not bags:
        parser.error(f"{options.folder} has no bags; name a folder with some.")
    asked = Asked(time_increment_s=options.time_increment)
    return finish(report([measure(bag, options.truth, options.mrpt, asked) for bag in bags]), options.out / "real.json")


def report(outcomes: List[Outcome]) -> BenchmarkReport:
    """Return figures, rows, and a sentence about each unusable bag."""
    rows: List[Row] = []
    for found in outcomes:
        if found.refused:
            continue
        rows += [Row(Requirement(f"{found.bag}: valid poses", "(share)"), found.valid_share),
                 Row(Requirement(f"{found.bag}: CPU of a scan", "ms"), found.cpu_ms_per_scan)]
        if found.ours is not None:
            rival = None if found.mrpt is None else found.mrpt.rms_mm
            wanted = Requirement(f"{found.bag}: off the truth, rms", "mm", must=rival,
                                 goal=None if rival is None else GOAL_OF_MRPT * rival)
            rows.append(Row(wanted, found.ours.rms_mm, details={"p95_mm": found.ours.p95_mm, "mrpt_mm": rival}))
    remarks = [f"{found.bag}: not used. {found.refused}" for found in outcomes if found.refused]
    return BenchmarkReport(rows, {"bags": [found.document() for found in outcomes]}, remarks)


if __name__ == "__main__":
    sys.exit(main())
