"""Events from the thread of the links to the view."""
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
    """Newest Status with the Car's locks at its time; only the newest one counts.

    waypoint: latest destination of the robot, None without one. is_secret: the link is encrypted. traffic: of the Car's
    bus, None without a bus. facts: from its profile, None without one.
    is_exposed: any computer in the robot's network can read the link and send. preflight: the newest report, None
    before one. clock_ahead_s: robot's clock less the laptop's, NaN if unknown.
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
    """Return the facts in the profile of the Car behind a link; None without a bus."""
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
    """The robot has been silent for this wall time."""

    silent_s: float


@dataclass(frozen=True)
class StandstillSeen:
    """The application, or its view, did not run for some time between two tests: the laptop slept, it was stopped, or
    the window hung. text: a sentence with the duration."""

    text: str


@dataclass(frozen=True)
class LinesPlanned:
    """The lines are known; some of them are already measured."""

    done: int
    total: int
    car: CarDimensions | None


@dataclass(frozen=True)
class ActionBegun:
    """The robot starts this action."""

    text: str


@dataclass(frozen=True)
class LineBegun:
    """The line with this number is measured from now on; 0 for none."""

    number: int


@dataclass(frozen=True)
class LineMeasured:
    """A line was measured: all results so far, and the newest one."""

    results: tuple[LineResult, ...]
    newest: LineResult
    done: int
    total: int


class Outcome(enum.Enum):
    """End of measuring."""

    COMPLETE = "complete"
    STOPPED = "stopped by the Operator"
    FAILED = "failed"
    NOT_SAVED = "not saved"


@dataclass(frozen=True)
class RunEnded:
    """Measuring has ended. text: reason for a person; empty if it is complete."""

    outcome: Outcome
    text: str
    results: tuple[LineResult, ...]


@dataclass(frozen=True)
class ProgressSaved:
    """The progress of a test was written on request. text: reason of a failure; empty on success."""

    test: Test
    text: str


@dataclass(frozen=True)
class PersonWanted:
    """A person must pull the Car's handle or switch the extender; prompt: None if that is no longer needed."""

    prompt: Prompt | None


@dataclass(frozen=True)
class PresenceWanted:
    """The Operator must confirm presence; is_wanted: False if that is no longer needed."""

    is_wanted: bool


@dataclass(frozen=True)
class EventLogged:
    """An event was added to the list."""

    entry: EventEntry


StationEvent = Union[LinksOpened, LinkRefused, CarLinkOpened, RobotSilent, StandstillSeen, LinesPlanned, ActionBegun,
                     LineBegun, LineMeasured, RunEnded, ProgressSaved, PersonWanted, PresenceWanted, EventLogged]
