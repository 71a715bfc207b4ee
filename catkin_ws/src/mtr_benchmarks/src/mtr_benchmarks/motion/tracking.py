"""Speed and accuracy with which the robot follows its plans: random waypoint pairs around Cars of three sizes, and
axes.

Each pair is one motion from standstill at the first waypoint to REACHED at the second, in the simulation's physics with
perfect localization and drive control's limits. Its duration is compared with a lower bound (bound.py). Then the robot
drives to an axis of the Car, approaches on it to the minimum distance, and retreats backwards.
"""
# SPDX-License-Identifier: Apache-2.0
import math
import multiprocessing
import random
from dataclasses import dataclass
from typing import Iterator, List, Sequence, Tuple

import numpy as np
from shapely.geometry import Polygon

from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_description.shipped import shipped_geometry
from mtr_motion_planner.geometry.keep_out import KeepOut
from mtr_motion_planner.geometry.robot_outline import RobotOutline
from mtr_motion_planner.parameters import MotionParameters
from mtr_simulation.site.car_shape import CarShape

from ..harness.rows import Requirement, Row
from .bound import Ends, lower_bound
from .options import MotionOptions
from .trial import DrivenLeg, Trial, outline_of

SHAPES = (CarShape(length_m=3.6, width_m=1.6, wheelbase_m=2.4), CarShape(),
          CarShape(length_m=5.2, width_m=2.0, height_m=1.7, wheelbase_m=3.1, wheel_radius_m=0.36))
PAIR_SPEEDS_MPS = (0.5, 0.7, 1.0)
AXIS_SPEEDS_MPS = (0.3, 0.5, 0.8)
# Distances of the footprint from the Car: waypoints are in a belt around it, axes lead from far to the minimum
# distance.
MIN_DISTANCE_M, MAX_DISTANCE_M = 0.3, 3.5
AXIS_START_M, AXIS_END_M = 2.5, 0.3
# Pairs that are closer together are corrections rather than drives.
MIN_APART_M = 1.0
PARAMETERS = MotionParameters()
OUTLINE = RobotOutline(shipped_geometry().footprint(), PARAMETERS.slip)
TIME_MEDIAN = Requirement("time of a way by its lower bound, median", "(ratio)")
TIME_P95 = Requirement("time of a way by its lower bound, 95 %", "(ratio)", must=1.15)
CROSS_TRACK = Requirement("across the axis, 95 %", "m", must=0.02)
HEADING = Requirement("heading on the axis, 95 %", "deg", must=1.0)
STOP = Requirement("distance from the waypoint at a stop, 95 %", "m", must=0.02)
STOP_HEADING = Requirement("heading at a stop, 95 %", "deg", must=1.0)
NOT_REACHED = Requirement("ways on which the planner complained or did not reach the waypoint", "(count)", must=0.0)
CONTACTS = Requirement("pairs on whose ways the robot touched the Car", "(count)", must=0.0)


@dataclass(frozen=True)
class PairOutcome:
    """Result of one pair: ratio of the duration to its lower bound, stops as (m, deg), axis samples as (m, deg).

    The ratio of an uncompleted drive is infinite.
    """

    ratio: float
    stops: Tuple[Tuple[float, float], ...]
    axis: Tuple[Tuple[float, float], ...]
    clearance_m: float
    contacts: int
    failures: Tuple[str, ...]


@dataclass(frozen=True)
class TrackingFigures:
    """Figures of all pairs; the names are those in the file."""

    pairs: int
    time_ratio_median: float
    time_ratio_p95: float
    time_ratio_worst: float
    cross_track_p95_m: float
    cross_track_worst_m: float
    heading_p95_deg: float
    heading_worst_deg: float
    stop_error_p95_m: float
    stop_error_worst_m: float
    stop_heading_p95_deg: float
    stop_heading_worst_deg: float
    contacts_with_car: int
    min_clearance_m: float
    not_reached: List[str]

    def rows(self) -> List[Row]:
        """Return the rows of durations, of errors on the axis and at stops, and of failures."""
        return [Row(TIME_MEDIAN, self.time_ratio_median), Row(TIME_P95, self.time_ratio_p95),
                Row(CROSS_TRACK, self.cross_track_p95_m), Row(HEADING, self.heading_p95_deg),
                Row(STOP, self.stop_error_p95_m), Row(STOP_HEADING, self.stop_heading_p95_deg),
                Row(NOT_REACHED, len(self.not_reached), remark="; ".join(self.not_reached[:1])),
                Row(CONTACTS, self.contacts_with_car)]


def measure(options: MotionOptions) -> TrackingFigures:
    """Drive all pairs."""
    tasks = [(options.seed, number) for number in range(options.pairs)]
    with multiprocessing.Pool(options.jobs) as pool:
        return figures(pool.map(_pair, tasks, chunksize=1))


