"""Runs the benchmark of the simulation's speed; figures go to simulation.json.

Usage: python -m mtr_benchmarks.simulation --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from dataclasses import asdict
from typing import List, Optional

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .physics import PhysicsFigures, measure_physics
from .whole_stack import WholeStackFigures, measure_whole_stack

PHYSICS = Requirement("physics and both LiDARs, x real time", "(x)")
TICK_MEDIAN = Requirement("a tick of 20 ms: processor time, median", "ms")
TICK_P99 = Requirement("a tick of 20 ms: processor time, 99 %", "ms")
# Limit for an otherwise idle machine with two cores, including start-up and pictures.
WHOLE_STACK = Requirement("whole stack, x real time", "(x)", must=7.0, at_least=True)


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    options = parser.parse_args(arguments)
    found = report(measure_physics(), measure_whole_stack(options.out / "demo"))
    return finish(found, options.out / "simulation.json")


def report(physics: PhysicsFigures, stack: WholeStackFigures) -> BenchmarkReport:
    """Return figures and rows of both parts."""
    rows = [Row(PHYSICS, physics.real_time_factor), Row(TICK_MEDIAN, physics.tick_median_ms),
            Row(TICK_P99, physics.tick_p99_ms), Row(WHOLE_STACK, stack.real_time_factor, not stack.problems)]
    return BenchmarkReport(rows, {**asdict(physics), "whole_stack": asdict(stack)}, list(stack.problems))


if __name__ == "__main__":
    sys.exit(main())
