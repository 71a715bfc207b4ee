"""The central interfaces of the Operator's application stay narrow."""
# SPDX-License-Identifier: Apache-2.0
import ast
import dataclasses
import inspect

import pytest
from project import TOP, tracked

from mtr_operator.domain.exchange.exchange import Exchange
from mtr_operator.domain.exchange.run_context import RunContext
from mtr_operator.domain.interfaces.car_bus import BusMonitor, BusRecorder, CarEquipment
from mtr_operator.domain.interfaces.scenario_parts import (
    Concluding,
    Forecasting,
    FurtherAttempts,
    Judging,
    Resuming,
    StartChecks,
)
from mtr_operator.domain.ports import CarLink
from mtr_operator.domain.scenario import Scenario
from mtr_operator.domain.scenarios import SCENARIOS

CAR_LINK_PARTS = {part.__name__: part for part in (BusMonitor, BusRecorder, CarEquipment)}

SCENARIO_PARTS = (Concluding, Forecasting, FurtherAttempts, Judging, Resuming, StartChecks)


def members(interface):
    """Names that a class defines itself, without those of the language."""
    return {name for name in vars(interface) if not (name.startswith("__") or name.startswith("_abc_"))}


def test_exchange_has_at_most_twelve_members():
    exchange = Exchange(None, lambda: None, None, lambda: False)
    assert len(members(Exchange) | {name for name in vars(exchange) if not name.startswith("_")}) <= 12


def test_records_of_a_run_are_frozen():
    with pytest.raises(dataclasses.FrozenInstanceError):
        RunContext().journal = None


def test_car_link_has_at_most_six_members():
    assert len(members(CarLink)) <= 6


def test_parts_of_a_car_link_are_narrow_and_distinct():
    sets = [members(part) for part in (CarLink, *CAR_LINK_PARTS.values())]
    assert max(map(len, sets)) <= 6
    assert len(set.union(*sets)) == sum(map(len, sets))


def test_scenario_requires_lines_and_measure_alone():
    assert Scenario.__abstractmethods__ == {"lines", "measure"}
    assert {name for name in members(Scenario) if callable(vars(Scenario)[name])} == {"lines", "measure", "picture"}


def test_parts_of_a_scenario_are_narrow_distinct_and_declared():
    sets = [members(part) for part in (Scenario, *SCENARIO_PARTS)]
    assert max(map(len, sets[1:])) <= 4
    assert len(set.union(*sets)) == sum(map(len, sets))
    for scenario in SCENARIOS.values():
        offered = members(type(scenario)) - members(Scenario)
        assert [part for part in SCENARIO_PARTS if offered & members(part) and not isinstance(scenario, part)] == []
        assert [part for part in SCENARIO_PARTS if isinstance(scenario, part) and not offered & members(part)] == []


def classes():
    """Each class of a Python file of the application, the robot and the tests, with its file."""
    for path in tracked("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef):
                yield path.relative_to(TOP), node


def undeclared(node, parts):
    """Parts whose members a class defines without deriving from them."""
    bases = {base.id for base in node.bases if isinstance(base, ast.Name)}
    defined = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
    return [name for name, part in parts.items() if name not in bases and defined & members(part)]


def test_a_car_link_derives_from_the_parts_that_it_offers():
    links = [(path, node) for path, node in classes()
             if any(isinstance(base, ast.Name) and base.id == "CarLink" for base in node.bases)]
    assert len(links) >= 8
    assert [(str(path), node.name) for path, node in links if undeclared(node, CAR_LINK_PARTS)] == []


def test_a_car_link_that_omits_a_part_is_found():
    tree = ast.parse("class Link(CarLink):\n    @property\n    def signals(self):\n        return ()\n")
    assert undeclared(tree.body[0], CAR_LINK_PARTS) == ["BusMonitor"]
    assert inspect.isabstract(CarLink)
