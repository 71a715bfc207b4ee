"""One test on the radio model, executed by the application's own scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.preparation import prepare
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Concluding
from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.scenarios.autolock import Autolock
from mtr_operator.robot_link.virtual.robot import VirtualRobot
from mtr_simulation.car.honest.instants import HonestInstants
from mtr_simulation.car.honest.parameters import HonestParameters

from .errors import RadioErrors
from .links import RadioCarLink, RadioRobotLink
from .world import RadioWorld

# Size of the simulated Car of all sites, m.
CAR_LENGTH_M, CAR_WIDTH_M = 4.5, 1.8


@dataclass(frozen=True)
class RadioTest:
    """One test: a scenario with its parameters on a Car, by a robot with these errors.

    facts: lock facts from the Car's profile.
    """

    scenario: AnyScenario
    parameters: ScenarioParameters
    car: HonestParameters
    errors: RadioErrors
    facts: LockFacts
    seed: int


@dataclass(frozen=True)
class Measured:
    """Attributes: progress: as stored by the application. robot_s: duration for a real robot."""

    progress: Progress
    robot_s: float


def measure(test: RadioTest) -> Measured:
    """Measure all lines, invalid ones twice like the application's runner; OperatorError on failure."""
    scenario, parameters = test.scenario, test.parameters
    belief = test.errors.world(CAR_LENGTH_M, CAR_WIDTH_M)
    world = RadioWorld(test.seed, HonestInstants(test.seed, test.car), VirtualRobot(test.seed, belief), test.errors,
                       belief.key_x_m)
    loop = ControlLoop(RadioRobotLink(world), RadioCarLink(world, test.facts, test.errors.clock_s))
    progress = Progress(scenario.name, parameters.to_mapping())
    robot, car = Robot(loop, progress.results), Car(loop)
    prepare(loop, robot, car, parameters.key_height_m, parameters.maximum_speed_mps)
    progress.car = car.dimensions()
    lines = {line.number: line for line in scenario.lines(parameters, progress.car)}
    # concluded() adds the boundaries of axes at the end; they do not affect how later axes are driven.
    measured: Callable[..., LineResult] = scenario.drive if isinstance(scenario, Autolock) else scenario.measure
    for line in lines.values():
        progress.record(measured(line, parameters, robot, car))
    for number in progress.to_retry():
        progress.record(measured(lines[number], parameters, robot, car))
    for result in part(scenario, Concluding).concluded(parameters, progress.results):
        progress.revise(result)
    return Measured(progress, loop.now_s)
