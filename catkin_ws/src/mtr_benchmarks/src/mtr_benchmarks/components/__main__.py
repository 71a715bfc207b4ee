"""Runs the benchmarks; each leaves its figures in a JSON file.

Usage: python -m mtr_benchmarks.components --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import json
import pathlib
import sys
from typing import List, Optional

from . import serial, simulation

# Each has figures() and sentence(figures); the file is named after the module.
BENCHMARKS = {"simulation": simulation, "serial": serial}


def main(arguments: Optional[List[str]] = None) -> int:
    """Run all benchmarks; always 0, the figures are for a person to judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    for name, benchmark in BENCHMARKS.items():
        figures = benchmark.figures()
        (options.out / f"{name}.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
        print(benchmark.sentence(figures))
    return 0


if __name__ == "__main__":
    sys.exit(main())
