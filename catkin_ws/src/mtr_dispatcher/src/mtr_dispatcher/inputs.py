"""What the dispatcher knows of the robot when it writes a Status: the fields that it reads of the nodes' messages."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, NamedTuple, Optional, Protocol, Sequence, TypeVar

from mtr_core.problems import ProblemFields

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
    outline_x: Sequence[float]
    outline_y: Sequence[float]
    revision: int
    correction_x: float
    correction_y: float
    correction_heading: float


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


M = TypeVar("M", bound=Stamped)


class Inputs(NamedTuple):
    """The messages of their topics that hold at now_s, None before the first."""

    now_s: float
    pose: Optional[PoseFields] = None
    car: Optional[CarFields] = None
    mode: Optional[ModeFields] = None
    peripherals: Optional[PeripheralsFields] = None
    check: Optional[CheckFields] = None

    def fresh(self) -> "Inputs":
        """The same without stale messages: None stands for one that is too old."""
        return Inputs(self.now_s, self._fresh(self.pose), self._fresh(self.car), self._fresh(self.mode),
                      self._fresh(self.peripherals), self._fresh(self.check))

    def _fresh(self, message: Optional[M]) -> Optional[M]:
        if message is None or self.now_s - message.header.stamp.to_sec() > STALE_AFTER_S:
            return None
        return message
