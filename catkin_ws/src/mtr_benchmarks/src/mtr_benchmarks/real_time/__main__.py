"""Runs the simulated robot in real time, on an idle and on a busy machine; figures go to real_time.json.

First it measures silences, latencies and restarts of the nodes on the machine's clock; then it runs complete Autolock
tests and compares them with the truth.

Usage: python -m mtr_benchmarks.real_time --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import contextlib
import json
import pathlib
import subprocess
import sys
from dataclasses import asdict
from typing import Any, ContextManager, Dict, Iterator, List, Optional, Tuple

from ..gazebo.run import GAZEBO, MUJOCO
from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Row
from ..liveness.alarms import AlarmWatch
from ..liveness.live_robot import MACHINE_CLOCK, LiveRobot
from .arrivals import by_node
from .judge import Machine, judged, restart_row
from .measurement import Stretch, measure
from .other_work import other_work
from .restarts import NODES, ROUNDS, Restart, restarts
from .whole_tests import TESTS, figures_of_tests, rows_of_tests, whole_tests

DRIVE_S, STOPS = 60.0, 20
SHORT_DRIVE_S, SHORT_STOPS = 5.0, 3
PROBE_LIMIT_S = 20.0


class Probe:
    """Process that records arrivals; see arrivals_probe."""

    def __init__(self) -> None:
        self._process = subprocess.Popen([sys.executable, "-m", f"{__package__}.arrivals_probe"], text=True,
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self._process.stdout is not None
        self._process.stdout.readline()

    def close(self) -> Dict[str, Any]:
        """End the process and return its records."""
        said, _ = self._process.communicate("", timeout=PROBE_LIMIT_S)
        noted: Dict[str, Any] = json.loads(said)
        return noted


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--short", action="store_true", help="a short drive and a few stops of each")
    parser.add_argument("--machines", nargs="*", choices=[each.value for each in Machine],
                        default=[each.value for each in Machine], help="idle, busy or both")
    parser.add_argument("--restarts", nargs="*", default=NODES, choices=NODES, help="nodes to kill")
    parser.add_argument("--tests", type=int, default=None,
                        help=f"whole Autolock tests of each machine, some minutes each; default {TESTS}, short none")
    parser.add_argument("--seed", type=int, default=1, help="of the first test; the next one has the next")
    parser.add_argument("--simulator", choices=[MUJOCO, GAZEBO], default=MUJOCO, help="of the whole tests")
    parser.add_argument("--tests-only", action="store_true", help="neither drives nor restarts")
    options = parser.parse_args(arguments)
    machines = [Machine(name) for name in options.machines]
    rows: List[Row] = []
    figures: Dict[str, Any] = {}
    remarks: List[str] = []
    if not options.tests_only:
        rows, figures, remarks = _nodes(options, machines)
    count = options.tests if options.tests is not None else 0 if options.short else TESTS
    made = whole_tests(options.out / "real_time" / "tests", machines, range(options.seed, options.seed + count),
                       options.simulator)
    figures["tests"] = figures_of_tests(made)
    return finish(BenchmarkReport(rows + rows_of_tests(made), figures, remarks), options.out / "real_time.json")


def _nodes(options: argparse.Namespace, machines: List[Machine]) -> Tuple[List[Row], Dict[str, Any], List[str]]:
    folder = options.out / "real_time"
    drive_s, stops = (SHORT_DRIVE_S, SHORT_STOPS) if options.short else (DRIVE_S, STOPS)
    with LiveRobot(folder, clock={**MACHINE_CLOCK, "respawn": "true"}) as robot:
        robot.start()
        found, noted = _measured(robot, folder, drive_s, stops, machines)
        killed = restarts(robot, 1 if options.short else ROUNDS, options.restarts)
    rows, figures = judged(found, by_node(noted["callers"]), noted["tf_age_s"])
    rows += [restart_row(killed)] if killed else []
    remarks = [f"{machine.value}: {alarm}" for machine, stretch in found.items() for alarm in stretch.alarms]
    remarks += [_restart_line(each) for each in killed]
    figures["restarts"] = [each._asdict() for each in killed]
    figures["stretches"] = {machine.value: asdict(stretch) for machine, stretch in found.items()}
    return rows, figures, remarks


def _restart_line(found: Restart) -> str:
    stood = "drove on" if found.stood_s is None else f"stood after {found.stood_s:.2f} s"
    again = f"drove again after {found.recovered_s:.1f} s" if found.recovered_s is not None else found.why
    return f"{found.node} killed at {found.speed_mps:.2f} m/s: {stood}; {again}" + (
        ", with the Car mapped again" if found.mapped_again else "")


def _measured(robot: LiveRobot, folder: pathlib.Path, drive_s: float, stops: int,
              machines: List[Machine]) -> Tuple[Dict[Machine, Stretch], Dict[str, Any]]:
    found = {}
    probe, watch = Probe(), AlarmWatch()
    for machine in machines:
        with _machine(machine, folder):
            found[machine] = measure(robot, watch, drive_s, stops)
    return found, probe.close()


def _machine(machine: Machine, folder: pathlib.Path) -> ContextManager[None]:
    return other_work(folder) if machine is Machine.BUSY else _nothing_else()


@contextlib.contextmanager
def _nothing_else() -> Iterator[None]:
    yield


if __name__ == "__main__":
    sys.exit(main())
