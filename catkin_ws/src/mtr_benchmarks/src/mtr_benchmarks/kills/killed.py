"""Runs one complete test with the Operator's application on one robot and kills its nodes."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import random
import subprocess
import sys
import time
from dataclasses import dataclass, field
from typing import Any, Counter, Dict, List

import yaml

from mtr_simulation.stack import Stack

from ..gazebo.run import RunOptions, lines_of
from .deaths import Kill
from .kept import DROVE_ON, NOT_BACK, UNENDED, WRONG, Kept, wrong_distances
from .robot import KilledRobot

# Wall time from the start of the application, or from the return of a node, to the next kill.
SOONEST_S, LATEST_S = 1.0, 20.0
# Limit of wall time, longer than any test without kills on a busy machine.
LIMIT_S = 900.0
# A kill may end the application, which is then restarted; this may happen with every kill.
MAX_STARTS = 12
POLL_S = 0.05
PARAMETERS: Dict[str, Dict[str, Any]] = {
    "autolock": {
        "minimum_distance_m": 0.5, "maximum_distance_m": 4.0, "straightening_distance_m": 0.5,
        "measurements_distance_m": 10.0, "key_height_m": 1.0, "maximum_speed_mps": 1.0, "passes": 1,
        "measuring_speeds_mps": [0.4]},
    "key_press": {
        "minimum_distance_m": 3.0, "maximum_distance_m": 6.5, "straightening_distance_m": 0.5,
        "approach_distance_m": 0.5, "angle_between_radials_deg": 60.0, "key_height_m": 1.0, "maximum_speed_mps": 1.0,
        "method": "scan"}}


@dataclass
class Found:
    """Results of one test.

    Attributes:
        starts: number of starts of the application. found: violations, by the names in kept.MUST.
    """

    scenario: str
    kills: List[Kill] = field(default_factory=list)
    starts: int = 0
    found: Counter[str] = field(default_factory=Counter)


def killed_test(scenario: str, folder: pathlib.Path, seed: int, wanted: int) -> Found:
    """Kill at most `wanted` nodes, continue the test after each, and let it finish. Requires its own process."""
    folder.mkdir(parents=True, exist_ok=True)
    parameters = folder / f"{scenario}.yaml"
    parameters.write_text(yaml.safe_dump(PARAMETERS[scenario]), encoding="utf-8")
    with KilledRobot(folder / "stack", seed) as robot:
        test = _KilledTest(scenario, folder, robot, random.Random(f"{seed} {scenario}"))
        test.run(wanted)
    test.kept.look_at_end()
    test.kept.found[WRONG] += wrong_distances(lines_of(RunOptions(folder, seed, scenarios=(scenario,)), scenario))
    test.found.found = test.kept.found
    return test.found


class _KilledTest:
    def __init__(self, scenario: str, folder: pathlib.Path, robot: KilledRobot, chance: random.Random):
        self.found, self.kept = Found(scenario), Kept(folder / scenario, scenario, PARAMETERS[scenario])
        self._folder, self._robot, self._chance = folder, robot, chance

    def run(self, wanted: int) -> None:
        """Run until the test has finished, with as many starts as necessary."""
        while self.found.starts < MAX_STARTS:
            ended = self._live(wanted)
            self.kept.look()
            if ended:
                return
        self.kept.found[UNENDED] += 1

    def _live(self, wanted: int) -> bool:
        """Start the application or continue its test; return True if the test has finished."""
        self.found.starts += 1
        begun_s = time.monotonic()
        with (self._folder / "application.log").open("ab") as said:
            process = subprocess.Popen(self._command(self._robot.stack), stdout=said, stderr=subprocess.STDOUT)
        try:
            due_s = self._next_s()
            while process.poll() is None and time.monotonic() - begun_s < LIMIT_S:
                if len(self.found.kills) < wanted and time.monotonic() > due_s:
                    self._kill(process)
                    due_s = self._next_s()
                time.sleep(POLL_S)
            return process.poll() == 0
        finally:
            with contextlib.suppress(ProcessLookupError):
                process.kill()
            process.wait()

    def _next_s(self) -> float:
        return time.monotonic() + self._chance.uniform(SOONEST_S, LATEST_S)

    def _kill(self, application: "subprocess.Popen[bytes]") -> None:
        kill = self._robot.kill_one(self._chance, lambda: application.poll() is None)
        if kill:
            self.found.kills.append(kill)
            self.kept.found[NOT_BACK] += not kill.is_back
            self.kept.found[DROVE_ON] += not kill.stopped_in_time
            print(f"{kill}; the application {'goes on' if application.poll() is None else 'has ended'}", flush=True)
        self.kept.look()

    def _command(self, stack: Stack) -> List[str]:
        scenario, folder = self.found.scenario, self._folder
        return [sys.executable, "-m", "mtr_operator", "run", scenario, "--params", str(folder / f"{scenario}.yaml"),
                "--out", str(folder / scenario), "--robot", "127.0.0.1",
                "--subscriber-port", str(stack.status_port), "--publisher-port", str(stack.command_port),
                "--can-interface", "slcan", "--can-channel", str(stack.can_link), "--car-profile", "mtr_demo_car",
                *(["--continue", str(self.kept.path)] if self.kept.has_findings else [])]
