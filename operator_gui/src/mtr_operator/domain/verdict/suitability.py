"""Check of limits before the robot moves: they must match the test's lines and distances, and not contradict."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from itertools import combinations
from typing import Sequence

from ..errors import InvalidLimits
from ..geometry.ray import Ray
from ..interfaces.part import part
from ..interfaces.scenario_parts import Judging
from ..results.quantity import Quantity
from ..robot_status import CarDimensions
from ..scenario import AnyScenario, Line, ScenarioParameters
from .limits import Limits
from .requirement import OF_DISTANCES, Requirement

_POINT = CarDimensions(0.0, 0.0, 0.0, 0.0)


def check_distances(limits: Limits, scenario: AnyScenario, parameters: ScenarioParameters) -> None:
    """Raise InvalidLimits unless the scenario measures the limited quantities with these parameters."""
    quantities = {each.word: each for each in part(scenario, Judging).judged_quantities(parameters)}
    for requirement in limits.requirements:
        quantity = quantities.get(requirement.what)
        if quantity is not None:
            _check_quantity(requirement, quantity)
        elif requirement.what in scenario.distance_words:
            _check_distance(requirement, scenario, parameters)
        else:
            raise InvalidLimits(f"Limit {requirement.name!r}: {scenario.title} measures no {requirement.what!r}; it "
                                f"measures {', '.join((*scenario.distance_words, *quantities))}.")


def _check_quantity(requirement: Requirement, quantity: Quantity) -> None:
    _check_key(requirement, quantity.keys)
    if not quantity.low <= requirement.limit <= quantity.high:
        unit = requirement.unit
        raise InvalidLimits(f"Limit {requirement.name!r}: it is at {requirement.limit:g} {unit}, and with these "
                            f"parameters only one from {quantity.low:.4g} to {quantity.high:.4g} {unit} can be judged.")


def _check_distance(requirement: Requirement, scenario: AnyScenario, parameters: ScenarioParameters) -> None:
    name, shares = requirement.name, part(scenario, Judging).judged_shares(parameters)
    low_m, high_m = parameters.distance_range_m
    _check_key(requirement, OF_DISTANCES)
    if not shares:
        raise InvalidLimits(f"Limit {name!r}: with these parameters {scenario.title} does not say how sure a "
                            "distance is; no limit can be judged.")
    if requirement.share_percent not in shares:
        raise InvalidLimits(f"Limit {name!r}: {scenario.title} tells the distance for "
                            f"{' or '.join(map(str, shares))} % of the attempts, not for "
                            f"{requirement.share_percent} %.")
    if not low_m < requirement.limit < high_m:
        raise InvalidLimits(f"Limit {name!r}: it is at {requirement.limit:g} m, and the test measures from "
                            f"{low_m:g} to {high_m:g} m only; no measurement could judge it.")


def _check_key(requirement: Requirement, keys: Sequence[str]) -> None:
    if requirement.key not in keys:
        raise InvalidLimits(f"Limit {requirement.name!r}: {requirement.what} is limited by {' or '.join(keys)}, not by "
                            f"{requirement.key}.")


def check_before_start(limits: Limits, scenario: AnyScenario, parameters: ScenarioParameters) -> None:
    """Raise InvalidLimits if the limits match no Car: the directions of lines do not depend on the Car's size."""
    check_distances(limits, scenario, parameters)
    check_lines(limits, scenario.lines(parameters, _POINT), scenario.line_word)


def check_lines(limits: Limits, lines: Sequence[Line], line_word: str) -> None:
    """Raise InvalidLimits for a limit without a line, and for two limits that no Car can keep on a line."""
    for requirement in limits.requirements:
        if not any(requirement.names(line.ray) for line in lines):
            raise InvalidLimits(f"Limit {requirement.name!r} names no {line_word} of this test.")
    for line in lines:
        for first, second in combinations(_of(limits, line.ray), 2):
            if _contradict(first, second) or _contradict(second, first):
                raise InvalidLimits(f"Limits {first.name!r} and {second.name!r} contradict each other on {line_word} "
                                    f"{line.number}: {first.text}, {second.text}.")


def _of(limits: Limits, ray: Ray) -> list[Requirement]:
    return [requirement for requirement in limits.requirements if requirement.names(ray)]


def _contradict(lower: Requirement, upper: Requirement) -> bool:
    """Return True for a contradiction. A larger share works at a smaller distance; a lower bound for it therefore also
    applies to the smaller share."""
    return (lower.what == upper.what and lower.is_at_least and not upper.is_at_least
            and lower.share_percent >= upper.share_percent and lower.limit >= upper.limit)
