"""Runs complete tests around random Cars and sweeps them against the true bodies; figures go to car_clearance.json.

Usage: python -m mtr_benchmarks.car_clearance --out out/bench [--cars 200] [--seed 1]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import multiprocessing
import pathlib
import sys
from dataclasses import asdict
from typing import List, Optional

from ..harness.report import BenchmarkReport, finish
from .figures import figures
from .trial import run


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the tests; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--cars", type=int, default=200, help="number of Cars")
    parser.add_argument("--seed", type=int, default=1, help="seed of everything random")
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    given = parser.parse_args(arguments)
    with multiprocessing.Pool(given.jobs) as pool:
        found = figures(pool.map(run, [(given.seed, number) for number in range(given.cars)], chunksize=1))
    return finish(BenchmarkReport(found.rows(), asdict(found)), given.out / "car_clearance.json")


if __name__ == "__main__":
    sys.exit(main())
