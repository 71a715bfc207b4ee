"""The whole test on one machine: scenarios on the simulated robot and Car, compared with the truth."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, replace
from typing import Dict, List, Optional, Sequence, Tuple

from mtr_core.errors import ConfigurationError
from mtr_simulation.car.choice import chosen_car
from mtr_simulation.site.scenario import named_scenario

from .car_sheet import car_file_of
from .stack import Stack, StackError, StackOptions

# Scenarios, and how many lines their results have at least.
MIN_LINES = {"autolock": 16, "key_press": 8, "zone_map": 8, "handle_request": 3}
# What is run unless somebody says otherwise, and on a Car that only a hand at its handle unlocks.
USUAL_SCENARIOS = ("autolock", "key_press")
SCENARIOS_OF_CAR = {"honest_handle": ("handle_request",)}
# Near the Car passive entry moves the locks too; for a test of the button it is switched off in the Car's menu.
CAR_OF_SCENARIO = {("honest", "key_press"): "honest_far_button", ("honest", "zone_map"): "honest_button",
                   ("honest", "handle_request"): "honest_handle"}
# A key that works from afar takes more room than the lot has.
SITE_OF_CAR = {"honest_far_button": "far"}
EXAMPLES = pathlib.Path("operator_gui") / "examples" / "demo"
# Where mtr-results serves unless somebody says otherwise; a contract test compares it with the store's.
STORE_PAGE = "http://127.0.0.1:8321/"
STORE = "results.sqlite"
# What a distance may be off the true event. A Car that is almost a threshold tells it each 20 ms, any other each 0.2 s,
# in which the robot drives 8 cm; there the distance's own sigma has to allow it, too.
THRESHOLD_LIMITS = ("--max-error", "0.05")
HONEST_LIMITS = ("--max-error", "0.15", "--max-sigmas", "4")
OUTPUTS = ("results.csv", "protocol.png", "progress.json", "truth.csv")
# s of wall time for which nodes wait for each other, and for the application. On a machine with many times as much to
# do as it has processors a map takes its second many times over; what is given up then makes another test of the seed.
PATIENCE = "/lockstep_patience_s: 20.0\n/dispatcher/operator_lost_after_wall_s: 20.0\n"
INTERRUPTED = 130
Row = Dict[str, str]


class DemoError(Exception):
    """A scenario did not get to its end; the text says where to look."""


@dataclass(frozen=True)
class DemoOptions:
    """What is run.

    Attributes:
        folder: of the results; its former content is deleted.
        seed: of every random number in the simulation.
        firmware: file for an emulated ATmega2560; without one the firmware is simulated.
        car: the simulated Car: name of a shipped one, or path of its file.
        scenarios: to be run, in their order; none: those that suit the Car.
        parameters: file with those of all scenarios; none: the demo's own.
    """

    folder: pathlib.Path
    seed: int = 1
    firmware: str = ""
    car: str = "gentle"
    scenarios: Tuple[str, ...] = ()
    parameters: Optional[pathlib.Path] = None

    @property
    def names(self) -> Tuple[str, ...]:
        """Scenarios to be run."""
        return self.scenarios or SCENARIOS_OF_CAR.get(self.car, USUAL_SCENARIOS)

    @property
    def car_argument(self) -> str:
        """The Car as the nodes find it: they work in another folder."""
        return str(pathlib.Path(self.car).resolve()) if self.car.endswith(".yaml") else self.car

    @property
    def stack_folder(self) -> pathlib.Path:
        """Of the simulated robot and Car."""
        return self.folder / "stack" / pathlib.Path(self.car).stem

    @property
    def site(self) -> str:
        """What stands around the Car: a name of mtr_simulation's scenarios."""
        return SITE_OF_CAR.get(self.car, "lot")

    @property
    def events(self) -> pathlib.Path:
        """File with the true events."""
        return self.stack_folder / "truth_events.csv"

    def car_for(self, scenario: str) -> str:
        """The Car on which a scenario runs."""
        return CAR_OF_SCENARIO.get((self.car, scenario), self.car)

    def least_lines(self, scenario: str) -> int:
        """Of results that are whole; of other parameters than the demo's nobody knows."""
        return MIN_LINES[scenario] if self.parameters is None else 1

    @property
    def model(self) -> Tuple[str, ...]:
        """Arguments of the comparison that name the Car."""
        return "--car", self.car, "--seed", str(self.seed)

    @property
    def limits(self) -> Tuple[str, ...]:
        """Arguments of the comparison: what a distance may be off."""
        return HONEST_LIMITS if chosen_car(self.car).honest else THRESHOLD_LIMITS


