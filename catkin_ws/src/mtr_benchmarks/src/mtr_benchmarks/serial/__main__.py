"""Runs the benchmark of the serial line; figures go to serial.json. Needs what `make firmware` builds.

Usage: python -m mtr_benchmarks.serial --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from dataclasses import asdict
from typing import List, Optional

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .echo import EchoFigures, measure_echo

# Requirement at 57600 baud; the goal is the figure of firmware/README.md.
MEDIAN = Requirement("command to echo, median", "ms", goal=5.5, must=6.0)
P95 = Requirement("command to echo, 95 %", "ms")
MAXIMUM = Requirement("command to echo, maximum", "ms")
# No interference acts on this line.
LOST = Requirement("commands without an echo", "(count)", must=0.0)


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    options = parser.parse_args(arguments)
    return finish(report(measure_echo()), options.out / "serial.json")


def report(echo: EchoFigures) -> BenchmarkReport:
    """Return figures and rows."""
    rows = [Row(MEDIAN, echo.echo_p50_ms), Row(P95, echo.echo_p95_ms), Row(MAXIMUM, echo.echo_max_ms),
            Row(LOST, echo.commands - echo.echoes)]
    return BenchmarkReport(rows, asdict(echo))


if __name__ == "__main__":
    sys.exit(main())
