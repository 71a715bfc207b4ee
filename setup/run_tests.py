"""Runs the test suites and prints one line with the sum of their results.

Usage: run_tests.py all | [lint] [unit] [window] [gtest] [firmware] [rostest] [system]

Suites that are named run one after the other; all of them run in three lanes, because most of them use one core and
wait for some of their time.
"""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Callable, Dict, List, Sequence, Tuple
from xml.etree import ElementTree

TOP = pathlib.Path(__file__).resolve().parent.parent
RESULTS = TOP / "out" / "test"
# Folders of the catkin packages; those that a person looks for at the top lie there.
PACKAGES = sorted(path.parent for where in ("*", "catkin_ws/src/*") for path in TOP.glob(f"{where}/package.xml"))
Counts = Tuple[int, int]
# Limits of one test. They end tests that hang: a test of seconds lasts minutes on a machine with a load of 24.
UNIT_LIMIT_S, SYSTEM_LIMIT_S = 300, 600


def main(wanted: List[str]) -> int:
    """Run the wanted suites; the exit status says whether everything passed."""
    names = list(SUITES) if wanted in ([], ["all"]) else wanted
    unknown = [name for name in names if name not in SUITES]
    if unknown:
        print(f"Unknown suite {unknown[0]}; there are: {', '.join(SUITES)}.", file=sys.stderr)
        return 2
    # A runner in the background may have been started with Ctrl-C ignored, and its children would inherit that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if wanted in ([], ["all"]):
        # More than one lane needs it, and two makes at once would write the same files.
        firmware_is_built()
        with ThreadPoolExecutor(len(LANES)) as pool:
            sums = list(pool.map(lane, LANES))
    else:
        sums = [run(name) for name in names]
    passed, failed = (sum(column) for column in zip(*sums))
    # Once more at the end: of a long output often only the end is kept.
    for line in failures(names):
        print(line)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


def run(name: str) -> Counts:
    """Run one suite in this process."""
    shutil.rmtree(RESULTS / name, ignore_errors=True)
    (RESULTS / name).mkdir(parents=True)
    started_s, used_s = time.monotonic(), processor_s()
    good, bad = SUITES[name]()
    took_s, used_s = time.monotonic() - started_s, processor_s() - used_s
    print(f"--- {name}: {good} good, {bad} bad, {took_s:.0f} s, {used_s:.0f} s of a core", flush=True)
    return good, bad


def processor_s() -> float:
    """Processor time of all that was run and has ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def lane(names: Sequence[str]) -> Counts:
    """Run suites one after the other, each in a process of its own whose output appears in one piece at its end."""
    passed = failed = 0
    for name in names:
        done = subprocess.run([sys.executable, __file__, name], cwd=TOP, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False)
        output, _, total = done.stdout.rstrip().rpartition("\n")
        print(output, flush=True)
        counts = re.fullmatch(r"(\d+) passed, (\d+) failed", total)
        if counts is None:
            print(f"{total}\n--- {name}: ended with status {done.returncode}", flush=True)
        passed, failed = passed + int(counts[1] if counts else 0), failed + int(counts[2] if counts else 1)
    return passed, failed


def lint() -> Counts:
    """Style, types and the robot's Python version; of the C++ formatting, and defects where it was changed."""
    python = [str(path) for path in tracked("*.py") + node_scripts()]
    robot = [path for path in python if "/operator_gui/" not in path and "/setup/" not in path]
    cpp = [str(path) for path in tracked("*.cpp") + tracked("*.hpp")]
    checks = {
        "ruff": ["ruff", "check", "--quiet", *python],
        "python-3.8": ["vermin", "--quiet", "-t=3.8-", "--no-tips", "--violations", *robot],
        "clang-format": ["clang-format", "--dry-run", "-Werror", *cpp],
        "clang-tidy": [sys.executable, "setup/tidy.py", "--changed"],
        "mypy": [sys.executable, "-m", "mypy"],
        "mypy-operator": [sys.executable, "-m", "mypy", "--config-file", "operator_gui/mypy.ini"],
        "commit-messages": [sys.executable, "setup/commit_message.py", "--branch"],
        "catkin-lint": ["/usr/bin/catkin_lint", "--quiet", "-W1", *map(str, PACKAGES)],
    }
    results = [check(name, command) for name, command in checks.items()]
    return results.count(True), results.count(False)


