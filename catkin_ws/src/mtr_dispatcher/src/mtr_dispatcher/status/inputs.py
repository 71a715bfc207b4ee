"""What the dispatcher knows of the robot when it writes a Status: the fields that it reads of the nodes' messages."""
# SPDX-License-Identifier: Apache-2.0
from types import MappingProxyType
from typing import Any, Mapping, NamedTuple, Optional, Protocol, Sequence

from mtr_core.problems import ProblemFields

from ..disks.watch import FullDisk
from ..preflight_report import PreflightReport
from .emergency import EmergencyStop
from .surroundings import Surroundings

# Age at which a periodic message no longer tells the present.
STALE_AFTER_S = 0.5


class Stamped(Protocol):
    """A message with a std_msgs/Header."""

    header: Any


class PoseFields(Stamped, Protocol):
    """Of LocalizedPose: base_link in map, m and rad, and its motion."""

    valid: bool
    x: float
    y: float
    heading: float
    covariance: Sequence[float]
    speed_mps: float
    yaw_rate_radps: float
    map_revision: int
    origin_id: int
    message: str
    problems: Sequence[ProblemFields]


class CarFields(Stamped, Protocol):
    """Of CarEstimate: the Car in map and its size, m and rad."""

    state: int
    x: float
    y: float
    heading: float
    covariance: Sequence[float]
    length: float
    width: float
    length_sigma: float
    width_sigma: float
    front_sigma: float
    rear_sigma: float
    left_sigma: float
    right_sigma: float
    outline_x: Sequence[float]
    outline_y: Sequence[float]
    map_car_id: int
    revision: int
    correction_x: float
    correction_y: float
    correction_heading: float
    message: str
    problems: Sequence[ProblemFields]


class ModeFields(Stamped, Protocol):
    """Of RobotMode: the state, and what became of the Operator's waypoint."""

    mode: int
    mapping: bool
    map_car_id: int
    session_id: int
    waypoint_id: int
    waypoint_result: int
    message: str
    problems: Sequence[ProblemFields]
    hold_id: int


class PressFields(Protocol):
    """Of PressReport: one press as it went; times of the robot's clock."""

    session_id: int
    id: int
    start: Any
    end: Any
    error: str
    problems: Sequence[ProblemFields]


class PeripheralsFields(Stamped, Protocol):
    """Of PeripheralsState: key, buttons and battery."""

    alive: bool
    key_height_m: float
    pressed_buttons: Sequence[int]
    presses: Sequence[PressFields]
    battery: float
    message: str
    problems: Sequence[ProblemFields]
    manual_lifts: int
    firmware_resets: int


class CheckFields(Stamped, Protocol):
    """Of CarCheck: the self-check of the Car's frame."""

    id: int
    state: int
    difference_m: float
    difference_rad: float
    limit_m: float
    limit_rad: float
    message: str
    problems: Sequence[ProblemFields]


class DriveFields(Stamped, Protocol):
    """Of DriveStatus: who moves the wheels, what is wrong, and counts since drive control's start."""

    source: str
    linear_mps: float
    message: str
    problems: Sequence[ProblemFields]
    manual_drives: int
    blockages: int
    lock_stops: int
    zone: int
    obstacle_m: float
    obstacle_bearing: float


class MotionFields(Stamped, Protocol):
    """Of MotionStatus: counts since the planner's start."""

    replans: int


class Inputs(NamedTuple):
    """The messages of their topics that tell the present, None for one that is too old or never came.

    Attributes:
        now_s: the robot's clock.
        steady_s: the steady clock at that instant.
        clock_steps: times that the robot's clock was set.
        emergency_stop: as its owners say.
        start_failures: why nodes cannot start, by their names.
        surroundings: what the robot sees, None in a Status that does not carry it.
        preflight: what the last one found, None before one was made.
        full_disk: a disk of the robot that has no room, None while all have.
    """

    now_s: float
    pose: Optional[PoseFields] = None
    car: Optional[CarFields] = None
    mode: Optional[ModeFields] = None
    peripherals: Optional[PeripheralsFields] = None
    check: Optional[CheckFields] = None
    drive: Optional[DriveFields] = None
    motion: Optional[MotionFields] = None
    steady_s: float = 0.0
    clock_steps: int = 0
    emergency_stop: EmergencyStop = EmergencyStop.ABSENT
    start_failures: Mapping[str, str] = MappingProxyType({})
    surroundings: Optional[Surroundings] = None
    preflight: Optional[PreflightReport] = None
    full_disk: Optional[FullDisk] = None
