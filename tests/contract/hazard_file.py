"""Content of the hazard file as plain data. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Tuple

import yaml

TOP = pathlib.Path(__file__).resolve().parents[2]
FILE = TOP / "docs" / "safety" / "hazards.yaml"
ACTIONS = ("velocity", "lock", "lift", "press", "resume", "map", "can_output")
KINDS = ("missing", "provided", "early", "late", "too_long", "too_short")
HARDWARE, SOFTWARE, SITE, PROCEDURE = "hardware", "software", "site", "procedure"
TYPES = (HARDWARE, SOFTWARE, SITE, PROCEDURE)
DONE, OPEN = "done", "open"
NONE, SIMULATED, BENCH, ROBOT = "none", "simulated", "bench", "robot"
EVIDENCE = (NONE, SIMULATED, BENCH, ROBOT)
SITES = ("attended", "shared", "unattended")
LEVELS = ("a", "b", "c", "d", "e")
ALL = "all"


@dataclass(frozen=True)
class Risk:
    """Severity, exposure and avoidance of ISO 13849-1, each 1 or 2."""

    severity: int
    exposure: int
    avoidance: int

    @property
    def level(self) -> str:
        """Required performance level by the risk graph."""
        worse = (self.severity - 1) * 2 + (self.exposure - 1) + (self.avoidance - 1)
        return LEVELS[worse]

    def __str__(self) -> str:
        return f"{self.severity}/{self.exposure}/{self.avoidance}"


@dataclass(frozen=True)
class Residual:
    """Risk that remains. sites: kinds of site that it is acceptable for; none without accepted_by where it is d."""

    risk: Risk
    accepted_by: Optional[str]
    sites: Tuple[str, ...]
    reason: str = ""


@dataclass(frozen=True)
class Control:
    """An unsafe control action: an action of `ACTIONS`, how it is unsafe (`KINDS`), and when."""

    action: str
    kind: str
    when: str


@dataclass(frozen=True)
class Measure:
    """A measure against a hazard.

    Attributes:
        what: the measure in one sentence.
        where: package, file of a package, `checklist:ITEM` or `page:HEADING`; empty for hardware and site.
        parameters: name and default value in the code.
    """

    id: str
    type: str
    what: str
    status: str
    where: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    proofs: Tuple[str, ...] = ()

    @property
    def is_proved(self) -> bool:
        """True for a proof of what the robot does; a checklist item proves only that it is shown."""
        return self.status == DONE and self.type in (HARDWARE, SOFTWARE) and bool(self.proofs)


@dataclass(frozen=True)
class Hazard:
    """One hazard with its measures; risk: before measures, at an attended site."""

    id: str
    title: str
    losses: Tuple[str, ...]
    controls: Tuple[Control, ...]
    causes: Tuple[str, ...]
    risk: Risk
    functions: Tuple[str, ...]
    measures: Tuple[Measure, ...]
    left: str
    residual: Residual
    evidence: str
    faults: Mapping[str, Any] = field(default_factory=dict)
    problems: Tuple[str, ...] = ()

    @property
    def is_proved(self) -> bool:
        """True when at least one measure has a proof."""
        return any(measure.is_proved for measure in self.measures)


@dataclass(frozen=True)
class HazardFile:
    """The whole file; odd: operating conditions by name; not_hazardous: entries with a reason."""

    version: int
    odd: Mapping[str, Mapping[str, Any]]
    losses: Mapping[str, str]
    functions: Mapping[str, Mapping[str, Any]]
    hazards: Tuple[Hazard, ...]
    not_hazardous: Tuple[Mapping[str, Any], ...]


def read(path: pathlib.Path = FILE) -> HazardFile:
    """Return the content of the file; TypeError or KeyError where an entry is incomplete or unknown."""
    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    document["hazards"] = tuple(_hazard(dict(entry)) for entry in document["hazards"])
    document["not_hazardous"] = tuple(document["not_hazardous"])
    return HazardFile(**document)


def _hazard(entry: Dict[str, Any]) -> Hazard:
    residual = dict(entry.pop("residual"))
    rest = Residual(Risk(*(residual.pop(name) for name in ("severity", "exposure", "avoidance"))),
                    sites=tuple(residual.pop("sites")), **residual)
    lists = {name: tuple(entry.pop(name, ())) for name in ("losses", "causes", "functions", "problems")}
    return Hazard(controls=tuple(Control(**each) for each in entry.pop("unsafe_control")),
                  risk=Risk(**entry.pop("risk")), residual=rest,
                  measures=tuple(_measure(dict(each)) for each in entry.pop("measures")), **lists, **entry)


def _measure(entry: Dict[str, Any]) -> Measure:
    return Measure(proofs=tuple(entry.pop("proofs", ())), **entry)


def measures(file: HazardFile) -> List[Measure]:
    """All measures in their order."""
    return [measure for hazard in file.hazards for measure in hazard.measures]
