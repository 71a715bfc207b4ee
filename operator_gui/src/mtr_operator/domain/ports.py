"""What the scenarios' runner needs from the outside: a link to the robot and a link to the Car.

The application is driven by Status messages: the runner takes the next Status, reads the Car's events up to its time,
lets the scenario decide, and sends the desired state back as the answer to that Status. Nothing else makes a decision,
so that the order of events is that of the robot's clock and not of threads and sockets.

All times are seconds of the robot's clock; poses are of base_link in the Car coordinate system, in metres and radians.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field

from .requests import DesiredState
from .results.refused import Refused
from .robot_status import RobotStatus


class LockState(enum.Enum):
    """State of the Car's locks."""

    UNKNOWN = "unknown"
    LOCKED = "locked"
    UNLOCKED = "unlocked"


# What made the Car lock or unlock: the key's vicinity, one of its buttons, or a hand at a handle with the key near.
PASSIVE_ENTRY = "passive_entry"
KEY_BUTTON = "key_button"
HANDLE = "handle"


@dataclass(frozen=True)
class CarEvent:
    """The Car's locks changed.

    time_s: robot's clock; time_sigma_s: 1 sigma of that time. source: PASSIVE_ENTRY, KEY_BUTTON or HANDLE, empty when
    the Car's bus does not say it. doubt: why it is not to be believed, or what else on the bus is not; empty when it
    is. evidence: the frames around it, one text each. cause_raw: signal and value that tell a source which the Car's
    profile does not list. key_number: of the key that moved them, None when it is not told. doors: that are unlocked
    when not all are; empty else.
    """

    time_s: float
    time_sigma_s: float
    lock_state: LockState
    source: str = ""
    doubt: str = ""
    evidence: tuple[str, ...] = ()
    cause_raw: str = ""
    key_number: int | None = None
    doors: str = ""


@dataclass(frozen=True)
class LockFacts:
    """What is known of a car beforehand.

    sources: those that its bus can name; empty when it names none. relock_after_s: it locks by itself so long after it
    was unlocked, None when it does not. confirm_s: a change is to be believed when it was not taken back for so long.
    told_every_s: cycle of the message that tells a change, 0 when it is told at once. settles_s: how long after a
    change all is known of it, so that it is told so late. needs_source: a change without a known source counts for
    nothing.
    """

    sources: frozenset[str] = frozenset()
    relock_after_s: float | None = None
    confirm_s: float = 0.0
    told_every_s: float = 0.0
    settles_s: float = 0.0
    needs_source: bool = False


@dataclass(frozen=True)
class BusTraffic:
    """What comes over the Car's bus now.

    load: part of the bits that carry frames, without stuffed bits, 0 to 1. cycle_s: of the lock message, None when
    fewer than two have come; expected_cycle_s: by the car's profile. clock_problem: why the time of frames is not known
    on the robot's clock; empty when it is. stamps: by which clock frames are timed; empty before the first.
    """

    load: float
    cycle_s: float | None
    expected_cycle_s: float
    clock_problem: str = ""
    stamps: str = ""


@dataclass(frozen=True)
class BusMark:
    """How far the log of the bus had come when the newest Status was observed, so that it can be played back.

    frames: in the log when it arrived; released: when its events were told. arrival_s, told_s: the same by the laptop's
    monotonic clock. origin_s: time of the first frame by the clock that times the frames, NaN before it. stamps: that
    clock, as BusTraffic has it. restarts: how often the adapter was opened anew.
    """

    frames: int = 0
    released: int = 0
    arrival_s: float = math.nan
    told_s: float = math.nan
    origin_s: float = math.nan
    stamps: str = ""
    restarts: int = 0


@dataclass(frozen=True)
class BusMessage:
    """One message of the Car's bus as it came last.

    name: by the car's database, empty where it has none. count: frames since the connection. cycle_s: mean of the
    newest ones, None before the second. age_s: of the newest one, by the laptop's clock; data: its bytes.
    """

    can_id: int
    is_extended: bool
    name: str
    count: int
    cycle_s: float | None
    age_s: float
    data: bytes


@dataclass(frozen=True)
class BusMessages:
    """What has come over the Car's bus, by identifier. others: frames of messages beyond those that are kept."""

    messages: tuple[BusMessage, ...] = ()
    others: int = 0


@dataclass
class LinkStatistics:
    """Counts since the connection was made. implausible: messages with a number beyond domain.limits, not used."""

    received: int = 0
    undecodable: int = 0
    oversized: int = 0
    lost: int = 0
    last_error: str = field(default="")
    implausible: int = 0

    @property
    def ignored(self) -> int:
        """Messages that were not used."""
        return self.undecodable + self.oversized + self.implausible

    @property
    def refused(self) -> Refused:
        """The same with the last sentence."""
        return Refused(self.ignored, self.last_error)


class RobotLink(ABC):
    """Connection to the robot (or its substitute)."""

    statistics: LinkStatistics

    @property
    def is_secret(self) -> bool:
        """True when the link is encrypted."""
        return False

    @property
    def is_exposed(self) -> bool:
        """True when whoever is in the robot's network can read the link and send: not encrypted, and not within this
        computer."""
        return False

    @abstractmethod
    def connect(self) -> None:
        """Connect, or raise errors.ConnectionFailed with a sentence that says which address or port is wrong."""

    @abstractmethod
    def next_status(self, timeout_s: float) -> RobotStatus | None:
        """The next Status in order, None when none came within timeout_s of wall time."""

    @abstractmethod
    def send(self, desired: DesiredState) -> None:
        """Send the desired state as the answer to the newest Status taken by next_status.

        A changed content gets a new id; calling it again with an equal one sends it again with the same id.
        """

    def watch(self) -> None:
        """Answer the newest Status without an order and without a claim to control the robot.

        A robot that knows one application only makes no difference.
        """
        self.send(DesiredState())

    def is_answered(self, status: RobotStatus) -> bool:
        """True when the robot had received the last order before it sent this Status; always so without delay."""
        return True

    @abstractmethod
    def close(self) -> None:
        """Say goodbye (the robot stops), unless nothing was ever sent, and disconnect; safe to call twice."""


class CarLink(ABC):
    """Connection to the Car's locks by its CAN bus (or its substitute); interfaces.car_bus has what else a link may
    offer."""

    @abstractmethod
    def connect(self) -> None:
        """Connect, or raise errors.ConnectionFailed with a sentence on what is wrong with adapter or database."""

    @abstractmethod
    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """Map clocks with this Status; return the events not later than its stamp that were not returned before.

        It waits a bounded wall time for the bus to catch up with the stamp, so that an event that precedes the Status
        is never missed. Events come in order of time.
        """

    @property
    @abstractmethod
    def lock_state(self) -> LockState:
        """Lock state at the stamp of the last observed Status; UNKNOWN while the bus is silent or in error."""

    @property
    def facts(self) -> LockFacts:
        """What is known of this car beforehand."""
        return LockFacts()

    @property
    @abstractmethod
    def problem(self) -> str:
        """Empty when the bus is healthy; else one sentence (silent, bus-off, error frames, clock not mapped yet)."""

    @abstractmethod
    def close(self) -> None:
        """Disconnect; safe to call twice."""
