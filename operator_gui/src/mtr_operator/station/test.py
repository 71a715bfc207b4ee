"""One test from its parameters to its protocol, and the progress file that follows it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
from dataclasses import dataclass

from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import CONTINUED, now, session_record, written
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.atomic import output_folder
from mtr_operator.storage.progress_file import open_progress, save_progress

from .connection import SIMULATED, CanChoice, Connection
from .estimate import USUAL_CAR

_MOMENT = "%Y-%m-%d_%H-%M-%S"


@dataclass
class Test:
    """What is measured, and where its progress is written. While it runs, progress belongs to the links' thread."""

    # The name would make pytest collect it.
    __test__ = False

    scenario: AnyScenario
    parameters: ScenarioParameters
    progress: Progress
    path: pathlib.Path

    @property
    def name(self) -> str:
        """Of the files and the folder of this test."""
        return self.path.stem

    @property
    def car(self) -> CarDimensions:
        """The Car as measured, a usual one before."""
        return self.progress.car or USUAL_CAR

    @property
    def line_count(self) -> int:
        """Lines of the whole test, by the Car as far as it is known."""
        return len(self.scenario.lines(self.parameters, self.car))

    @property
    def is_complete(self) -> bool:
        """True when no line is left to be measured."""
        progress = self.progress
        return (progress.car is not None and len(progress.results) == self.line_count
                and not progress.to_retry())

    def save(self) -> None:
        """Write the progress, and its folder if need be; OutputError when that fails."""
        with output_folder(self.path.parent):
            save_progress(self.path, self.progress)

    def discard_if_empty(self) -> None:
        """Leave no file of a test that has measured nothing."""
        if not self.progress.results:
            with contextlib.suppress(OSError):
                self.path.unlink()


def new_test(scenario: AnyScenario, parameters: ScenarioParameters, folder: pathlib.Path,
             connection: Connection) -> Test:
    """A test that has measured nothing yet."""
    started = now()
    session = session_record(started, connection.robot.host, profile_name(connection.can))
    path = folder / f"{scenario.name}_{started.strftime(_MOMENT)}.json"
    return Test(scenario, parameters, Progress(scenario.name, parameters.to_mapping(), session), path)


def profile_name(can: CanChoice | None) -> str:
    """What results call the Car's profile."""
    if can is None:
        return ""
    return "substitute" if can.interface == SIMULATED else can.profile


def open_test(path: pathlib.Path) -> Test:
    """The test in a progress file, to go on with; ProgressFileError says what is wrong with the file."""
    scenario, parameters, progress = open_progress(path, SCENARIOS)
    return Test(scenario, parameters, progress, path)


def note_continued(test: Test) -> None:
    """Say in the progress that the test goes on now."""
    test.progress.session[CONTINUED] = written(now())
