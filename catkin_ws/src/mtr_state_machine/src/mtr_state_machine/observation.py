"""What the state machine knows of the robot at its tick, as plain data."""
# SPDX-License-Identifier: Apache-2.0
import enum
from dataclasses import dataclass, field
from typing import Dict

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.states import CarState, Check, Result

from . import problems


class Part(enum.Enum):
    """Parts of the robot that must report all the time; the value is the name a person reads."""

    DISPATCHER = "dispatcher"
    LOCALIZATION = "localization"
    CAR_LOCATOR = "Car locator"
    MOTION_PLANNER = "motion planner"
    DRIVE_CONTROL = "drive control"
    PERIPHERALS = "peripherals"


@dataclass(frozen=True)
class Place:
    """A pose of base_link to reach; id 0: none. m and rad; direction as in the message Waypoint."""

    id: int = 0
    frame_id: str = "car"
    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0
    direction: int = 0


@dataclass(frozen=True)
class Desired:
    """What the Operator wants."""

    session_id: int = 0
    link_alive: bool = False
    stop: bool = True
    waypoint: Place = Place()
    max_speed_mps: float = 0.0
    map_car_id: int = 0
    check_car_id: int = 0


@dataclass(frozen=True)
class CheckReport:
    """How the Car locator's self-check stands; id 0: none yet."""

    id: int = 0
    state: Check = Check.NONE
    message: Problem = NO_PROBLEM


@dataclass(frozen=True)
class Car:
    """The Car locator's estimate, as far as it matters here."""

    state: CarState = CarState.UNKNOWN
    next_waypoint: Place = Place(frame_id="map")
    map_car_id: int = 0
    message: Problem = NO_PROBLEM


@dataclass(frozen=True)
class Motion:
    """The motion planner's report."""

    goal_id: int = 0
    result: Result = Result.IDLE
    message: Problem = NO_PROBLEM


@dataclass(frozen=True)
class Observation:
    """Everything known at one tick.

    Attributes:
        map_revision: map that the robot's pose is in.
        age_s: age of each part's newest message; a part that is missing has not reported yet.
        complaint: of a part that reports but is not well, e.g. a localization that is lost.
    """

    desired: Desired = Desired()
    car: Car = Car()
    check: CheckReport = CheckReport()
    map_revision: int = 0
    motion: Motion = Motion()
    age_s: Dict[Part, float] = field(default_factory=dict)
    complaint: Dict[Part, Problem] = field(default_factory=dict)

    def part_problem(self, part: Part, silent_after_s: float) -> Problem:
        """What is wrong when the part is silent or not well."""
        if part not in self.age_s:
            return problems.PART_NOT_REPORTED(part=part.value)
        if self.age_s[part] > silent_after_s:
            return problems.PART_SILENT(part=part.value, age_s=self.age_s[part])
        return self.complaint.get(part, NO_PROBLEM)
