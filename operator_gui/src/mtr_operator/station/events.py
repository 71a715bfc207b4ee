"""What the thread of the links reports to the view."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Union

from mtr_operator.domain.eventlog.entry import EventEntry
from mtr_operator.domain.interfaces.car_bus import BusMonitor
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.ports import BusTraffic, CarLink, LockFacts, LockState
from mtr_operator.domain.requests import Waypoint
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.robot_status import CarDimensions, PreflightReport, RobotStatus
from mtr_operator.domain.supervision.car_signals import CarSignal

from .handle_prompt import Prompt

if TYPE_CHECKING:
    from .test import Test


@dataclass(frozen=True)
class RobotSnapshot:
    """The newest Status with the Car's locks at its time; only the newest one counts.

    waypoint: where the robot was sent last, None when nowhere. is_secret: the link is encrypted. traffic: of the Car's
    bus, None where there is no bus to ask. facts: what its profile tells beforehand, None without one.
    is_exposed: whoever is in the robot's network can read the link and send. preflight: the newest that the robot
    has told, None while it has told nothing of it. clock_ahead_s: robot's clock less the laptop's, NaN when not known.
    signals: of the Car that stop the robot, as its profile names them.
    """

    status: RobotStatus
    lock_state: LockState
    car_problem: str
    waypoint: Waypoint | None = None
    is_secret: bool = False
    traffic: BusTraffic | None = None
    facts: LockFacts | None = None
    is_exposed: bool = False
    preflight: PreflightReport | None = None
    clock_ahead_s: float = math.nan
    signals: tuple[CarSignal, ...] = ()


def known_facts(car: CarLink) -> LockFacts | None:
    """What the profile of the Car behind a link tells; None where there is no bus."""
    return None if part(car, BusMonitor).traffic is None else car.facts


@dataclass(frozen=True)
class LinksOpened:
    """Both links are open."""


@dataclass(frozen=True)
class LinkRefused:
    """A link could not be opened. part: "address", "robot" or "car". bus: the Car's further bus for which it failed."""

    part: str
    text: str
    bus: str = ""


@dataclass(frozen=True)
class CarLinkOpened:
    """Another CAN adapter is in use."""


@dataclass(frozen=True)
class RobotSilent:
    """Nothing has come from the robot for so long in wall time."""

    silent_s: float


@dataclass(frozen=True)
class StandstillSeen:
    """The application, or its view, did not run for a while between two tests: the laptop slept, it was stopped, or
    the window hung. text: a sentence that says for how long."""

    text: str


@dataclass(frozen=True)
class LinesPlanned:
    """The lines are known: so many of them are measured already."""

    done: int
    total: int
    car: CarDimensions | None


@dataclass(frozen=True)
class ActionBegun:
    """The robot begins to do this."""

    text: str


@dataclass(frozen=True)
class LineBegun:
    """The line with this number is measured from now on; 0: none is."""

    number: int


@dataclass(frozen=True)
class LineMeasured:
    """A line was measured: all results so far, and the newest one."""

    results: tuple[LineResult, ...]
    newest: LineResult
    done: int
    total: int


class Outcome(enum.Enum):
    """How measuring ended."""

    COMPLETE = "complete"
    STOPPED = "stopped by the Operator"
    FAILED = "failed"
    NOT_SAVED = "not saved"


@dataclass(frozen=True)
class RunEnded:
    """Measuring has ended. text: why, for a person; empty when it is complete."""

    outcome: Outcome
    text: str
    results: tuple[LineResult, ...]


@dataclass(frozen=True)
class ProgressSaved:
    """The progress of a test was written on request. text: why not; empty when it was."""

    test: Test
    text: str


@dataclass(frozen=True)
class PersonWanted:
    """A person has to take the Car's handle or to switch the extender; prompt: None when nobody need do so any more."""

    prompt: Prompt | None


@dataclass(frozen=True)
class PresenceWanted:
    """The Operator has to confirm to be present; is_wanted: False when that need not be done any longer."""

    is_wanted: bool


@dataclass(frozen=True)
class EventLogged:
    """The event list has grown by this."""

    entry: EventEntry


StationEvent = Union[LinksOpened, LinkRefused, CarLinkOpened, RobotSilent, StandstillSeen, LinesPlanned, ActionBegun,
                     LineBegun, LineMeasured, RunEnded, ProgressSaved, PersonWanted, PresenceWanted, EventLogged]
