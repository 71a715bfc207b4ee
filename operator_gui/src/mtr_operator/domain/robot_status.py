"""What the robot reports: one Status message with all its parts.

Poses are of base_link in the Car coordinate system, in m and rad; times are seconds of the robot's clock.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import Iterator

from .geometry.pose import Point, Pose
from .surroundings import Surroundings


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


class EmergencyStop(enum.Enum):
    """The robot's emergency stop, as far as its software sees it."""

    UNKNOWN = 0
    ABSENT = 1
    RELEASED = 2
    ENGAGED = 3


class MotionSource(enum.Enum):
    """Who moves the robot's wheels."""

    UNKNOWN = 0
    NONE = 1
    LOCKED = 2
    MANUAL = 3
    PLANNER = 4


@dataclass(frozen=True)
class Interventions:
    """What happened to the robot beside the Operator's orders: counts that only grow since the robot's start."""

    manual_drives: int = 0
    manual_lifts: int = 0
    replans: int = 0
    blockages: int = 0
    lock_stops: int = 0
    firmware_resets: int = 0
    clock_steps: int = 0


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
class PressReport:
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
    front_sigma, rear_sigma, left_sigma, right_sigma: 1 sigma of where each side is, across itself, of centre and size
    together; NaN when the robot does not say.
    """

    length: float
    width: float
    length_sigma: float
    width_sigma: float
    outline: tuple[tuple[float, float], ...] = ()
    front_sigma: float = math.nan
    rear_sigma: float = math.nan
    left_sigma: float = math.nan
    right_sigma: float = math.nan

    @property
    def side_sigmas(self) -> tuple[float, float, float, float]:
        """Of front, rear, left and right."""
        return self.front_sigma, self.rear_sigma, self.left_sigma, self.right_sigma

    @property
    def knows_sides(self) -> bool:
        """True when the robot says how well it knows each side."""
        return not any(map(math.isnan, self.side_sigmas))


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


# Code of the notification with which no test begins; the measurement itself is on the laptop, so one that runs goes on.
DISK_FULL_CODE = "disk_full"
# Code of the notification with which no test begins: the scans contradict the Car's data sheet.
SHEET_CONTRADICTED_CODE = "sheet_contradicted"
# Code of the notification of a real robot that has no emergency stop by hand; a simulated one does not send it.
NO_STOP_CODE = "no_emergency_stop"
# The robot is in service mode.
SERVICE_CODE = "service_mode"
# The application in control has fallen silent.
LINK_LOST_CODE = "link_lost"


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


# A Status is stamped before what it says of a preflight is known.
_PREFLIGHT_SLACK_S = 1.0
# A working day: cables, mounts and clocks were touched since.
PREFLIGHT_VALID_S = 12.0 * 3600.0


@dataclass(frozen=True)
class PreflightItem:
    """One thing that a preflight looked at, and a sentence of it. is_bad: the robot shall not be used like that."""

    name: str
    is_bad: bool
    sentence: str

    @property
    def text(self) -> str:
        """The sentence with what was looked at."""
        return f"{self.name}: {self.sentence}"


@dataclass(frozen=True)
class PreflightReport:
    """The last preflight of this run of the robot: `rosrun mtr_commissioning preflight`, made by whoever sets it up.

    made_s: when it ended, on the robot's steady clock; NaN: none was made. items: what is wrong first, of checks in
    all; bad: how many of them found something wrong. motion_made_s: when sensors were compared in motion last, on the
    same clock; NaN: never.
    """

    made_s: float = math.nan
    items: tuple[PreflightItem, ...] = ()
    checks: int = 0
    bad: int = 0
    motion_made_s: float = math.nan

    def was_made_before(self, steady_s: float) -> bool:
        """False before one was made, and for one of another run of a simulated clock."""
        return _is_before(self.made_s, steady_s)

    def was_in_motion(self, steady_s: float) -> bool:
        """True when sensors were compared in motion, in this run of the robot's clock."""
        return _is_before(self.motion_made_s, steady_s)

    @property
    def oldest_s(self) -> float:
        """When the older of its two parts was made, at rest and in motion; NaN unless both were."""
        return math.nan if math.isnan(self.made_s) or math.isnan(self.motion_made_s) else min(self.made_s,
                                                                                              self.motion_made_s)

    def hinders(self, steady_s: float) -> bool:
        """True when no test may begin: something is wrong with the robot as it runs."""
        return self.bad > 0 and self.was_made_before(steady_s)

    @property
    def first_bad(self) -> str:
        """The first sentence of what is wrong, with what was looked at; empty when nothing is."""
        return next((item.text for item in self.items if item.is_bad), "")


