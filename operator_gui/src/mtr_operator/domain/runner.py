"""Runs a test: prepares, measures line after line, keeps each result before the robot goes on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable, Sequence

from .actions.car import Car
from .actions.control_loop import ControlLoop
from .actions.preparation import check_car, prepare
from .actions.robot import Robot
from .errors import ProgressFileError, RobotFailed
from .results.progress import Progress
from .robot_status import CheckState
from .scenario import AnyScenario, Line, ScenarioParameters


class Runner:
    """One test from its beginning, or from where its progress ends, to its end.

    save is called with the progress after each line and has to return only when it is safe.
    """

    def __init__(self, scenario: AnyScenario, parameters: ScenarioParameters, loop: ControlLoop, progress: Progress,
                 save: Callable[[Progress], None]):
        self._scenario = scenario
        self._parameters = parameters
        self._loop = loop
        self._progress = progress
        self._save = save
        self._robot = Robot(loop)
        self._car = Car(loop)
        self._total = 0

    def run(self) -> None:
        """Measure all lines, the invalid ones once more at the end; the robot stands still afterwards in any case."""
        parameters = self._parameters
        try:
            prepare(self._loop, self._robot, self._car, parameters.key_height_m, parameters.maximum_speed_mps)
            lines = self._lines()
            if parameters.self_check:
                self._check_car()
            self._measure(lines)
        finally:
            self._halt()

    def _halt(self) -> None:
        stands = self._loop.halt()
        if stands is not None:
            self._robot.say("the robot stands still" if stands else "the robot does not confirm that it stands still; "
                            "without an application it stops by itself")

    def _check_car(self) -> None:
        check = check_car(self._robot)
        if check is None:
            return
        self._progress.record_check(check, self._loop.frames.newest, self._robot.now_s)
        if check.state is CheckState.FAILED:
            raise RobotFailed(f"The test does not begin. {check.message}".rstrip())

    def _lines(self) -> Sequence[Line]:
        mapped = self._car.dimensions()
        self._progress.check_car(mapped)
        car = self._progress.car = self._progress.car or mapped
        lines: Sequence[Line] = self._scenario.lines(self._parameters, car)
        return lines

    def _measure(self, lines: Sequence[Line]) -> None:
        by_number = {line.number: line for line in lines}
        self._total = len(lines)
        done = self._progress.measured()
        if not set(done) <= set(by_number):
            raise ProgressFileError(f"The progress file holds {self._scenario.line_word} {max(done)}; this test has "
                                    f"{self._total}.")
        self._loop.observer.on_plan(len(done), self._total)
        for number, line in by_number.items():
            if number not in done:
                self._measure_line(line)
        for number in self._progress.to_retry():
            self._measure_line(by_number[number])

    def _measure_line(self, line: Line) -> None:
        self._car.wait_for_bus()
        result = self._scenario.measure(line, self._parameters, self._robot, self._car)
        self._progress.record(result, self._loop.frames.newest)
        # Shown first, so that it is not lost for the Operator when it cannot be saved.
        self._loop.observer.on_result(result, len(self._progress.results), self._total)
        self._save(self._progress)
