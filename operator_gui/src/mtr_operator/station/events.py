"""What the thread of the links tells the view."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Any, Mapping, Union

from mtr_operator.domain.ports import CarDimensions, LockState, RobotStatus, Waypoint


@dataclass(frozen=True)
class RobotNews:
    """The newest Status with the Car's locks at its time; only the newest one counts.

    waypoint: where the robot was sent last, None when nowhere. is_secret: the link is encrypted.
    """

    status: RobotStatus
    lock_state: LockState
    car_problem: str
    waypoint: Waypoint | None = None
    is_secret: bool = False


@dataclass(frozen=True)
class Connected:
    """Both links are open."""


@dataclass(frozen=True)
class Refused:
    """A link could not be opened. part: "address", "robot" or "car"."""

    part: str
    text: str


@dataclass(frozen=True)
class CarLinkOpened:
    """Another CAN adapter is in use."""


@dataclass(frozen=True)
class Silence:
    """Nothing has come from the robot for so long in wall time."""

    silent_s: float


@dataclass(frozen=True)
class Planned:
    """The lines are known: so many of them are measured already."""

    done: int
    total: int
    car: CarDimensions | None


@dataclass(frozen=True)
class Acting:
    """The robot begins to do this."""

    text: str


@dataclass(frozen=True)
class Measured:
    """A line was measured: all results so far, and the newest one."""

    results: tuple[Mapping[str, Any], ...]
    newest: Mapping[str, Any]
    done: int
    total: int


class Outcome(enum.Enum):
    """How measuring ended."""

    COMPLETE = "complete"
    STOPPED = "stopped by the Operator"
    FAILED = "failed"
    NOT_SAVED = "not saved"


@dataclass(frozen=True)
class Ended:
    """Measuring has ended. text: why, for a person; empty when it is complete."""

    outcome: Outcome
    text: str
    results: tuple[Mapping[str, Any], ...]


@dataclass(frozen=True)
class Saved:
    """The progress was written on request. text: why not; empty when it was."""

    text: str


News = Union[Connected, Refused, CarLinkOpened, Silence, Planned, Acting, Measured, Ended, Saved]
