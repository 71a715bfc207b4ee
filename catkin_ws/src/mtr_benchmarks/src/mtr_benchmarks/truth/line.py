"""Measures one line in its own world, with one random disturbance."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
from typing import Any, NamedTuple, Tuple, Union

from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.preparation import prepare
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.scenarios.autolock import Autolock
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.key_press import KeyPress
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

from .car import CYCLE_S, SOURCE_BUTTON, CarBody, Order
from .clocks import Clock, Way
from .disturbances import BOTH, OF_PRESSES
from .judge import Verdict, Window, judge_autolock, judge_key_press
from .robot import RobotBody
from .world import CAR, STATUS_PERIOD_S, PoseError, World, WorldCar, WorldRobot

PROFILE = load_profile("mtr_demo_car")
# Disturbances begin within this time from some moments before a line; a line lasts 8 to 15 s.
WITHIN_S = 16.0
# A disturbance that ended this long before a line has no effect on it: the clocks are mapped again within two seconds.
EFFECT_S = 4.0
# Share of robots with current software.
NEW_ROBOTS = 0.85
# 1 sigma of the position, from a robot next to walls to one in the open. Its error is normally distributed, but limited
# to this number of sigmas and this size. The error of the event's time must also fit into 3 sigmas and 5 cm.
MIN_SIGMA_M, MAX_SIGMA_M = 0.002, 0.03
POSE_SIGMAS, POSE_ERROR_M = 2.0, 0.035
# One part of the error is constant during the line; the other swings with a period in this range.
SWING_S = (20.0, 60.0)
# Distance that is never reached.
NEVER_M = -1.0
Parameters = Union[AutolockParameters, KeyPressParameters]


class Line(NamedTuple):
    """Result of one line.

    Attributes:
        is_disturbed: a disturbance was active while it was measured.
        told: status and distance of each measurement.
    """

    number: int
    kind: str
    is_disturbed: bool
    verdict: Verdict
    reason: str
    told: Tuple[str, ...]


def run_line(seed: int, number: int) -> Line:
    """Measure one line; the same seed and number give the same result."""
    chance = random.Random(f"{seed} {number}")
    is_autolock = number % 2 == 0
    world = _world(chance, is_autolock, pose_error(random.Random(f"{seed} {number} pose")))
    robot_link = WorldRobot(world)
    loop = ControlLoop(robot_link, WorldCar(world, robot_link, PROFILE))
    robot, car = Robot(loop), Car(loop)
    parameters = _parameters(chance, is_autolock)
    kinds = BOTH if is_autolock else OF_PRESSES
    kind = list(kinds)[number // 2 % len(kinds)]
    prepare(loop, robot, car, parameters.key_height_m, parameters.maximum_speed_mps)
    disturbance = kinds[kind](world, chance, world.time_s + chance.uniform(0.0, WITHIN_S))
    for _ in range(chance.randrange(round(EFFECT_S / STATUS_PERIOD_S))):
        loop.step()
    begin_s = world.time_s
    result, reason = _measured(Autolock() if is_autolock else KeyPress(), parameters, robot, car, chance)
    window = Window(begin_s, world.time_s, parameters.key_height_m)
    return Line(number, kind, disturbance.begin_s <= window.end_s and disturbance.end_s >= begin_s - EFFECT_S,
                _verdict(world, result, parameters, window), reason, _told(result))


def _measured(scenario: AnyScenario, parameters: Parameters, robot: Robot, car: Car,
              chance: random.Random) -> Tuple[Any, str]:
    line = chance.choice(scenario.lines(parameters, CAR))
    try:
        car.wait_for_bus()
        result = scenario.measure(line, parameters, robot, car)
    except OperatorError as error:
        return None, str(error)
    return (line.ray, result), result.reason


def _verdict(world: World, measured: Any, parameters: Parameters, window: Window) -> Verdict:
    if measured is None:
        return Verdict.INVALID
    ray, result = measured
    if isinstance(parameters, AutolockParameters):
        return judge_autolock(world, ray, result.distances, window)
    return judge_key_press(world, ray, result.distances, window, parameters.response_timeout_s)


def _told(measured: Any) -> Tuple[str, ...]:
    if measured is None:
        return ()
    result: LineResult = measured[1]
    return tuple(f"{distance.status.value} {distance.distance_m}" for distance in result.distances)


def pose_error(chance: random.Random) -> PoseError:
    """Return the random pose error of one line."""
    sigma_m = math.exp(chance.uniform(math.log(MIN_SIGMA_M), math.log(MAX_SIGMA_M)))
    limit_m = min(POSE_SIGMAS * sigma_m, POSE_ERROR_M)
    still, swing = (tuple(chance.gauss(0.0, sigma_m / math.sqrt(2.0)) for _ in "xy") for _ in range(2))
    far = max(math.hypot(*still) + math.hypot(*swing), limit_m) / limit_m
    return PoseError(sigma_m, (still[0] / far, still[1] / far), (swing[0] / far, swing[1] / far),
                     chance.uniform(*SWING_S))


def _world(chance: random.Random, is_autolock: bool, error: PoseError) -> World:
    unlock_m = chance.uniform(0.8, 2.8) if is_autolock and chance.random() < 0.75 else NEVER_M
    car = CarBody(unlock_m, max(unlock_m, 0.0) + chance.uniform(0.2, 0.6), chance.uniform(0.0, CYCLE_S))
    if not is_autolock and chance.random() < 0.3:
        car.foreign.append(Order(0.5, False, SOURCE_BUTTON))
    return World(
        RobotBody(), car, Clock(chance.uniform(1e3, 1.7e9), chance.uniform(-100.0, 100.0)),
        Clock(chance.uniform(0.0, 60.0), chance.uniform(-100.0, 100.0)),
        Way(chance, chance.uniform(0.0005, 0.003), chance.uniform(0.001, 0.006)), Way(chance, 0.0003, 0.0005),
        press_range_m=chance.uniform(3.2, 6.2) if chance.random() < 0.85 else 1.0,
        reaction_s=chance.uniform(0.05, 0.5), is_stamped=chance.random() < 0.7,
        tells_steady_clock=chance.random() < NEW_ROBOTS, pose_error=error)


def _parameters(chance: random.Random, is_autolock: bool) -> Parameters:
    if is_autolock:
        return AutolockParameters(measuring_speed_mps=round(chance.uniform(0.2, 0.6), 2))
    return KeyPressParameters()
