"""Runs the robot's tests in any catkin workspace that was built with the checkout in its src, as a robot team has it.

Usage: source WORKSPACE/devel/setup.bash; python3 setup/workspace_tests.py WORKSPACE [unit] [gtest] [rostest] [drive]

Reports and logs go to WORKSPACE/out. What concerns the Operator's application, the firmware and the checkout itself is
run_tests.py's; `drive` is a short drive of the simulated robot on the wall clock.
"""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import sys
import time
from typing import Callable, Dict, List

from pure_tests import all_modules_of, settings_for_old_pytest
from run_tests import TOP, Counts, counts_of, in_packages

# The Operator's application and the emulated board, with which some benchmarks measure; no package of ROS's kind.
NOT_THE_ROBOTS = {"mtr_operator", "mtr_results", "mtr_emulator"}

# Longer than any *.test file's own limit: none of them waits for ever, but what starts them might.
ROSTEST_LIMIT_S = 900
# A tail of what failed.
SHOWN = 20000


def main(arguments: List[str]) -> int:
    """Run the suites; the exit status says whether everything passed."""
    workspace, wanted = pathlib.Path(arguments[0]).resolve(), arguments[1:] or list(SUITES)
    status = 0
    for name in wanted:
        (workspace / "out" / name).mkdir(parents=True, exist_ok=True)
        started = time.monotonic()
        good, bad = SUITES[name](workspace)
        print(f"--- {name}: {good} good, {bad} bad, {time.monotonic() - started:.0f} s", flush=True)
        status = status or int(bad > 0 or good == 0)
    return status


def unit(workspace: pathlib.Path) -> Counts:
    """The packages' Python tests without a ROS master, by what the packages declare: pytest and no plugin."""
    report = workspace / "out" / "unit" / "pytest.xml"
    files = [path for path in in_packages("tests/unit/**/test_*.py") if not all_modules_of(path) & NOT_THE_ROBOTS]
    command = [sys.executable, "-m", "pytest", "-q", f"--junitxml={report}", f"--rootdir={TOP}",
               *settings_for_old_pytest(), *map(str, files)]
    return counts_of([report], subprocess.run(command, cwd=TOP, check=False).returncode)


def gtest(workspace: pathlib.Path) -> Counts:
    """The packages' C++ tests: build them, run each binary."""
    built = subprocess.run(["make", "-C", str(workspace / "build"), "tests"], text=True, capture_output=True,
                           check=False)
    if built.returncode:
        print((built.stdout + built.stderr)[-SHOWN:])
        return 0, 1
    reports, status = [], 0
    for binary in sorted((workspace / "devel" / "lib").glob("mtr_*/*_test")):
        report = workspace / "out" / "gtest" / f"{binary.name}.xml"
        done = subprocess.run([str(binary), f"--gtest_output=xml:{report}"], text=True, capture_output=True,
                              check=False)
        print(done.stdout[-SHOWN:] if done.returncode else f"{binary.name} passed")
        status = status or done.returncode
        reports.append(report)
    return counts_of(reports, status)


def rostest(workspace: pathlib.Path) -> Counts:
    """Every *.test file, with a master of its own."""
    results = workspace / "out" / "rostest"
    environment = dict(os.environ, ROS_TEST_RESULTS_DIR=str(results))
    status = 0
    for path in [*in_packages("tests/rostest/*.test"), *in_packages("rostest/*.test")]:
        done = subprocess.run(["rostest", str(path)], env=environment, cwd=workspace, text=True, capture_output=True,
                              timeout=ROSTEST_LIMIT_S, check=False)
        print(f"{path.name}: {'failed' if done.returncode else 'passed'}", flush=True)
        if done.returncode:
            print(done.stdout[-SHOWN:] + done.stderr[-SHOWN:])
        status = status or done.returncode
    return counts_of(sorted(results.rglob("rosunit-*.xml")), status)


def drive(workspace: pathlib.Path) -> Counts:
    """Robot and simulation on the wall clock: see mtr_benchmarks.liveness.short_drive."""
    command = [sys.executable, "-m", "mtr_benchmarks.liveness.short_drive", "--out", str(workspace / "out" / "drive")]
    done = subprocess.run(command, cwd=workspace, check=False)
    return int(done.returncode == 0), int(done.returncode != 0)


SUITES: Dict[str, Callable[[pathlib.Path], Counts]] = {"unit": unit, "gtest": gtest, "rostest": rostest, "drive": drive}

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
