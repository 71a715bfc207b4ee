"""Measures the estimators of all scenarios on simulated Cars and phones; figures go to range.json.

Usage: python -m mtr_benchmarks.ranges --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import List, Optional

from ..harness.report import finish
from .campaigns import Amount, measure
from .phones import measure_phones
from .table import report


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of range.json")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--radials", type=int, default=1000, help="of each width, with and without fading")
    parser.add_argument("--axes", type=int, default=1000, help="of each polling")
    parser.add_argument("--places", type=int, default=2000, help="of each kind of phone")
    parser.add_argument("--limit-lines", type=int, default=48,
                        help="of each kind of whole tests at the limit; some 10 s of processor time each")
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    options = parser.parse_args(arguments)
    found = measure(Amount(options.radials, options.axes, options.seed, options.jobs, options.limit_lines))
    phones = measure_phones(options.places, options.seed)
    return finish(report(found, phones), options.out / "range.json")


if __name__ == "__main__":
    sys.exit(main())
