"""Plan of a campaign: the simulated tests, read from a small YAML file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass
from typing import Any, Callable, Iterator, Mapping

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.plain_yaml import BadYaml, load_yaml

from ..errors import CampaignError
from . import designs
from .factors import Factor, count_text, factor_from, is_number, is_single, short
from .run import Run, Value

# With the radio kernel, this number of runs lasts a day on several cores; each run is a row in the store.
MAX_RUNS = 100_000
# Upper limit of the random generators of the designs.
_MAX_SEED = 2 ** 32 - 1
GRID, LATIN_HYPERCUBE, SOBOL, OPTIMISE = "grid", "latin_hypercube", "sobol", "optimise"
_DESIGN_ENTRIES: dict[str, dict[str, type]] = {
    GRID: {}, LATIN_HYPERCUBE: {"runs": int, "seed": int}, SOBOL: {"samples": int, "seed": int},
    OPTIMISE: {"runs": int, "seed": int, "figure": str, "aim": str, "wanted": float}}
_KINDS: dict[type, tuple[str, Callable[[Any], bool]]] = {
    int: ("a whole number", lambda value: isinstance(value, int) and not isinstance(value, bool)),
    float: ("a number", is_number), str: ("a text", lambda value: isinstance(value, str))}
_AIMS = ("minimise", "maximise", "wanted")
_ENTRIES = ("name", "kernel", "scenario", "design", "set", "vary")
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")


@dataclass(frozen=True)
class Design:
    """Design of experiments.

    Attributes:
        runs: of a Latin hypercube or an optimisation; samples: for Sobol indices, a power of two. figure, aim, wanted:
            optimised quantity, direction of the optimisation, and target value.
    """

    kind: str = GRID
    runs: int = 0
    samples: int = 0
    seed: int = 1
    figure: str = ""
    aim: str = "minimise"
    wanted: float = 0.0


@dataclass(frozen=True)
class Plan:
    """Attributes: name: of the campaign, also in the store. fixed: settings of all runs. factors: varied settings."""

    name: str
    kernel: str
    scenario: str
    fixed: Mapping[str, Value]
    factors: Mapping[str, Factor]
    design: Design

    @property
    def size(self) -> int:
        """Number of runs; CampaignError above the limit."""
        design = self.design
        size = design.runs
        if design.kind == GRID:
            size = designs.grid_size(self.factors)
        elif design.kind == SOBOL:
            size = designs.sobol_size(self.factors, design.samples)
        if not 1 <= size <= MAX_RUNS:
            raise CampaignError(f"The plan {self.name} asks for {count_text(size)} runs; allowed are 1 to {MAX_RUNS}. "
                                "Vary less, or take a latin_hypercube with fewer runs.")
        return size

    def run(self, settings: Mapping[str, Value]) -> Run:
        """Return a run with these and the fixed settings."""
        return Run(self.kernel, self.scenario, {**self.fixed, **settings})

    def runs(self) -> Iterator[Run]:
        """Yield all runs, except for an optimisation, whose runs depend on previous results."""
        design = self.design
        makers: dict[str, Callable[[], Iterator[dict[str, Value]]]] = {
            GRID: lambda: designs.grid(self.factors),
            LATIN_HYPERCUBE: lambda: designs.latin_hypercube(self.factors, design.runs, design.seed),
            SOBOL: lambda: designs.sobol(self.factors, design.samples, design.seed)}
        yield from map(self.run, makers[design.kind]())

    def borders(self) -> Iterator[Run]:
        """Yield runs with each factor at its ends, for the validation of a plan."""
        middle = {name: factor.at(0.5) for name, factor in self.factors.items()}
        yield self.run(middle)
        for name, factor in self.factors.items():
            yield from (self.run({**middle, name: value}) for value in factor.ends())


def load_plan(path: pathlib.Path) -> Plan:
    """Read a plan from a file; CampaignError describes the error."""
    try:
        content = load_yaml(path)
    except OSError as error:
        raise CampaignError(f"The plan {path} cannot be read: {error.strerror or error}.") from None
    except BadYaml as error:
        raise CampaignError(f"The plan {path} {error}.") from None
    try:
        return plan_from(content, path.stem)
    except CampaignError as error:
        raise CampaignError(f"Plan {path}: {error}") from None


def plan_from(content: Any, usual_name: str) -> Plan:
    """Convert the content of a plan file."""
    if not isinstance(content, dict):
        raise CampaignError("It has to consist of lines of the form 'entry: value'.")
    unknown = sorted(str(name) for name in set(content) - set(_ENTRIES))
    if unknown:
        raise CampaignError(f"Entry {unknown[0]:.60} is unknown; allowed are {', '.join(_ENTRIES)}.")
    name = content.get("name", usual_name)
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise CampaignError(f"name is {short(name)}; allowed are up to 64 letters, digits, dots and dashes.")
    kernel, scenario = content.get("kernel", "radio"), content.get("scenario")
    if scenario not in SCENARIOS:
        raise CampaignError(f"scenario is {short(scenario)}; allowed is {', '.join(SCENARIOS)}.")
    fixed = {str(key): _value(str(key), value) for key, value in _table(content, "set").items()}
    factors = {str(key): factor_from(str(key), value) for key, value in _table(content, "vary").items()}
    both = sorted(set(fixed) & set(factors))
    if both:
        raise CampaignError(f"{both[0]:.60} is under set and under vary; it can stand under one of them.")
    plan = Plan(name, str(kernel), scenario, fixed, factors, _design(_table(content, "design")))
    if not factors and plan.design.kind != GRID:
        raise CampaignError(f"The design {plan.design.kind} needs something under vary.")
    _ = plan.size
    return plan


def _design(content: Mapping[str, Any]) -> Design:
    given = dict(content)
    kind = given.pop("kind", GRID)
    if kind not in _DESIGN_ENTRIES:
        raise CampaignError(f"The design is {short(kind)}; allowed is {', '.join(_DESIGN_ENTRIES)}.")
    entries = _DESIGN_ENTRIES[kind]
    for name, value in given.items():
        if name not in entries:
            raise CampaignError(f"Entry {name!s:.60} of the design {kind} is unknown; allowed are "
                                f"{', '.join(['kind', *entries])}.")
        allowed, is_right = _KINDS[entries[name]]
        if not is_right(value):
            raise CampaignError(f"Entry {name} of the design is {short(value)}; allowed is {allowed}.")
    design = Design(kind, **given)
    if not 0 <= design.seed <= _MAX_SEED:
        raise CampaignError(f"seed of the design is {short(design.seed)}; allowed is 0 to {_MAX_SEED}.")
    if kind == SOBOL and (design.samples < 2 or design.samples & (design.samples - 1)):
        raise CampaignError(f"samples is {design.samples}; allowed is a power of two, as 64.")
    if kind == OPTIMISE and (design.aim not in _AIMS or not design.figure):
        raise CampaignError(f"An optimisation needs a figure, and as aim one of {', '.join(_AIMS)}.")
    return design


def _table(content: Mapping[str, Any], name: str) -> Mapping[Any, Any]:
    table = content.get(name) or {}
    if not isinstance(table, dict):
        raise CampaignError(f"{name} is {short(table)}; allowed is a table of names and values.")
    return table


def _value(name: str, value: Any) -> Value:
    if is_single(value) or (isinstance(value, list) and value and all(map(is_single, value))):
        return value  # type: ignore[no-any-return]  # a list is what some parameters are
    raise CampaignError(f"{name:.60} is {short(value)}; allowed is a number, a text, true or false.")
