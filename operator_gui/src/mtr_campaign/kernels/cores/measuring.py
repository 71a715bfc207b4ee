"""One test on all node cores of the robot, executed by the application's own runner."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
from dataclasses import dataclass
from typing import Callable

from mtr_operator.car_link.drivers.in_process import InProcessCarLink
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.robot_link.in_process import InProcessRobotLink
from mtr_operator.storage.given_files import Given
from mtr_simulation.cores.robot import CoresOptions, CoresRobot

from .car_port import DirectPort

_NS = 1e-9


@dataclass(frozen=True)
class CoresTest:
    """One test: a scenario with its parameters on the Car of a file.

    profile: Car profile of the application. folder: for the true events.
    """

    scenario: AnyScenario
    parameters: ScenarioParameters
    car: pathlib.Path
    profile: str
    seed: int
    folder: pathlib.Path


def measure(test: CoresTest, progress: Progress, save: Callable[[Progress], None]) -> float:
    """Measure all lines like `mtr-operator run`; return the duration for the robot in s.

    Raises OperatorError on failure.
    """
    port = DirectPort()
    robot = CoresRobot(CoresOptions(test.seed, str(test.car), truth_folder=test.folder), port)
    car = InProcessCarLink(test.profile, lambda: robot.time_ns * _NS, port.take)
    port.receiver = car.received
    Given().give(progress)
    with contextlib.closing(robot), contextlib.closing(car), contextlib.closing(InProcessRobotLink(robot)) as link:
        car.connect()
        link.connect()
        loop = ControlLoop(link, car)
        Runner(test.scenario, test.parameters, loop, progress, save).run()
        return loop.now_s
