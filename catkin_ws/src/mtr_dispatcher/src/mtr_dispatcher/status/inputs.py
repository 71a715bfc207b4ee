"""Inputs of a Status: the fields of the nodes' messages that the dispatcher reads."""
# SPDX-License-Identifier: Apache-2.0
from types import MappingProxyType
from typing import Any, Mapping, NamedTuple, Optional, Protocol, Sequence

from mtr_core.problems import ProblemFields

from ..disks.watch import FullDisk
from ..preflight_report import PreflightReport
from .emergency import EmergencyStop
from .surroundings import Surroundings

# Age at which a periodic message no longer counts as current.
STALE_AFTER_S = 0.5


class Stamped(Protocol):
    """A message with a std_msgs/Header."""

    header: Any


class PoseFields(Stamped, Protocol):
    """Fields of LocalizedPose: base_link in map, m and rad, and its motion."""

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
    """Fields of CarEstimate: the Car in map and its size, m and rad."""

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
    """Fields of RobotMode: the state, and the result of the Operator's waypoint."""

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
    """Fields of PressReport: one executed press; times of the robot's clock."""

    session_id: int
    id: int
    start: Any
    end: Any
    error: str
    problems: Sequence[ProblemFields]


class PeripheralsFields(Stamped, Protocol):
    """Fields of PeripheralsState: key, buttons and battery."""

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
    """Fields of CarCheck: the self-check of the Car's frame."""

    id: int
    state: int
    difference_m: float
    difference_rad: float
    limit_m: float
    limit_rad: float
    message: str
    problems: Sequence[ProblemFields]


class DriveFields(Stamped, Protocol):
    """Fields of DriveStatus: source of motion, problems, and counts since drive control's start."""

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
    """Fields of MotionStatus: counts since the planner's start."""

    replans: int


class Inputs(NamedTuple):
    """The current messages of their topics, or None for a stale or missing one.

    Attributes:
        now_s: the robot's clock.
        steady_s: the steady clock at the same instant.
        clock_steps: number of steps of the robot's clock.
        emergency_stop: state reported by its owners.
        start_failures: why nodes cannot start, by their names.
        surroundings: view of the LiDARs, or None in a Status without a picture.
        preflight: report of the last preflight, or None before the first.
        full_disk: a full disk of the robot, or None.
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
