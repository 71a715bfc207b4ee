"""Numbers of the messages that pure code decides by; a unit test compares them with mtr_msgs."""
# SPDX-License-Identifier: Apache-2.0
import enum


class State(enum.IntEnum):
    """High-level states of the robot, as in RobotMode."""

    STARTING = 1
    READY_TO_MAP_CAR = 2
    MAPPING_CAR = 3
    FOLLOWING_WAYPOINT = 4
    FAULT = 5
    CHECKING_CAR = 6


class CarState(enum.IntEnum):
    """States of the Car locator, as in CarEstimate."""

    UNKNOWN = 0
    COLLECTING = 1
    LOCATED = 2
    FAILED = 3


class Check(enum.IntEnum):
    """How the self-check of the Car's frame stands, as in CarCheck."""

    NONE = 0
    RUNNING = 1
    PASSED = 2
    FAILED = 3


class Result(enum.IntEnum):
    """What the motion planner says of its goal, as in MotionStatus."""

    IDLE = 0
    PENDING = 1
    REACHED = 2
    REFUSED = 3
    BLOCKED = 4


class Direction(enum.IntEnum):
    """Travel on the last straight piece, as in Waypoint."""

    ANY = 0
    FORWARD = 1
    BACKWARD = 2