@dataclass(frozen=True)
class DemoResult:
    """What came of it.

    Attributes:
        robot_s: time that passed for the robot until the last event.
        wall_s: wall time, start-up and pictures included, the comparison with the truth not.
        problems: a sentence for everything that is not as it has to be.
    """

    robot_s: float
    wall_s: float
    problems: Tuple[str, ...]

    @property
    def real_time_factor(self) -> float:
        """Robot time by wall time."""
        return self.robot_s / self.wall_s


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the demo; 0 when every line was measured and every file is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="seed of every random number in the simulation")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/demo"), help="result folder")
    parser.add_argument("--firmware", default="", help="firmware for an emulated ATmega2560; else it is simulated")
    parser.add_argument("--car", default="honest", help="simulated Car: honest, gentle, ... or a file")
    parser.add_argument("--scenarios", nargs="*", choices=list(MIN_LINES), default=[],
                        help="what is run; default: autolock and key_press, or handle_request on honest_handle")
    parser.add_argument("--params", type=pathlib.Path, default=None, help="parameters of its scenarios; default: own")
    options = parser.parse_args(arguments)
    try:
        demo = DemoOptions(options.out, options.seed, options.firmware, options.car,
                           tuple(dict.fromkeys(options.scenarios)), options.params)
        result = run_demo(demo)
    except (StackError, DemoError, ConfigurationError) as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return INTERRUPTED
    print(f"Robot time {result.robot_s:.0f} s in {result.wall_s:.0f} s of wall time: "
          f"{result.real_time_factor:.1f} x real time, start-up and pictures included.")
    problems = [*result.problems, *keep_in_store(options.out)]
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


def keep_in_store(folder: pathlib.Path) -> List[str]:
    """Put the tests of the demo into a store, and print where a person sees them; a sentence when that fails."""
    store = folder / STORE
    command = [sys.executable, "-m", "mtr_results", "import", "--store", str(store), "--campaign", "demo",
               "--spool", str(folder / "spool"), str(folder)]
    if subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode:
        return [f"The tests could not be put into the store {store}; see what mtr-results says above."]
    print(f"The tests are in the store {store}: {STORE_PAGE} shows them once mtr-results serve --store {store} runs.")
    return []


def run_demo(options: DemoOptions) -> DemoResult:
    """Run the scenarios and compare them with the truth.

    Raises:
        StackError: the simulated robot did not start.
        DemoError: a scenario failed.
        ConfigurationError: there is no such Car.
    """
    chosen_car(options.car)
    shutil.rmtree(options.folder, ignore_errors=True)
    options.folder.mkdir(parents=True)
    started_s = time.monotonic()
    parts = parts_of(options)
    for part, names in parts:
        run_part(part, names)
    wall_s = time.monotonic() - started_s
    problems = [problem for part, names in parts for name in names
                for problem in problems_of(part.folder, name, part.events, (*part.model, *part.limits),
                                       part.least_lines(name))]
    times_s = [last_event(read_rows(part.events)) for part, _ in parts]
    return DemoResult(sum(times_s), wall_s, tuple(problems))


def parts_of(options: DemoOptions) -> List[Tuple[DemoOptions, List[str]]]:
    """The scenarios of each Car, which are run one after the other on one simulated robot."""
    parts: Dict[str, List[str]] = {}
    for name in options.names:
        parts.setdefault(options.car_for(name), []).append(name)
    return [(replace(options, car=car), names) for car, names in parts.items()]


