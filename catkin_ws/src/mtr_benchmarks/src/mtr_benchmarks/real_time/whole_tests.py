"""Complete Autolock tests on the wall clock, each on a newly started robot; counts the completed ones."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
import time
from typing import Any, Callable, ContextManager, Dict, List, NamedTuple, Sequence

import yaml

from ..gazebo.judge import MAX_ERROR_M, figures_of, good
from ..gazebo.run import MUJOCO, Run, RunOptions, run
from ..harness.rows import Requirement, Row
from .judge import Machine
from .other_work import other_work

SCENARIO = "autolock"
# Number of tests on each machine; each test drives eight axes once.
TESTS = 10
PARAMETERS: Dict[str, Any] = {
    "minimum_distance_m": 0.5, "maximum_distance_m": 4.0, "straightening_distance_m": 0.5,
    "measurements_distance_m": 10.0, "key_height_m": 1.0, "maximum_speed_mps": 1.0, "passes": 1,
    "measuring_speeds_mps": [0.4]}
# Distances of such a test: unlocking and locking on each axis.
DISTANCES = 16


class WholeTest(NamedTuple):
    """One test.

    Attributes:
        took_s: wall time, including start and end of the robot.
        load: the system's load average over the last five minutes, including the test itself.
    """

    machine: Machine
    seed: int
    took_s: float
    made: Run
    load: float = 0.0

    @property
    def is_whole(self) -> bool:
        """True if the application ended well, and every distance exists and is ok."""
        lines = self.made.lines[SCENARIO]
        return self.made.statuses[SCENARIO] == 0 and len(lines) == DISTANCES == len(good(lines))

    @property
    def errors_m(self) -> List[float]:
        """Errors of the distances that have a true event."""
        return [abs(each.error_m) for each in good(self.made.lines[SCENARIO])]


def whole_tests(folder: pathlib.Path, machines: Sequence[Machine], seeds: Sequence[int], simulator: str = MUJOCO, *,
                run_one: Callable[[str, RunOptions], Run] = run) -> List[WholeTest]:
    """Run a test for each seed on each machine; delete the results of earlier runs with the same seed."""
    folder.mkdir(parents=True, exist_ok=True)
    parameters = folder / f"{SCENARIO}.yaml"
    parameters.write_text(yaml.safe_dump(PARAMETERS), encoding="utf-8")
    found = []
    for machine in machines:
        with _work_beside(machine, folder):
            for seed in seeds:
                started_s = time.monotonic()
                options = RunOptions(folder / f"{machine.value}_{seed}", seed, scenarios=(SCENARIO,), parameters=folder)
                made = run_one(simulator, options)
                found.append(WholeTest(machine, seed, time.monotonic() - started_s, made, os.getloadavg()[1]))
                print(line_of(found[-1]), flush=True)
    return found


def rows_of_tests(made: Sequence[WholeTest]) -> List[Row]:
    """Return the rows of the tests on each machine."""
    return [row for machine in Machine for row in _rows_of(machine, [each for each in made if each.machine is machine])]


def _rows_of(machine: Machine, made: Sequence[WholeTest]) -> List[Row]:
    if not made:
        return []
    errors_m = [error_m for each in made for error_m in each.errors_m]
    aborted = [str(each.seed) for each in made if not each.is_whole]
    touched = sum(len(each.made.touched) for each in made)
    return [
        Row(Requirement(f"Autolock tests that did not end whole, {machine.value}", "(count)", must=0.0),
            float(len(aborted)), bool(made), {"of": float(len(made))},
            f"of {len(made)}" + (f": seeds {', '.join(aborted)}" if aborted else "")),
        Row(Requirement(f"largest error of their distances, {machine.value}", "m", must=MAX_ERROR_M),
            max(errors_m, default=None), remark=f"{len(errors_m)} distances"),
        Row(Requirement(f"things they touched, {machine.value}", "(count)", must=0.0), float(touched))]


def line_of(test: WholeTest) -> str:
    """Return a line about one test for a person."""
    status, lines = test.made.statuses[SCENARIO], test.made.lines[SCENARIO]
    said = "whole" if test.is_whole else f"NOT whole (exit status {status})"
    factor = test.made.notes.real_time_factor
    pace = f"{factor:.2f}" if factor is not None else "no"
    return (f"{test.machine.value} {test.seed}: {said}, {len(good(lines))} of {len(lines)} distances, at most "
            f"{max(test.errors_m, default=float('nan')):.3f} m wrong, {test.made.notes.blockages} stops for "
            f"something in the way, {pace} x real time, {test.took_s:.0f} s, load {test.load:.0f}")


def figures_of_tests(made: Sequence[WholeTest]) -> List[Dict[str, Any]]:
    """Return all figures of each test."""
    return [{"machine": each.machine.value, "seed": each.seed, "took_s": each.took_s, "load": each.load,
             **figures_of(each.made)} for each in made]


def _work_beside(machine: Machine, folder: pathlib.Path) -> ContextManager[None]:
    return other_work(folder) if machine is Machine.BUSY else contextlib.nullcontext()
