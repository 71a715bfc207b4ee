"""Runs the benchmark of the Operator's window; figures go to gui.json.

Usage: python -m mtr_benchmarks.gui --out out/bench [--short | --hours 8]; it requires a display, e.g. of xvfb-run.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import subprocess
import sys
import tempfile
import time
from typing import List, Optional, Sequence

import numpy as np

from mtr_operator.gui.app import make_qt

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .day import DayFigures, use_for_hours
from .window import Times, WindowFigures, use_window

# The limit of the start is valid for an otherwise idle machine.
STOP = Requirement("click on Stop to the Command out of the socket, 99 %", "ms", must=50.0)
PICTURE = Requirement("Status to the picture that shows it, 95 %", "ms", must=50.0)
FRAMES = Requirement("pictures a second while measuring, with LiDARs", "(count)", must=30.0, at_least=True)
MEASURING_CPU = Requirement("processor while measuring, of one core", "(share)", must=0.15)
REST_CPU = Requirement("processor at rest, of one core", "(share)", must=0.05)
MEMORY = Requirement("memory", "MiB")
GROWTH = Requirement("growth of the memory while measuring", "MiB", must=8.0)
DAY = Requirement("growth of the memory over a day of tests, robot time", "MiB", must=16.0)
# At this slope, the growth that remains statistically possible over a day stays within its own limit.
SLOPE = Requirement("slope of the memory over a day of tests, upper end of its 95 % interval", "MiB/h", must=2.0)
START = Requirement("start to the first window, median", "s", goal=2.0)
STARTS = 3
SHORT = Times(5.0, 15.0, 30)
DAY_HOURS, SHORT_HOURS = 8.0, 0.5
MS_PER_S = 1000.0


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--short", action="store_true", help="a quarter of the time")
    parser.add_argument("--hours", type=float, help="of robot time over which the memory is looked at")
    options = parser.parse_args(arguments)
    times = SHORT if options.short else Times()
    hours = options.hours or (SHORT_HOURS if options.short else DAY_HOURS)
    starts_s = [measured_start() for _ in range(STARTS)]
    robot = subprocess.Popen([sys.executable, "-m", "mtr_benchmarks.gui.robot"], stdout=subprocess.PIPE, text=True)
    application = make_qt()
    try:
        line = robot.stdout.readline() if robot.stdout else ""
        with tempfile.TemporaryDirectory() as folder:
            found = use_window(pathlib.Path(folder), [int(port) for port in line.split()], times)
        with tempfile.TemporaryDirectory() as folder:
            day = use_for_hours(pathlib.Path(folder), hours)
    finally:
        robot.kill()
        robot.wait()
        application.quit()
    return finish(report(found, starts_s, times, day), options.out / "gui.json")


def measured_start() -> float:
    """Return the time from the start of a process to its painted window, s."""
    begun_s = time.monotonic()
    with subprocess.Popen([sys.executable, "-m", "mtr_benchmarks.gui.start"], stdout=subprocess.PIPE) as process:
        if process.stdout is None or not process.stdout.readline():
            return float("inf")
        return time.monotonic() - begun_s


def report(found: WindowFigures, starts_s: Sequence[float], times: Times, day: DayFigures) -> BenchmarkReport:
    """Return the rows of the table."""
    slope, low, high = day.slope_mib_per_h
    looks = {f"look_{number}_mib": value for number, value in enumerate(day.memory_mib, 1)}
    rows = [Row(STOP, percentile_ms(found.stop_s, 99.0), details={"clicks": float(len(found.stop_s))}),
            Row(PICTURE, percentile_ms(found.picture_s, 95.0), details={"pictures": float(len(found.picture_s))}),
            Row(FRAMES, found.frames_per_s), Row(MEASURING_CPU, found.measuring_cores), Row(REST_CPU, found.rest_cores),
            Row(MEMORY, found.memory_mib),
            Row(GROWTH, found.memory_growth_mib, details={"measured_s": times.measuring_s}),
            Row(DAY, day.growth_mib, details={"hours": day.hours, "tests": float(day.tests),
                                              "events": float(day.events), **looks}),
            Row(SLOPE, high, details={"slope": slope, "low": low}),
            Row(START, float(np.median(starts_s)))]
    return BenchmarkReport(rows, {"starts_s": list(starts_s), "stop_median_ms": percentile_ms(found.stop_s, 50.0),
                                  "picture_median_ms": percentile_ms(found.picture_s, 50.0)},
                           ["Other work on the machine lengthens all times."])


def percentile_ms(times_s: Sequence[float], percent: float) -> Optional[float]:
    """Return a percentile in ms; None without times."""
    return float(np.percentile(times_s, percent)) * MS_PER_S if len(times_s) else None


if __name__ == "__main__":
    sys.exit(main())
