"""What the application requests of the robot: a waypoint, a press of a button, and the whole desired state.

Poses are of base_link in the Car coordinate system, in m and rad; times are seconds of the robot's clock.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass

from .geometry.pose import Point, Pose


class Direction(enum.Enum):
    """Direction of travel on the last straight piece before a waypoint."""

    ANY = 0
    FORWARD = 1
    BACKWARD = 2


@dataclass(frozen=True)
class Waypoint:
    """A pose of base_link to reach; id is unique within the session and never 0."""

    id: int
    pose: Pose
    direction: Direction = Direction.ANY


@dataclass(frozen=True)
class Press:
    """A press of one or more key buttons (1 lock, 2 unlock); strength 0 to 1, duration in s."""

    id: int
    buttons: tuple[int, ...]
    strength: float
    duration_s: float


@dataclass(frozen=True)
class AreaOrder:
    """A test area, which the robot does not leave; without corners it withdraws the one in force.

    id: unique within the session, never 0. origin_id: AreaState.origin_id of the Status by which it was drawn.
    """

    id: int
    origin_id: int
    corners: tuple[Point, ...]


@dataclass(frozen=True)
class DesiredState:
    """The whole desired final state of the robot. Immutable: a change is a new object with a new id.

    resume_hold_id: the RobotStatus.hold_id that the Operator has released, 0 for none.
    area: None leaves the test area as it is. enters_service: disable wheels, lift and servos. leave_service_id: the
    ServiceState.agreement_id that the Operator has released, 0 for none.
    """

    stop: bool = False
    waypoint: Waypoint | None = None
    max_speed_mps: float | None = None
    key_height_m: float | None = None
    press: Press | None = None
    map_car_id: int = 0
    check_car_id: int = 0
    resume_hold_id: int = 0
    area: AreaOrder | None = None
    enters_service: bool = False
    leave_service_id: int = 0
