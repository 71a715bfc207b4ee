"""Runs one simulator: the robot's nodes on the wall clock, and both scenarios with the Operator's application."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import json
import pathlib
import shutil
import subprocess
import sys
from dataclasses import dataclass
from typing import Dict, Iterator, List, Optional, Tuple

from mtr_simulation.demo import DemoOptions, run_scenario
from mtr_simulation.site.scenario_file import chosen_scenario
from mtr_simulation.stack import Stack, StackOptions, free_port
from mtr_simulation.truth.distance import CarSize, Comparison
from mtr_simulation.truth.distance import compare as compared
from mtr_simulation.truth.results import ResultsError, read_autolock, read_events, read_key_press

from .noted import Notes

GAZEBO, MUJOCO = "gazebo", "mujoco"
READERS = {"autolock": read_autolock, "key_press": read_key_press}
PROBE_LIMIT_S = 60.0


@dataclass(frozen=True)
class RunOptions:
    """Options of a run.

    Attributes:
        folder: folder of this simulator's results.
        site: name or YAML file of a scenario of mtr_simulation, the same for both simulators.
        car: name or YAML file of the Car's radio and electronics.
        scenarios: scenarios to run, in order.
        parameters: folder with the parameters of the scenarios; None: the demo's parameters.
        server: command that starts Gazebo's server; empty: the default of gazebo.launch.
    """

    folder: pathlib.Path
    seed: int = 1
    site: str = "lot"
    car: str = "gentle"
    scenarios: Tuple[str, ...] = ("autolock", "key_press")
    parameters: Optional[pathlib.Path] = None
    server: str = ""

    def demo(self, scenario: str) -> DemoOptions:
        """Return the options with which the demo runs a scenario."""
        own = self.parameters / f"{scenario}.yaml" if self.parameters else None
        return DemoOptions(self.folder, self.seed, car=self.car, scenarios=(scenario,), parameters=own)


@dataclass(frozen=True)
class Run:
    """Result of a run. statuses: exit status of the application by scenario. lines: distances compared with the
    truth."""

    notes: Notes
    statuses: Dict[str, int]
    lines: Dict[str, List[Comparison]]
    touched: Tuple[str, ...]


def run(simulator: str, options: RunOptions) -> Run:
    """Run all scenarios on one robot, into a folder that is emptied before.

    Raises:
        StackError: the robot does not start.
    """
    shutil.rmtree(options.folder, ignore_errors=True)
    with Stack(stack_options(simulator, options)) as stack, _probe(stack) as probe:
        statuses = {name: run_scenario(stack, name, options.folder / name, options.demo(name))
                    for name in options.scenarios}
        notes = _notes_of(probe)
    return Run(notes, statuses, {name: lines_of(options, name) for name in options.scenarios},
               touched_in(stack.log.read_text(encoding="utf-8", errors="replace")))


def stack_options(simulator: str, options: RunOptions) -> StackOptions:
    """Return the start options of the robot: wall time, without lock-step."""
    arguments = {"scenario": options.site, "car": options.car}
    folder = options.folder / "stack"
    if simulator == MUJOCO:
        return StackOptions(folder, options.seed, 1.0, lockstep_operator=False,
                            arguments={**arguments, "lockstep": "false"})
    if options.server:
        arguments["server"] = options.server
    return StackOptions(folder, options.seed, 1.0, lockstep_operator=None, launch=("mtr_gazebo", "gazebo.launch"),
                        arguments={**arguments, "world_folder": str((folder / "world").resolve())},
                        variables={"GAZEBO_MASTER_URI": f"http://127.0.0.1:{free_port()}"})


def lines_of(options: RunOptions, scenario: str) -> List[Comparison]:
    """Return all distances of a scenario, compared with the truth; empty without results."""
    car = chosen_scenario(options.site).car
    try:
        measured = READERS[scenario](options.folder / scenario / "results.csv")
        events = read_events(options.folder / "stack" / "truth_events.csv")
    except ResultsError as error:
        print(error, file=sys.stderr)
        return []
    return list(compared(measured, events, CarSize(car.length_m, car.width_m)))


def touched_in(log: str) -> Tuple[str, ...]:
    """Return the names of touched things from the simulators' log messages."""
    words = (line.partition("The robot touches ")[2].split(" at ")[0] for line in log.splitlines())
    return tuple(sorted({word for word in words if word}))


@contextlib.contextmanager
def _probe(stack: Stack) -> "Iterator[subprocess.Popen[str]]":
    process = subprocess.Popen([sys.executable, "-m", f"{__package__}.probe"], text=True, stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, env=stack.environment())
    try:
        assert process.stdout is not None
        process.stdout.readline()
        yield process
    finally:
        if process.poll() is None:
            process.kill()
        process.wait()


def _notes_of(probe: "subprocess.Popen[str]") -> Notes:
    said, _ = probe.communicate("", timeout=PROBE_LIMIT_S)
    noted = json.loads(said)
    truth = {int(stamp): tuple(pose) for stamp, pose in noted.pop("truth").items()}
    clock = [tuple(pair) for pair in noted.pop("clock")]
    believed = [tuple(pose) for pose in noted.pop("believed")]
    return Notes(truth=truth, clock=clock, believed=believed, **noted)
