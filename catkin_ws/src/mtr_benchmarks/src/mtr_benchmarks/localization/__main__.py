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
from .drives.selection import (
    ABDUCT,
    ABDUCTIONS,
    ANY_CAR,
    ANY_CARS,
    PLAIN,
    QUICK_ABDUCTIONS,
    QUICK_ANY_CARS,
    BenchmarkDrive,
    abductions,
    all_drives,
    any_cars,
)
from .one_abduction import run_abduction
from .one_any_car import run_any_car
from .one_drive import DriveResult, DriveTask, run_drive
from .real_time import measure_real_time
from .report import abduction_report, any_car_report, report

# Programs of variants that need their own; all other drives are evaluated with all methods.
PROGRAMS = {ABDUCT: run_abduction, ANY_CAR: run_any_car}


def main(arguments: Optional[List[str]] = None) -> int:
    """Run all drives; return 0 if every row of the table is met."""
    parser = command_line()
    options = parser.parse_args(arguments)
    if options.kidnappings is not None and options.kidnappings < 1:
        parser.error(f"--kidnappings is {options.kidnappings}; at least 1 robot is carried away.")
    if options.any_cars is not None and options.any_cars < 1:
        parser.error(f"--any-cars is {options.any_cars}; at least 1 Car is drawn.")
    drives = selected(options)
    if any(drive.variant == PLAIN for drive in drives) and not options.mrpt.is_file():
        parser.error(f"There is no program {options.mrpt}; `make bench-localization` builds it.")
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="mtr_bench_") as folder:
        tasks = [DriveTask(drive, options.keep or pathlib.Path(folder), options.mrpt.resolve(), bool(options.keep))
                 for drive in drives]
        results = run_all(tasks, options.jobs)
    if options.kidnappings_only:
        return finish(abduction_report(results), options.out / "abductions.json")
    if options.any_cars_only:
        return finish(any_car_report(results), options.out / "any_car.json")
    # Processor time is measured alone on the machine.
    real_time = None if options.only else measure_real_time()
    return finish(report(results, real_time), options.out / "localization.json")


def command_line() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--mrpt", type=pathlib.Path, default=pathlib.Path("out/bench/mrpt/mrpt_icp_slam"),
                        help="program that mrpt_icp_slam/ builds; plain drives need it")
    parser.add_argument("--jobs", type=int, default=2, help="drives at the same time")
    parser.add_argument("--quick", action="store_true", help="two seeds of each kind, for development")
    parser.add_argument("--only", default="", help="only drives whose name begins so, for development")
    parser.add_argument("--kidnappings", type=int, metavar="N", help="robots in each scene that are carried away while "
                        f"they drive; default {ABDUCTIONS}, with --quick {QUICK_ABDUCTIONS}")
    parser.add_argument("--kidnap-seed", type=int, default=1, help="seed of the first of them; default 1")
    parser.add_argument("--any-cars", type=int, metavar="N", help="Cars that are drawn by chance; default "
                        f"{ANY_CARS}, with --quick {QUICK_ANY_CARS}")
    parser.add_argument("--any-car-seed", type=int, default=1, help="seed of the first of them; default 1")
    only = parser.add_mutually_exclusive_group()
    only.add_argument("--kidnappings-only", action="store_true", help="only these; figures go to abductions.json")
    only.add_argument("--any-cars-only", action="store_true", help="only these; figures go to any_car.json")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the recordings in this folder; of robots that are "
                        "carried away while they drive, and of Cars drawn by chance, only those that were wrong")
    return parser


def selected(options: argparse.Namespace) -> List[BenchmarkDrive]:
    """Return the drives that the command line selects."""
    robots = options.kidnappings or (QUICK_ABDUCTIONS if options.quick else ABDUCTIONS)
    cars = options.any_cars or (QUICK_ANY_CARS if options.quick else ANY_CARS)
    drives = [] if options.kidnappings_only or options.any_cars_only else all_drives(options.quick)
    drives += [] if options.any_cars_only else abductions(robots, options.kidnap_seed)
    drives += [] if options.kidnappings_only else any_cars(cars, options.any_car_seed)
    return [drive for drive in drives if drive.name.startswith(options.only)]


def run_one(task: DriveTask) -> DriveResult:
    """Run the program of the drive's variant."""
    return PROGRAMS.get(task.drive.variant, run_drive)(task)


def run_all(tasks: List[DriveTask], jobs: int) -> List[DriveResult]:
    """Return the results in the order of the tasks."""
    begun = time.monotonic()
    with concurrent.futures.ProcessPoolExecutor(max_workers=jobs) as pool:
        results = []
        for done in pool.map(run_one, tasks):
            results.append(done)
            print(progress(done, len(results), len(tasks), time.monotonic() - begun), flush=True)
        return results


def progress(result: DriveResult, done: int, total: int, elapsed_s: float) -> str:
    """Return a line of progress for a waiting person."""
    failed = "; ".join(f"{method}: {sentence}" for method, sentence in result.failures.items())
    return f"[{elapsed_s:5.0f} s] {done}/{total} {result.drive.name} {failed}".rstrip()


if __name__ == "__main__":
    sys.exit(main())
