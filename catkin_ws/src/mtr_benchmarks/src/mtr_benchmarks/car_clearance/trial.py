"""Complete test around one Car: the planner's paths around it and approaches to all its sides and corners."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Dict, List, NamedTuple, Tuple

import numpy as np

from mtr_car_locator.find.errors import NotLocated
from mtr_car_locator.measure.car_fit import CarFit
from mtr_core import names
from mtr_core.arrays import FloatArray
from mtr_core.requests import Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Direction
from mtr_description.shipped import shipped_geometry
from mtr_motion_planner.geometry.robot_outline import RobotOutline
from mtr_motion_planner.inputs import RobotState
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.search.options import Target
from mtr_motion_planner.search.planning import Planning
from mtr_motion_planner.site import Site
from mtr_motion_planner.timing.plan import Moving, Plan, PlanRefused
from mtr_simulation.noise import stream

from .draw import RandomClearanceCar, random_car
from .mapping import located, received
from .sweep import Body

# Distances of the key from the estimated Car along an axis: targets in order, and starting distance.
NEAR_M, FAR_M = (0.3, 0.5, 0.8, 1.2), 2.5
KEY_M, SPEED_MPS, SAMPLES = 0.25, 0.5, 2
# 1 sigma of the robot's pose error, and of the additional error of its control.
OWN_SIGMA_M, OWN_SIGMA_RAD, CONTROL_SIGMA_M = 0.006, 0.002, 0.004
FOOTPRINT = shipped_geometry().footprint()


class LineEnd(NamedTuple):
    """Result of one line.

    Attributes:
        side: side or corner of the Car.
        nearest_m: smallest distance of the key at which the line was measured; infinite: none.
        refused: codes of the planner's refusals of smaller distances.
        clearance_m: least distance from the true body on all paths; 0 for a contact.
    """

    side: str
    nearest_m: float
    refused: Tuple[str, ...]
    clearance_m: float


class CarEnd(NamedTuple):
    """Result of the test of one Car. asked: question of the locator to the Operator, if it found no position."""

    number: int
    drawn: RandomClearanceCar
    lines: Tuple[LineEnd, ...] = ()
    asked: str = ""


def run(task: Tuple[int, int]) -> CarEnd:
    """Run the test of a Car, given by seed and number."""
    seed, number = task
    drawn, chance = random_car(seed, number), stream(seed, f"clearance test {number}")
    try:
        fit = located(drawn, chance)
    except NotLocated as refusal:
        return CarEnd(number, drawn, asked=str(refusal))
    return CarEnd(number, drawn, tuple(Test(drawn, fit, chance).lines()))


class Test:
    """Robot next to one located Car."""

    def __init__(self, drawn: RandomClearanceCar, fit: CarFit, chance: np.random.Generator):
        self._told, self._chance = fit.rectangle, chance
        parameters = MotionParameters()
        self._parameters = replace(parameters, margins=replace(
            parameters.margins, rear_fitting_m=drawn.rear_fitting_m))
        state = RobotState(1.0, True, Pose2(0.0, 0.0, 0.0), 0.0, 0.0, position_sigma_m=OWN_SIGMA_M,
                           heading_sigma=OWN_SIGMA_RAD)
        goal = Waypoint(1, "benchmark", names.CAR, Pose2(9.0, 0.0, 0.0))
        site = Site(goal, received(fit, 1.0), state, RobotOutline(FOOTPRINT, parameters.slip), self._parameters)
        self._planning = Planning(site.keep_out, None, self._parameters, SPEED_MPS)
        self._body = Body(drawn.car.solids())
        self._true_from_told = drawn.pose.inverse() @ fit.rectangle.pose
        self._centre = parameters.slip.base_from_centre
        self._pose = Pose2(0.5 * fit.rectangle.length + 1.6, 0.5 * fit.rectangle.width + 1.6, 0.0)

    def lines(self) -> List[LineEnd]:
        """Measure all axes one after another."""
        return [self._line(side, *axis) for side, axis in self._axes().items()]

    def _axes(self) -> Dict[str, Tuple[float, float, float]]:
        """Return the foot of each axis and its direction away from the Car."""
        x, y = 0.5 * self._told.length, 0.5 * self._told.width
        along, across = self._chance.uniform(-0.8, 0.8, 2) * (x, y)
        corners = {f"{end} {side}": (sign * x, turn * y, math.atan2(turn, sign))
                   for end, sign in (("front", 1.0), ("rear", -1.0)) for side, turn in (("left", 1.0), ("right", -1.0))}
        return {"front": (x, across, 0.0), "left": (along, y, 0.5 * math.pi), "rear": (-x, -across, math.pi),
                "right": (-along, -y, -0.5 * math.pi), **corners}

    def _line(self, side: str, x: float, y: float, outward: float) -> LineEnd:
        def place(distance_m: float) -> Pose2:
            reach_m = distance_m + KEY_M
            return Pose2(x + reach_m * math.cos(outward), y + reach_m * math.sin(outward), outward + math.pi)

        clearances: List[float] = []
        refused: List[str] = []
        for near_m in NEAR_M:
            try:
                clearances += [self._go(place(FAR_M), Direction.ANY), self._go(place(near_m), Direction.FORWARD),
                               self._go(place(FAR_M), Direction.BACKWARD)]
                return LineEnd(side, near_m, tuple(refused), min(clearances))
            except PlanRefused as refusal:
                refused.append(refusal.problem.code)
        return LineEnd(side, math.inf, tuple(refused), min(clearances, default=math.inf))

    def _go(self, goal: Pose2, direction: Direction) -> float:
        """Plan a path and return its least distance from the true body; the robot is then at the goal."""
        plan = self._planning.plan(Moving(self._pose @ self._centre), Target(goal @ self._centre, direction))
        self._pose = goal
        return self._body.clearance(self._true_poses(plan))

    def _true_poses(self, plan: Plan) -> FloatArray:
        """Return poses of base_link in the true Car's frame, with random errors of localization and control."""
        off_m = math.hypot(OWN_SIGMA_M, CONTROL_SIGMA_M)
        x, y, turn = (float(self._chance.normal(0.0, sigma)) for sigma in (off_m, off_m, OWN_SIGMA_RAD))
        error = Pose2(x, y, turn)
        frame = self._true_from_told
        rows = [row for part in plan.parts for row in (*part.trajectory.poses[::SAMPLES], part.trajectory.poses[-1])]
        poses = [frame @ Pose2(*row) @ self._centre.inverse() @ error for row in rows]
        if not poses:
            poses = [frame @ self._pose]
        return np.array([(pose.x, pose.y, pose.heading) for pose in poses])


def refusals(ends: List[CarEnd]) -> Dict[str, int]:
    """Return the number of the planner's refusals by code."""
    counts: Dict[str, int] = {}
    for code in (code for end in ends for line in end.lines for code in line.refused):
        counts[code] = counts.get(code, 0) + 1
    return counts