def figures(outcomes: Sequence[PairOutcome]) -> TrackingFigures:
    """Return the figures of these pairs."""
    ratios = np.array([outcome.ratio for outcome in outcomes])
    stops = np.array([stop for outcome in outcomes for stop in outcome.stops])
    axis = np.abs(np.array([sample for outcome in outcomes for sample in outcome.axis]))
    return TrackingFigures(
        pairs=len(outcomes),
        time_ratio_median=float(np.median(ratios)), time_ratio_p95=float(np.percentile(ratios, 95)),
        time_ratio_worst=float(ratios.max()),
        cross_track_p95_m=float(np.percentile(axis[:, 0], 95)), cross_track_worst_m=float(axis[:, 0].max()),
        heading_p95_deg=float(np.percentile(axis[:, 1], 95)), heading_worst_deg=float(axis[:, 1].max()),
        stop_error_p95_m=float(np.percentile(stops[:, 0], 95)), stop_error_worst_m=float(stops[:, 0].max()),
        stop_heading_p95_deg=float(np.percentile(stops[:, 1], 95)), stop_heading_worst_deg=float(stops[:, 1].max()),
        contacts_with_car=sum(outcome.contacts for outcome in outcomes),
        min_clearance_m=min(outcome.clearance_m for outcome in outcomes),
        not_reached=[failure for outcome in outcomes for failure in outcome.failures])


def _pair(task: Tuple[int, int]) -> PairOutcome:
    seed, number = task
    dice = random.Random(1_000_003 * seed + number)
    shape = SHAPES[number % len(SHAPES)]
    start, end = waypoint_pair(dice, shape)
    speed = dice.choice(PAIR_SPEEDS_MPS)
    trial = Trial(shape, start, PARAMETERS)
    pair = trial.go(end, Direction.ANY, speed)
    hull = Polygon(outline_of(shape)).convex_hull
    bound_s = lower_bound(Ends(start, end), hull, min_gap(), PARAMETERS.limits, speed)
    far, near = axis_of(dice, shape)
    legs = [pair, trial.go(far, Direction.ANY, speed)]
    speed = dice.choice(AXIS_SPEEDS_MPS)
    axis = [trial.go(near, Direction.FORWARD, speed), trial.go(far, Direction.BACKWARD, speed)]
    legs += axis
    return PairOutcome(ratio_of(pair, bound_s), tuple(_stop(leg) for leg in legs), tuple(_beside(far, axis)),
                   min(leg.clearance_m for leg in legs), len(trial.contacts & {"car"}),
                   tuple(f"pair {number}: {leg.result.name} {leg.message}" for leg in legs if _failed(leg)))


def ratio_of(leg: DrivenLeg, bound_s: float) -> float:
    """Return the duration divided by the lower bound; infinite for a failed drive."""
    return math.inf if _failed(leg) else leg.time_s / bound_s


def min_gap() -> float:
    """Return the least planned distance of base_link from the Car: half the width plus the keep-out margin."""
    return OUTLINE.half_width_m + PARAMETERS.margins.keep_out_m


def waypoint_pair(dice: random.Random, shape: CarShape) -> Tuple[Pose2, Pose2]:
    """Return two waypoints that are not too close together."""
    while True:
        start, end = waypoint(dice, shape), waypoint(dice, shape)
        if start.distance_to(end) >= MIN_APART_M:
            return start, end


def waypoint(dice: random.Random, shape: CarShape) -> Pose2:
    """Return a random place in the belt; half of them face the Car, as on an axis, the others have a random heading."""
    keep_out = KeepOut(outline_of(shape), OUTLINE, PARAMETERS.margins)
    while True:
        x, y = dice.uniform(-1.0, 1.0) * (0.5 * shape.length_m + 4.0), dice.uniform(-1.0, 1.0) * (
            0.5 * shape.width_m + 4.0)
        heading = dice.uniform(-math.pi, math.pi)
        if dice.random() < 0.5:
            heading = math.atan2(-y, -x)
        pose = Pose2(x, y, heading)
        turn_room = keep_out.distance(pose) >= keep_out.pivot_gap_m
        if turn_room and MIN_DISTANCE_M <= keep_out.clearance(pose) <= MAX_DISTANCE_M:
            return pose


def axis_of(dice: random.Random, shape: CarShape) -> Tuple[Pose2, Pose2]:
    """Return far and near end of a random axis of a side."""
    half_length, half_width = 0.5 * shape.length_m, 0.5 * shape.width_m
    side = dice.choice(("front", "rear", "left", "right"))
    across = dice.uniform(-0.9, 0.9) * (half_width if side in ("front", "rear") else half_length)
    turn = {"front": 0.0, "left": 0.5 * math.pi, "rear": math.pi, "right": -0.5 * math.pi}[side]
    extent = half_length if side in ("front", "rear") else half_width
    front = OUTLINE.footprint.front_m
    far, near = (Pose2(0.0, 0.0, turn) @ Pose2(extent + distance + front, across, math.pi)
                 for distance in (AXIS_START_M, AXIS_END_M))
    return far, near


def _stop(leg: DrivenLeg) -> Tuple[float, float]:
    return math.hypot(leg.miss.x, leg.miss.y), abs(math.degrees(leg.miss.heading))


def _beside(axis: Pose2, legs: List[DrivenLeg]) -> Iterator[Tuple[float, float]]:
    """Yield cross-track and heading error at each tick."""
    for leg in legs:
        for pose in leg.poses:
            seen = axis.inverse() @ pose
            yield seen.y, math.degrees(seen.heading)


def _failed(leg: DrivenLeg) -> bool:
    return leg.result != Result.REACHED or bool(leg.message)
