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
from typing import Iterator


class Direction(enum.Enum):
    """Direction of travel on the last straight piece before a waypoint."""

    ANY = 0
    FORWARD = 1
    BACKWARD = 2


class Mode(enum.Enum):
    """High-level state of the robot."""

    UNKNOWN = 0
    STARTING = 1
    READY_TO_MAP_CAR = 2
    MAPPING_CAR = 3
    FOLLOWING_WAYPOINT = 4
    FAULT = 5
    CHECKING_CAR = 6


class WaypointResult(enum.Enum):
    """What the robot says of the newest waypoint."""

    NONE = 0
    PENDING = 1
    REACHED = 2
    REFUSED = 3
    BLOCKED = 4


class CheckState(enum.Enum):
    """How a self-check of the Car's frame stands."""

    NONE = 0
    RUNNING = 1
    PASSED = 2
    FAILED = 3


class LockState(enum.Enum):
    """State of the Car's locks."""

    UNKNOWN = "unknown"
    LOCKED = "locked"
    UNLOCKED = "unlocked"


# What made the Car lock or unlock: the key's vicinity, or one of its buttons.
PASSIVE_ENTRY = "passive_entry"
KEY_BUTTON = "key_button"


@dataclass(frozen=True)
class Waypoint:
    """A pose of base_link to reach; id is unique within the session and never 0."""

    id: int
    x: float
    y: float
    heading: float
    direction: Direction = Direction.ANY


@dataclass(frozen=True)
class Press:
    """A press of one or more key buttons (1 lock, 2 unlock); strength 0 to 1, duration in s."""

    id: int
    buttons: tuple[int, ...]
    strength: float
    duration_s: float


@dataclass(frozen=True)
class DesiredState:
    """The whole desired final state of the robot. Immutable: a change is a new object with a new id."""

    stop: bool = False
    waypoint: Waypoint | None = None
    max_speed_mps: float | None = None
    key_height_m: float | None = None
    press: Press | None = None
    map_car_id: int = 0
    check_car_id: int = 0


@dataclass(frozen=True)
class Problem:
    """One sentence of the robot, by which it can be translated. In a list each is followed by its cause, whose text
    stands within its own.

    Attributes:
        code: stable word "package.what"; empty when the robot gives only the text.
        arguments: name and value of each placeholder, as in the text.
        text: the sentence in English.
    """

    code: str
    arguments: tuple[tuple[str, str], ...]
    text: str


@dataclass(frozen=True)
class PressConfirmation:
    """One press as executed; error is empty when it was. problems: the error with its causes."""

    id: int
    start_s: float
    end_s: float
    error: str = ""
    problems: tuple[Problem, ...] = ()


@dataclass(frozen=True)
class CarDimensions:
    """Length and width of the Car as the robot measured them, with 1 sigma, in m.

    outline: counterclockwise polygon in the Car coordinate system, m; empty when the robot does not say.
    """

    length: float
    width: float
    length_sigma: float
    width_sigma: float
    outline: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class CarFrame:
    """The Car coordinate system that poses are in.

    revision: counts the frames since the robot's start, 0 when the robot does not say.
    correction: where this frame lies in the one before, m and rad; zeros for the first after a mapping.
    """

    revision: int = 0
    correction_x: float = 0.0
    correction_y: float = 0.0
    correction_heading: float = 0.0


@dataclass(frozen=True)
class CarCheck:
    """The Car seen anew, compared with where it was; NaN while unknown.

    id: the request that it answers, 0 for none. problems: the message with its causes.
    """

    id: int = 0
    state: CheckState = CheckState.NONE
    difference_m: float = math.nan
    difference_rad: float = math.nan
    limit_m: float = math.nan
    limit_rad: float = math.nan
    message: str = ""
    problems: tuple[Problem, ...] = ()


@dataclass(frozen=True)
class Notification:
    """A sentence that concerns the Operator now.

    code: kind of notification. severity: 1 info, 2 warning, 3 error. problems: the text with its causes.
    """

    code: str
    severity: int
    text: str
    problems: tuple[Problem, ...] = ()


@dataclass(frozen=True)
class LogMessage:
    """A sentence of the robot's log; id tells repetitions."""

    id: int
    stamp_s: float
    severity: int
    source: str
    text: str


@dataclass(frozen=True)
class RobotStatus:
    """One Status message. NaN or None where the robot did not say.

    controlled_by_other: another application has the robot; the confirmations are absent then.
    car_check: None for a robot that cannot check the Car's frame.
    """

    id: int
    robot_session_id: int
    stamp_s: float
    x: float = math.nan
    y: float = math.nan
    heading: float = math.nan
    speed_mps: float = 0.0
    yaw_rate_radps: float = 0.0
    pose_valid: bool = False
    position_sigma_m: float = math.nan
    variance_x_m2: float = math.nan
    variance_y_m2: float = math.nan
    covariance_xy_m2: float = math.nan
    heading_sigma_rad: float = math.nan
    key_x: float = 0.0
    key_y: float = 0.0
    key_height_m: float = math.nan
    pressed_buttons: tuple[int, ...] = ()
    localization_accuracy_cm: int | None = None
    battery_percent: int | None = None
    is_mapping_car: bool = False
    mode: Mode = Mode.UNKNOWN
    car: CarDimensions | None = None
    car_frame: CarFrame = CarFrame()
    car_check: CarCheck | None = None
    session_id: int = 0
    controlled_by_other: bool = False
    command_id: int = 0
    waypoint_id: int = 0
    waypoint_result: WaypointResult = WaypointResult.NONE
    waypoint_message: str = ""
    waypoint_problems: tuple[Problem, ...] = ()
    presses: tuple[PressConfirmation, ...] = ()
    map_car_id: int = 0
    log: tuple[LogMessage, ...] = ()
    notifications: tuple[Notification, ...] = ()
    rejected_messages: int = 0
    software_version: str = ""

    def problems(self) -> Iterator[tuple[Problem, ...]]:
        """Every sentence of this Status with its causes, as far as the robot gives codes."""
        yield self.waypoint_problems
        yield from (notification.problems for notification in self.notifications)
        yield from (press.problems for press in self.presses)
        if self.car_check is not None:
            yield self.car_check.problems


@dataclass(frozen=True)
class CarEvent:
    """The Car's locks changed.

    time_s: robot's clock; time_sigma_s: 1 sigma of that time. source: PASSIVE_ENTRY or KEY_BUTTON, empty when the
    Car's bus does not say it.
    """

    time_s: float
    time_sigma_s: float
    lock_state: LockState
    source: str = ""


@dataclass
class LinkStatistics:
    """Counts since the connection was made."""

    received: int = 0
    undecodable: int = 0
    oversized: int = 0
    lost: int = 0
    last_error: str = field(default="")


class RobotLink(ABC):
    """Connection to the robot (or its substitute)."""

    statistics: LinkStatistics

    @property
    def is_secret(self) -> bool:
        """True when the link is encrypted."""
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

    @abstractmethod
    def close(self) -> None:
        """Say goodbye (the robot stops) and disconnect; safe to call twice."""


class CarLink(ABC):
    """Connection to the Car's CAN bus (or its substitute)."""

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
    @abstractmethod
    def problem(self) -> str:
        """Empty when the bus is healthy; else one sentence (silent, bus-off, error frames, clock not mapped yet)."""

    @abstractmethod
    def close(self) -> None:
        """Disconnect; safe to call twice."""
