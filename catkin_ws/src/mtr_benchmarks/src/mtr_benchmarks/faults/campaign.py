"""Runs cells of the matrix one after the other on one robot, in its own process."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
from typing import List, NamedTuple, Optional

from mtr_simulation.stack import StackError

from .course import Course
from .judge import Outcome, wrong
from .matrix import LOST, Cell
from .record import Run
from .robot import FaultyRobot, FaultyRobotError, PutBackError
from .robots import ROBOTS


class Found(NamedTuple):
    """Result of one cell. wrong: differences from the matrix."""

    cell: Cell
    outcome: Optional[Outcome]
    wrong: List[str]


def one_robot(cells: List[Cell], folder: pathlib.Path, run: Run) -> List[Found]:
    """Run cells of one kind of robot in order, until the robot cannot continue or all are done."""
    ran: List[Found] = []
    with contextlib.ExitStack() as opened:
        try:
            robot = opened.enter_context(FaultyRobot(folder, ROBOTS[cells[0].robot], run.seed))
        except StackError as error:
            # The reason does not matter: the next robot starts with the following cell.
            return [_failed(cells[0], error, run)]
        course = Course(robot)
        for cell in cells:
            try:
                outcome = course.run(cell)
            except FaultyRobotError as error:
                if isinstance(error, PutBackError) and ran:
                    # The next robot starts at the starting place with this cell.
                    break
                # The next robot starts with the following cell; a cell that cannot be started has failed.
                ran.append(_failed(cell, error, run))
                break
            ran.append(Found(cell, outcome, wrong(cell, outcome)))
            run.keep(cell.name, ran[-1].wrong)
            print(f"{cell.name}: {'; '.join(ran[-1].wrong) or 'as it must be'}", flush=True)
            if outcome.then == LOST:
                break
    return ran


def _failed(cell: Cell, error: Exception, run: Run) -> Found:
    found = Found(cell, None, [str(error)])
    run.keep(cell.name, found.wrong)
    return found
