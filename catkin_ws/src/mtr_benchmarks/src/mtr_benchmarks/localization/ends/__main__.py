"""Runs the benchmark of the Car's ends; figures go to car_ends.json.

Usage: python -m mtr_benchmarks.localization.ends --bodies 500 --seed 1 --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import concurrent.futures
import pathlib
import sys
from typing import List, Optional

from ...harness.report import finish
from .coverage import ends_of_seed, report

BODIES = 500


def main(arguments: Optional[List[str]] = None) -> int:
    """Fit all Cars; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--seed", type=int, default=1, help="of the first Car; those of development are 90001 to 91500")
    parser.add_argument("--bodies", type=int, default=BODIES, help="how many Cars")
    parser.add_argument("--jobs", type=int, default=2, help="Cars at the same time")
    options = parser.parse_args(arguments)
    if options.bodies < 1:
        parser.error(f"--bodies is {options.bodies}; at least 1 Car is drawn.")
    with concurrent.futures.ProcessPoolExecutor(max_workers=options.jobs) as pool:
        found = list(pool.map(ends_of_seed, range(options.seed, options.seed + options.bodies), chunksize=5))
    return finish(report(found), options.out / "car_ends.json")


if __name__ == "__main__":
    sys.exit(main())