def check(name: str, command: List[str]) -> bool:
    """Run one lint command; print what it found."""
    done = subprocess.run(command, cwd=TOP, text=True, capture_output=True, check=False)
    good = done.returncode == 0
    if not good:
        print(f"{name}:\n{done.stdout}{done.stderr}")
    return good


def tracked(pattern: str) -> List[pathlib.Path]:
    """Files of the project by name pattern, generated ones excluded."""
    roots = ["catkin_ws/src", "proto", "launch", "tests", "operator_gui", "setup", "firmware"]
    found = {path for root in roots for path in (TOP / root).rglob(pattern)}
    return sorted(path for path in found if not path.name.endswith("_pb2.py") and "/build/" not in str(path))


def node_scripts() -> List[pathlib.Path]:
    """Executable Python files without suffix."""
    return [path for path in in_packages("scripts/*") if path.is_file() and not path.suffix]


def in_packages(pattern: str) -> List[pathlib.Path]:
    """Paths that match the pattern in any package's folder."""
    return sorted(path for package in PACKAGES for path in package.glob(pattern))


def unit() -> Counts:
    """Tests without a ROS master or a window."""
    folders = [*in_packages("tests/unit"), TOP / "operator_gui" / "tests" / "unit", TOP / "tests" / "architecture",
               TOP / "tests" / "contract", TOP / "tests" / "fuzz"]
    paths = sorted(str(folder) for folder in folders if any(folder.rglob("test_*.py")))
    return pytest("unit", paths, UNIT_LIMIT_S)


def window() -> Counts:
    """Tests of the application's window and of the programs that the Operator starts."""
    tests = TOP / "operator_gui" / "tests"
    return pytest("window", [str(tests / "end_to_end"), str(tests / "gui")], UNIT_LIMIT_S)


def system() -> Counts:
    """Tests of the whole stack."""
    if not firmware_is_built():
        return 0, 1
    return pytest("system", [str(TOP / "tests" / "system"), str(TOP / "tests" / "security")], SYSTEM_LIMIT_S)


def pytest(name: str, paths: List[str], timeout_s: int) -> Counts:
    """Run pytest on the paths; each test may take timeout_s."""
    report = RESULTS / name / "pytest.xml"
    command = [sys.executable, "-m", "pytest", "-q", f"--timeout={timeout_s}", f"--junitxml={report}",
               f"--rootdir={TOP}", *paths]
    # pytest-qt takes the newest Qt that it finds, the application is for Qt 5.
    # Threads of the numerical library that wait for a core of a busy machine slow small matrices down, up to 30 times.
    environment = dict(os.environ, PYTEST_QT_API="pyqt5", QT_QPA_PLATFORM="offscreen", OMP_NUM_THREADS="1",
                       OPENBLAS_NUM_THREADS="1")
    status = subprocess.run(command, cwd=TOP, env=environment, check=False).returncode
    return counts_of([report], status)


def gtest() -> Counts:
    """C++ unit tests: build the test targets, run each binary."""
    # By make in each package, for `catkin build` would write the workspace anew while other suites use it.
    environment = dict(os.environ, PATH="/usr/bin:" + os.environ["PATH"])
    for package in sorted((TOP / "catkin_ws" / "build").glob("mtr_*/Makefile")):
        built = subprocess.run(["make", "-j2", "-C", str(package.parent), "tests"], env=environment, text=True,
                               capture_output=True, check=False)
        if built.returncode:
            print(built.stdout + built.stderr)
            return 0, 1
    reports, status = [], 0
    for binary in sorted((TOP / "catkin_ws" / "devel" / ".private").glob("*/lib/*/*_test")):
        report = RESULTS / "gtest" / f"{binary.name}.xml"
        done = subprocess.run([str(binary), f"--gtest_output=xml:{report}", "--gtest_brief=1"], check=False)
        status = status or done.returncode
        reports.append(report)
    return counts_of(reports, status)


