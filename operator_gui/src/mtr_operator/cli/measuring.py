"""One test from parameter file to protocol."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import contextlib
import datetime
import sys
from typing import Any

from mtr_operator import __version__
from mtr_operator.domain.ports import RobotLink
from mtr_operator.domain.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.session import Session
from mtr_operator.domain.trouble import Cancelled
from mtr_operator.report.files import write_report
from mtr_operator.storage import progress_file
from mtr_operator.storage.atomic import prepare_folder
from mtr_operator.storage.parameter_file import load_parameters

from .display import Display
from .interrupt import Interrupt
from .links import car_link, robot_link


def run_test(options: argparse.Namespace) -> None:
    """Run the test that the command line asks for; OperatorError or Cancelled when it does not come to its end."""
    Measuring(options).run()


class Measuring:
    """A test that the command line asks for. Making it reads and checks the files, and changes nothing."""

    def __init__(self, options: argparse.Namespace):
        self._options = options
        self._scenario = SCENARIOS[options.scenario]
        self._parameters = load_parameters(options.params, self._scenario.parameters_type)
        self._progress_path = options.out / progress_file.FILE_NAME
        self._progress = self._begin()

    def run(self) -> None:
        """Measure what is left and write the report."""
        prepare_folder(self._options.out)
        with contextlib.closing(Display(self._scenario)) as display, Interrupt() as interrupt:
            try:
                self._measure(display, interrupt)
            except BaseException:
                self._keep()
                raise
            display.close()
            self._save(self._progress)
            write_report(self._options.out, self._scenario, self._parameters, self._progress)
        self._say_summary()

    def _begin(self) -> Progress:
        continued, path = self._options.continued, self._progress_path
        if continued is None or continued.resolve() != path.resolve():
            progress_file.refuse_to_overwrite(path)
        parameters = self._parameters.to_mapping()
        if continued is None:
            return Progress(self._scenario.name, parameters, _session_data(self._options))
        progress = progress_file.load_progress(continued, self._scenario, parameters)
        progress.session["continued"] = _now()
        return progress

    def _measure(self, display: Display, interrupt: Interrupt) -> None:
        with contextlib.closing(car_link(self._options)) as car, contextlib.closing(robot_link(self._options)) as robot:
            car.connect()
            robot.connect()
            if interrupt.requested:
                raise Cancelled("The Operator ended the test.")
            session = Session(robot, car, display, interrupt.is_requested)
            self._progress.session["robot software"] = session.status.software_version
            try:
                Runner(self._scenario, self._parameters, session, self._progress, self._save).run()
            finally:
                _say_statistics(robot, session)

    def _save(self, progress: Progress) -> None:
        progress_file.save_progress(self._progress_path, progress)

    def _keep(self) -> None:
        """After a test that did not come to its end: keep what it has measured."""
        if self._progress.results:
            self._save(self._progress)
            print(f"{len(self._progress.results)} measured lines are kept; go on with --continue {self._progress_path}",
                  file=sys.stderr)

    def _say_summary(self) -> None:
        results = self._progress.results
        invalid = sum(1 for result in results if self._scenario.invalid_count(result))
        tail = f", {invalid} of them invalid" if invalid else ""
        print(f"{len(results)} lines measured{tail}; results are in {self._options.out}.")


def _session_data(options: argparse.Namespace) -> dict[str, Any]:
    return {
        "started": _now(),
        "software": f"mtr-operator {__version__}",
        "robot": "substitute" if options.simulated_robot else options.robot,
        "car profile": "substitute" if options.simulated_car else options.car_profile,
        "units": "SI; angles in degrees where the column says so; 1 sigma uncertainties",
        "coordinates": "Car coordinate system: origin in the Car's centre, x to its front, y to its left",
    }


def _now() -> str:
    return datetime.datetime.now().astimezone().isoformat(timespec="seconds")


def _say_statistics(robot: RobotLink, session: Session) -> None:
    ignored = robot.statistics.undecodable + robot.statistics.oversized
    if ignored:
        print(f"{ignored} messages from the robot were ignored: {robot.statistics.last_error}", file=sys.stderr)
    rejected = session.status.rejected_messages
    if rejected:
        print(f"The robot has rejected {rejected} messages since its start.", file=sys.stderr)
