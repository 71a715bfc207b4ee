"""Runs the benchmark of localization and Car locator; figures go to localization.json.

Usage: python -m mtr_benchmarks.localization --mrpt out/bench/mrpt/mrpt_icp_slam --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import concurrent.futures
import pathlib
import sys
import tempfile
import time
from typing import List, Optional

from ..harness.report import finish
from .drives.selection import all_drives
from .one_drive import DriveResult, DriveTask, run_drive
from .real_time import measure_real_time
from .report import report


def main(arguments: Optional[List[str]] = None) -> int:
    """Run all drives; the exit status says whether every row of the table is met."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--mrpt", type=pathlib.Path, required=True, help="program that mrpt_icp_slam/ builds")
    parser.add_argument("--jobs", type=int, default=2, help="drives at the same time")
    parser.add_argument("--quick", action="store_true", help="two seeds of each kind, for development")
    parser.add_argument("--only", default="", help="only drives whose name begins so, for development")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the recordings in this folder")
    options = parser.parse_args(arguments)
    if not options.mrpt.is_file():
        parser.error(f"There is no program {options.mrpt}; `make bench-localization` builds it.")
    options.out.mkdir(parents=True, exist_ok=True)
    drives = [drive for drive in all_drives(options.quick) if drive.name.startswith(options.only)]
    with tempfile.TemporaryDirectory(prefix="mtr_bench_") as folder:
        tasks = [DriveTask(drive, options.keep or pathlib.Path(folder), options.mrpt.resolve(), bool(options.keep))
                 for drive in drives]
        results = run_all(tasks, options.jobs)
    # Alone on the machine, for it measures time.
    real_time = None if options.only else measure_real_time()
    return finish(report(results, real_time), options.out / "localization.json")


def run_all(tasks: List[DriveTask], jobs: int) -> List[DriveResult]:
    """Results in the order of the tasks, which does not depend on who is first."""
    begun = time.monotonic()
    with concurrent.futures.ProcessPoolExecutor(max_workers=jobs) as pool:
        results = []
        for done in pool.map(run_drive, tasks):
            results.append(done)
            print(progress(done, len(results), len(tasks), time.monotonic() - begun), flush=True)
        return results


def progress(result: DriveResult, done: int, total: int, elapsed_s: float) -> str:
    """One line for a person who waits."""
    failed = "; ".join(f"{method}: {sentence}" for method, sentence in result.failures.items())
    return f"[{elapsed_s:5.0f} s] {done}/{total} {result.drive.name} {failed}".rstrip()


if __name__ == "__main__":
    sys.exit(main())
