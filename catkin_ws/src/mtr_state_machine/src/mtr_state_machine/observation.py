"""State of the robot at a tick of the state machine, as plain data."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from dataclasses import dataclass, field
from typing import Dict

from mtr_core.liveness import is_fresh
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_WAYPOINT, DesiredState, GoalReport, Waypoint
from mtr_core.states import CarState, Check

from . import problems


class Part(enum.Enum):
    """Parts of the robot that must report continuously; the value is the displayed name."""

    DISPATCHER = "dispatcher"
    LOCALIZATION = "localization"
    CAR_LOCATOR = "Car locator"
    MOTION_PLANNER = "motion planner"
    DRIVE_CONTROL = "drive control"
    PERIPHERALS = "peripherals"


@dataclass(frozen=True)
class CheckReport:
    """State of the Car locator's self-check; id 0: none yet."""

    id: int = 0
    state: Check = Check.NONE
    message: Problem = NO_PROBLEM


@dataclass(frozen=True)
class Car:
    """Fields of the Car locator's estimate that the state machine uses."""

    state: CarState = CarState.UNKNOWN
    next_waypoint: Waypoint = NO_WAYPOINT
    map_car_id: int = 0
    message: Problem = NO_PROBLEM


@dataclass(frozen=True)
class Drive:
    """Source of motion in drive control, and counts of manual drives and blockages since its start."""

    is_manual: bool = False
    is_moving: bool = False
    manual_drives: int = 0
    blockages: int = 0


@dataclass(frozen=True)
class Emergency:
    """The robot's emergency stops: True if one is engaged, and the number of engagements since the node's start.

    is_service: service mode is one of the engaged stops.
    """

    is_engaged: bool = False
    stops: int = 0
    is_service: bool = False


NO_EMERGENCY = Emergency()


@dataclass(frozen=True)
class Observation:
    """All inputs of one tick.

    Attributes:
        now_s: the steady clock.
        map_revision: map of the robot's pose.
        age_s: age of each part's newest message; a missing part has not reported yet.
        complaint: problem of a part that reports but is faulty, e.g. a lost localization.
        is_position_lost: localization searches for its pose on the map, but lacks no sensor.
        firmware_resets: resets of the board of lift and servos since its node's start.
        lift_jams: number of times since that node's start that the lift gave up after a jam.
        signals_motion: the board reports that it gives the signal before motion.
        battery: charge from 0 to 1, NaN if it is unknown.
        intrusion: a second node publishes on a topic that moves the robot.
    """

    desired: DesiredState = DesiredState()
    car: Car = Car()
    check: CheckReport = CheckReport()
    map_revision: int = 0
    motion: GoalReport = GoalReport()
    age_s: Dict[Part, float] = field(default_factory=dict)
    complaint: Dict[Part, Problem] = field(default_factory=dict)
    is_position_lost: bool = False
    drive: Drive = Drive()
    emergency: Emergency = NO_EMERGENCY
    firmware_resets: int = 0
    lift_jams: int = 0
    signals_motion: bool = False
    now_s: float = 0.0
    battery: float = math.nan
    intrusion: Problem = NO_PROBLEM

    def is_silent(self, part: Part, silent_after_s: float) -> bool:
        """Return True for a silent part, or one that has not reported yet."""
        return not is_fresh(self.age_s.get(part, math.inf), silent_after_s)

    def part_problem(self, part: Part, silent_after_s: float) -> Problem:
        """Return the problem of a silent or faulty part."""
        if part not in self.age_s:
            return problems.PART_NOT_REPORTED(part=part.value)
        if self.is_silent(part, silent_after_s):
            return problems.PART_SILENT(part=part.value, age_s=self.age_s[part])
        return self.complaint.get(part, NO_PROBLEM)

    def only_position_is_lost(self, silent_after_s: float) -> bool:
        """Return True if the only problem is that localization searches for its pose on the map."""
        others = any(self.part_problem(part, silent_after_s) for part in Part if part is not Part.LOCALIZATION)
        return (not self.is_silent(Part.LOCALIZATION, silent_after_s) and self.is_position_lost and not others
                and not self.intrusion)
