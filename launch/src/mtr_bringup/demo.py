"""The whole test on one machine: both scenarios on the simulated robot and Car, compared with the truth."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import time
from typing import Dict, List, Optional

from mtr_simulation.scenario import named_scenario

from .stack import Stack, StackError, StackOptions

SCENARIOS = {"autolock": 16, "key_press": 8}
EXAMPLES = pathlib.Path("operator_gui") / "examples" / "demo"
OUTPUTS = ("results.csv", "protocol.png", "progress.json", "truth.csv")


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the demo; 0 when every line was measured and every file is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="seed of every random number in the simulation")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/demo"), help="result folder")
    parser.add_argument("--firmware", default="", help="firmware for an emulated ATmega2560; else it is simulated")
    options = parser.parse_args(arguments)

    shutil.rmtree(options.out, ignore_errors=True)
    options.out.mkdir(parents=True)
    started = time.monotonic()
    try:
        with Stack(StackOptions(options.out, options.seed, rviz="DISPLAY" in os.environ,
                                arguments={"firmware_elf": options.firmware})) as stack:
            statuses = [run_scenario(stack, name, options.out / name) for name in SCENARIOS]
    except StackError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    if any(statuses):
        print(f"A scenario failed; see {stack.log} and {options.out}.", file=sys.stderr)
        return 1
    return report(options.out, time.monotonic() - started)


def run_scenario(stack: Stack, name: str, out: pathlib.Path) -> int:
    """Run one scenario with the Operator's application, as a person would from the command line."""
    print(f"=== {name}", flush=True)
    return subprocess.run([
        sys.executable, "-m", "mtr_operator", "run", name, "--params", str(EXAMPLES / f"{name}.yaml"),
        "--out", str(out), "--robot", "127.0.0.1", "--subscriber-port", str(stack.status_port),
        "--publisher-port", str(stack.command_port), "--can-interface", "slcan", "--can-channel", str(stack.can_link),
        "--can-bitrate", "500000", "--car-profile", "mtr_demo_car",
    ], check=False).returncode


def report(out: pathlib.Path, wall_s: float) -> int:
    """Compare with the truth, print the figures, and say what is missing."""
    problems = []
    robot_s = 0.0
    for name, least_lines in SCENARIOS.items():
        folder = out / name
        if compare(out / "truth_events.csv", folder):
            problems.append(f"{name}: measured and true events do not match")
        problems += [f"{name}: {file} is missing" for file in OUTPUTS if not (folder / file).exists()]
        rows = read_rows(folder / "results.csv")
        if len(rows) < least_lines:
            problems.append(f"{name}: {len(rows)} lines instead of at least {least_lines}")
        robot_s = max([robot_s, *event_times(rows)])
    print(f"Robot time {robot_s:.0f} s in {wall_s:.0f} s of wall time: {robot_s / wall_s:.1f} x real time, "
          "start-up and pictures included.")
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


def compare(events: pathlib.Path, folder: pathlib.Path) -> int:
    """Write truth.csv beside the results and print measured against true; 0 when every measured line has its event."""
    car = named_scenario("lot").car
    return subprocess.run([
        sys.executable, "-m", "mtr_simulation.truth.compare", "--scenario", folder.name, "--events", str(events),
        "--results", str(folder), "--car-length", str(car.length_m), "--car-width", str(car.width_m),
    ], check=False).returncode


def event_times(rows: List[Dict[str, str]]) -> List[float]:
    """Robot times, in s, of all events in the rows."""
    return [float(value) for row in rows for column, value in row.items() if column.endswith("robot_time_s") and value]


def read_rows(path: pathlib.Path) -> List[Dict[str, str]]:
    """Rows of a results file, metadata lines skipped; none when it is missing."""
    if not path.exists():
        return []
    with path.open(newline="") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


if __name__ == "__main__":
    sys.exit(main())
