"""Numbers of the messages on which pure code decides; a unit test compares them with mtr_msgs."""
# SPDX-License-Identifier: Apache-2.0
import enum


class State(enum.IntEnum):
    """High-level states of the robot, with the numbers of RobotMode."""

    STARTING = 1
    READY_TO_MAP_CAR = 2
    MAPPING_CAR = 3
    FOLLOWING_WAYPOINT = 4
    FAULT = 5
    CHECKING_CAR = 6


class CarState(enum.IntEnum):
    """States of the Car locator, with the numbers of CarEstimate."""

    UNKNOWN = 0
    COLLECTING = 1
    LOCATED = 2
    FAILED = 3


class Check(enum.IntEnum):
    """States of the self-check of the Car's frame, with the numbers of CarCheck."""

    NONE = 0
    RUNNING = 1
    PASSED = 2
    FAILED = 3


class Result(enum.IntEnum):
    """Results of a goal from the motion planner, with the numbers of MotionStatus."""

    IDLE = 0
    PENDING = 1
    REACHED = 2
    REFUSED = 3
    BLOCKED = 4


class Direction(enum.IntEnum):
    """Direction of travel on the last straight segment, with the numbers of Waypoint."""

    ANY = 0
    FORWARD = 1
    BACKWARD = 2