def run_part(options: DemoOptions, names: Sequence[str]) -> None:
    """Run the scenarios that share a Car."""
    options.stack_folder.mkdir(parents=True, exist_ok=True)
    patience = options.stack_folder.resolve() / "patience.yaml"
    patience.write_text(PATIENCE, encoding="utf-8")
    car_file = patience.with_name("car.yaml")
    car_file.write_text(car_file_of(options.site), encoding="utf-8")
    with Stack(StackOptions(options.stack_folder, options.seed, rviz="DISPLAY" in os.environ,
                            arguments={"firmware_elf": options.firmware, "car": options.car_argument,
                                       "scenario": options.site, "node_parameters": str(patience),
                                       "car_file": str(car_file)})) as stack:
        statuses = [run_scenario(stack, name, options.folder / name, options) for name in names]
    if any(statuses):
        raise DemoError(f"A scenario failed; see {stack.log} and {options.folder}.")


def parameters_of(scenario: str, car: str) -> pathlib.Path:
    """File with the parameters of a scenario: those for this Car where there are such."""
    own = EXAMPLES / pathlib.Path(car).stem / f"{scenario}.yaml"
    return own if own.exists() else EXAMPLES / f"{scenario}.yaml"


def run_scenario(stack: Stack, name: str, folder: pathlib.Path, options: DemoOptions) -> int:
    """Run one scenario with the Operator's application, as a person would from the command line; its exit status."""
    parameters = options.parameters or parameters_of(name, options.car)
    print(f"=== {name}", flush=True)
    # A comparison of two demos knows by it that both are of the same Car.
    identity = options.stack_folder / "identity.yaml"
    identity.parent.mkdir(parents=True, exist_ok=True)
    identity.write_text(json.dumps({"car_model": f"simulated {pathlib.Path(options.car).stem}"}), encoding="utf-8")
    return subprocess.run([
        sys.executable, "-m", "mtr_operator", "run", name, "--params", str(parameters),
        "--out", str(folder), "--robot", "127.0.0.1", "--subscriber-port", str(stack.status_port),
        "--publisher-port", str(stack.command_port), "--can-interface", "slcan", "--can-channel", str(stack.can_link),
        "--can-bitrate", "500000", "--car-profile", chosen_car(options.car).profile, "--bundle",
        "--identity", str(identity),
        # The output that takes the handle is switched over the Car's bus.
        *(["--can-normal"] if name == "handle_request" else []),
    ], check=False).returncode


def problems_of(folder: pathlib.Path, name: str, events: pathlib.Path, model: Sequence[str] = (),
                least_lines: Optional[int] = None) -> List[str]:
    """Compare a scenario's results with the truth; a sentence for each thing that is wrong or missing."""
    problems, least = [], MIN_LINES[name] if least_lines is None else least_lines
    if compare(events, folder / name, *model):
        problems.append(f"{name}: measured and true events do not match")
    problems += [f"{name}: {file} is missing" for file in OUTPUTS if not (folder / name / file).exists()]
    rows = read_rows(results_of(folder, name))
    if len(rows) < least:
        problems.append(f"{name}: {len(rows)} lines instead of at least {least}")
    return problems


def compare(events: pathlib.Path, folder: pathlib.Path, *model: str) -> int:
    """Write truth.csv beside the results and print measured against true; 0 when every measured line has its event.

    model: arguments that name the Car, for its probabilities, and what a distance may be off.
    """
    car = named_scenario("lot").car
    return subprocess.run([
        sys.executable, "-m", "mtr_simulation.truth.compare", "--scenario", folder.name, "--events", str(events),
        "--results", str(folder), "--car-length", str(car.length_m), "--car-width", str(car.width_m), *model,
    ], check=False).returncode


def results_of(folder: pathlib.Path, name: str) -> pathlib.Path:
    """File with the results of a scenario."""
    return folder / name / "results.csv"


def last_event(rows: List[Row]) -> float:
    """Robot time of the last event in the rows, in s; 0 without one."""
    return max((float(value) for row in rows for column, value in row.items()
                if column.endswith("robot_time_s") and value), default=0.0)


def read_rows(path: pathlib.Path) -> List[Row]:
    """Rows of a results file, metadata lines skipped; none when it is missing."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


if __name__ == "__main__":
    sys.exit(main())