def _is_before(made_s: float, steady_s: float) -> bool:
    return not math.isnan(made_s) and not made_s > steady_s + _PREFLIGHT_SLACK_S


@dataclass(frozen=True)
class AreaState:
    """What the robot reports of its test area.

    required: without one it neither maps nor tests. is_fixed: its launch file has set it. corners: in force, empty
    without one; area_id: 0 when another session has set them. area_origin_id, origin_id: origins of the start frame to
    which corners and poses refer. robot, car: in the start frame, None while unknown. problems: why it neither maps nor
    tests, outermost first.
    """

    required: bool = False
    is_fixed: bool = False
    area_id: int = 0
    area_origin_id: int = 0
    corners: tuple[Point, ...] = ()
    origin_id: int = 0
    robot: Pose | None = None
    car: Pose | None = None
    problems: tuple[Problem, ...] = ()

    @property
    def is_in_force(self) -> bool:
        """True when the robot keeps inside an area, with a position in it."""
        return bool(self.corners) and self.area_origin_id == self.origin_id

    def corners_at_car(self) -> tuple[Point, ...]:
        """Corners in the Car coordinate system; none before the Car is mapped, or of another origin."""
        car = self.car
        return tuple(map(car.to_source, self.corners)) if car is not None and self.is_in_force else ()


@dataclass(frozen=True)
class ServiceState:
    """Service mode: people work on the robot, and its wheels, lift and servos are disabled.

    agreement_id: what the Operator can release now, 0 outside service mode. robot_agrees_s, operator_agrees_s: s for
    which each release still counts, NaN without one. problems: why it is active, outermost first.
    """

    is_active: bool = False
    agreement_id: int = 0
    robot_agrees_s: float = math.nan
    operator_agrees_s: float = math.nan
    problems: tuple[Problem, ...] = ()

    @property
    def text(self) -> str:
        """The robot's sentence; empty outside service mode."""
        return self.problems[0].text if self.problems else ""


@dataclass(frozen=True)
class RobotStatus:
    """One Status message. NaN or None where the robot did not say.

    stamp_s: the time of the pose while it is valid, else of sending. sent_s: of sending, on the robot's clock.
    steady_s: the same instant on the robot's steady clock, which nobody sets.
    controlled_by_other: another application has the robot; the confirmations are absent then.
    car_check: None for a robot that cannot check the Car's frame.
    controller_name: owner of the key whose Commands the robot obeys; empty on a link that is not encrypted.
    simulated: a robot of before does not say it, and counts as a real one. area, service: None of a robot of before.
    surroundings, preflight: None in most Statuses, and of a robot of before.
    waits_for_answer: of a simulated robot: its time stands still until this Status is answered.
    hold_id: not 0: the robot stands until the Operator has it go on, see requests.DesiredState.resume_hold_id.
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
    presses: tuple[PressReport, ...] = ()
    map_car_id: int = 0
    log: tuple[LogMessage, ...] = ()
    notifications: tuple[Notification, ...] = ()
    rejected_messages: int = 0
    software_version: str = ""
    sent_s: float = math.nan
    steady_s: float = math.nan
    interventions: Interventions = Interventions()
    emergency_stop: EmergencyStop = EmergencyStop.UNKNOWN
    motion_source: MotionSource = MotionSource.UNKNOWN
    hold_id: int = 0
    controller_name: str = ""
    surroundings: Surroundings | None = None
    preflight: PreflightReport | None = None
    waits_for_answer: bool = False
    simulated: bool = False
    area: AreaState | None = None
    service: ServiceState | None = None

    @property
    def is_in_service(self) -> bool:
        """Wheels, lift and servos are disabled, and no test begins or continues."""
        return self.service is not None and self.service.is_active

    @property
    def is_abandoned(self) -> bool:
        """Another application controls the robot and has fallen silent; the next order of any other takes over."""
        return self.controlled_by_other and any(each.code == LINK_LOST_CODE for each in self.notifications)

    @property
    def key_place(self) -> Point:
        """The Remote key in the Car coordinate system, while the pose is valid."""
        return Pose(self.x, self.y, self.heading).apply((self.key_x, self.key_y))

    def problems(self) -> Iterator[tuple[Problem, ...]]:
        """Every sentence of this Status with its causes, as far as the robot gives codes."""
        yield self.waypoint_problems
        yield from (notification.problems for notification in self.notifications)
        yield from (press.problems for press in self.presses)
        if self.area is not None:
            yield self.area.problems
        if self.service is not None:
            yield self.service.problems
        if self.car_check is not None:
            yield self.car_check.problems
