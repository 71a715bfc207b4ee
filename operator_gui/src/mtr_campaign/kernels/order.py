"""Settings of a run: a Car, parameters of the scenario and errors of the robot; checked before anything runs.

    car                     name of a simulated Car, or path of its file       seed    random seed of the test
    place                   seed of spatial effects: fading and shadowing      key.X, uhf.X, noise.X, passive_entry.X,
    antennas.NAME.X         antenna of the passive entry                       locks.X, bus.X: values of the Car's file
    parameters.X            of the scenario, by the name in its file           errors.X: of the robot (radio kernel)
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib
from dataclasses import dataclass
from typing import Any

from mtr_core.errors import RobotError
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_simulation.car.choice import CarChoice, car_content, car_from

from ..errors import CampaignError
from ..plan.run import Run, Value

CAR, SEED, PLACE, ANTENNAS, PARAMETERS, ERRORS = "car", "seed", "place", "antennas", "parameters", "errors"
_OF_CAR = ("uhf", "noise", "key", "passive_entry", "locks", "bus")
_USUAL_CAR = "honest"
_MAX_SEED = 2**31 - 1


@dataclass(frozen=True)
class Order:
    """Validated settings of one simulated test.

    Attributes:
        car_file: content of the Car's file, including the settings. errors: of the robot, not yet validated.
    """

    scenario: AnyScenario
    parameters: ScenarioParameters
    car: CarChoice
    car_file: dict[str, Any]
    errors: dict[str, Any]
    seed: int


def order_of(run: Run) -> Order:
    """Convert the settings of a run; CampaignError names an impossible setting."""
    groups: dict[str, dict[str, Value]] = {name: {} for name in (ANTENNAS, PARAMETERS, ERRORS, *_OF_CAR)}
    alone: dict[str, Value] = {}
    for name, value in run.settings.items():
        group, _, rest = name.partition(".")
        if rest and group in groups:
            groups[group][rest] = value
        elif name in (CAR, SEED, PLACE):
            alone[name] = value
        else:
            raise CampaignError(f"The setting {name:.60} is unknown; allowed are {CAR}, {SEED}, {PLACE}, and names "
                                f"that begin with {', '.join(f'{each}.' for each in groups)}.")
    scenario = SCENARIOS[run.scenario]
    file = _car_file(str(alone.get(CAR, _USUAL_CAR)), groups, alone)
    try:
        parameters = scenario.parameters_type.from_mapping({**scenario.parameters_type.proposed(),
                                                            **groups[PARAMETERS]})
        car = car_from(file, pathlib.Path(str(alone.get(CAR, _USUAL_CAR))))
    except (OperatorError, RobotError) as error:
        raise CampaignError(str(error)) from None
    return Order(scenario, parameters, car, file, dict(groups[ERRORS]), _seed(alone.get(SEED, 1)))


def _car_file(car: str, groups: dict[str, dict[str, Value]], alone: dict[str, Value]) -> dict[str, Any]:
    content = {name: dict(value) if isinstance(value, dict) else value for name, value in _content(car).items()}
    for section in _OF_CAR:
        if groups[section]:
            content[section] = {**(content.get(section) or {}), **groups[section]}
    for name, value in groups[ANTENNAS].items():
        antenna, _, entry = name.partition(".")
        antennas = content.setdefault(ANTENNAS, {})
        antennas[antenna] = {**antennas.get(antenna, {}), entry: value}
    if PLACE in alone:
        content["place_seed"] = alone[PLACE]
    return content


@functools.lru_cache(maxsize=64)
def _content(car: str) -> dict[str, Any]:
    try:
        content: dict[str, Any] = car_content(car)[0]
    except RobotError as error:
        raise CampaignError(str(error)) from None
    return content


def _seed(value: Value) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= _MAX_SEED:
        raise CampaignError(f"The setting {SEED} is {value!r:.60}; allowed is a whole number from 0 to {_MAX_SEED}.")
    return value