def firmware() -> Counts:
    """Static rules; the logic on the PC with sanitizers; the flashed firmware on emulated boards in lock-step."""
    if not firmware_is_built():
        return 0, 1
    keeps_rules = check("firmware-tidy", ["make", "-s", "-C", str(TOP / "firmware"), "tidy"])
    report = RESULTS / "firmware" / "host.xml"
    binary = TOP / "firmware" / "build" / "firmware_test"
    done = subprocess.run([str(binary), f"--gtest_output=xml:{report}", "--gtest_brief=1"], check=False)
    passed, failed = counts_of([report], done.returncode)
    emulated = pytest("firmware", [str(TOP / "firmware" / "tests" / "emulated")], UNIT_LIMIT_S)
    return passed + emulated[0] + keeps_rules, failed + emulated[1] + (not keeps_rules)


def firmware_is_built() -> bool:
    """Build the firmware, its emulator and its tests on the PC where they are not; False when that fails."""
    command = ["make", "-s", "-j2", "-C", str(TOP / "firmware"), "all", "host_tests"]
    return subprocess.run(command, check=False).returncode == 0


def rostest() -> Counts:
    """Every *.test file, with a master of its own."""
    found = [*in_packages("tests/rostest/*.test"), *in_packages("rostest/*.test")]
    environment = dict(os.environ, ROS_TEST_RESULTS_DIR=str(RESULTS / "rostest"))
    status = 0
    for path in found:
        done = subprocess.run(["rostest", str(path)], env=environment, cwd=TOP, text=True, capture_output=True,
                              check=False)
        if done.returncode:
            print(done.stdout[-20000:] + done.stderr[-5000:])
        status = status or done.returncode
    return counts_of(sorted((RESULTS / "rostest").rglob("rosunit-*.xml")), status)


def counts_of(reports: List[pathlib.Path], status: int) -> Counts:
    """Sum of JUnit reports; an unreadable one, and a failed run whose reports show no failure, count as a failure."""
    passed = failed = 0
    for report in reports:
        try:
            root = ElementTree.parse(report).getroot()
        except (OSError, ElementTree.ParseError):
            failed += 1
            continue
        for suite in [root] if root.tag == "testsuite" else root.findall("testsuite"):
            bad = int(suite.get("failures", 0)) + int(suite.get("errors", 0))
            passed += int(suite.get("tests", 0)) - bad - int(suite.get("skipped", 0) or 0)
            failed += bad
    return passed, failed or (1 if status else 0)


def failures(names: Sequence[str]) -> List[str]:
    """A line for each test that failed, by the reports of the suites."""
    found = []
    # What rostest itself writes is about the test's process; rosunit's report has the tests.
    for report in sorted(path for name in names for path in (RESULTS / name).rglob("*.xml")
                         if not path.name.startswith("rostest-")):
        try:
            root = ElementTree.parse(report).getroot()
        except (OSError, ElementTree.ParseError):
            found.append(f"unreadable: {report.relative_to(RESULTS)}")
            continue
        for case in root.iter("testcase"):
            for reason in case.findall("failure") + case.findall("error"):
                said = (reason.get("message") or reason.text or "").strip().split("\n")[0]
                found.append(f"failed: {case.get('classname')} {case.get('name')}: {said[:200]}")
    return found


SUITES: Dict[str, Callable[[], Counts]] = {
    "lint": lint, "unit": unit, "window": window, "gtest": gtest, "firmware": firmware, "rostest": rostest,
    "system": system,
}
# Lanes of similar length. Three keep two cores busy: tests of nodes and windows wait for up to a third of it.
LANES = (("window",), ("system", "unit"), ("rostest", "lint", "gtest", "firmware"))

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
