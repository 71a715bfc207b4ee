"""Simulation for tests: a parked car of line segments, a robot that follows the locator, and two noisy LiDARs."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import List, Optional, Sequence, Tuple

import numpy as np

from mtr_car_locator.estimate import Estimate, Inputs, LocatorTask
from mtr_car_locator.locator import CarLocator
from mtr_car_locator.parameters import LocatorParameters
from mtr_car_locator.poses import PoseHistory, PoseMode, RobotPose
from mtr_car_locator.scan import NO_BIAS, RangeBias, Scan, returns_in_map
from mtr_car_locator.survey.surface_map import MapPhase, SurfaceMap
from mtr_car_locator.survey.surfel_grid import SurfelGrid
from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL, Goal, GoalReport, Waypoint
from mtr_core.se2 import Pose2, wrap_angle
from mtr_core.states import CarState, Check, Result
from mtr_description.shipped import shipped_geometry

PARAMETERS = LocatorParameters()
BEAMS, FIELD_RAD, SWEEP_S = 480, math.radians(270.0), 0.030
SPEED_MPS, YAW_RADPS, PERIOD_S = 0.5, 1.0, 0.02
Points = Sequence[Tuple[float, float]]
BOX: Points = ((2.25, .9), (-2.25, .9), (-2.25, -.9), (2.25, -.9))
FRONT: Points = ((.93, .88), (1.0, .6), (1.0, .55), (1.6, .55), (1.72, .9), (2.02, .84), (2.18, .62), (2.25, .25))
REAR: Points = ((-2.25, .30), (-2.20, .66), (-2.05, .86), (-1.70, .9), (-1.62, .55), (-1.0, .55), (-.93, .88))
WHEEL: Points = ((.32, .105), (-.32, .105), (-.32, -.105), (.32, -.105))


def closed(points: Points, at: Tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Return segments (n, 4) of a closed polygon."""
    shifted = [(x + at[0], y + at[1]) for x, y in points]
    return np.array([(*a, *b) for a, b in zip(shifted, [*shifted[1:], shifted[0]])])


def wheels_alone() -> np.ndarray:
    """Return a Car of 4.5 m with a body above the scan plane."""
    return np.vstack([closed(WHEEL, (x, y)) for x in (1.325, -1.325) for y in (.77, -.77)])


def leg_at(x: float, y: float) -> np.ndarray:
    """Return a person's leg."""
    return closed([(.07 * math.cos(a), .07 * math.sin(a)) for a in np.arange(8) * math.pi / 4.0], (x, y))


def mirrored(points: Points) -> List[Tuple[float, float]]:
    """Return the right side for a given left side, in reverse order."""
    return [(x, -y) for x, y in points[::-1]]


def car_with_bumpers() -> np.ndarray:
    """Return a car with rounded bumpers, sills inset by 2 cm, wheels in their arches; 4.5 m by 1.8 m."""
    body = closed([*FRONT, *mirrored(FRONT), *mirrored(REAR), *REAR])
    wheels = [closed(WHEEL, (x, y)) for x in (1.325, -1.325) for y in (.77, -.77)]
    return np.vstack([body, *wheels])


@dataclass
class Scene:
    """Truth of one test: segments and start of the robot in the Car's frame, and the errors."""

    segments: np.ndarray
    start: Pose2 = PARAMETERS.car_from_start
    range_sigma_m: float = 0.01
    range_bias: RangeBias = NO_BIAS
    drift_m: float = 0.0
    drift_rad: float = 0.0
    drift_time_s: float = 5.0
    pose_sigma_m: float = 0.005
    seed: int = 1
    refused: Tuple[int, ...] = ()
    blocked: Tuple[int, ...] = ()
    maps: bool = True
    map_problem: str = ""
    parameters: LocatorParameters = PARAMETERS
    rng: np.random.Generator = field(init=False)

    def __post_init__(self) -> None:
        self.rng = np.random.default_rng(self.seed)


class Mapper:
    """Simulated mapping: key-frames from exact poses, and after the order to freeze a map without range biases."""

    def __init__(self, scene: Scene, centre: Pose2):
        self._scene, self._centre = scene, centre
        self._grid = SurfelGrid(centre.x, centre.y)
        self._poses: Optional[PoseHistory] = None
        self._map_id, self._freeze_s = 0, math.inf
        self.revision = 0
        self.mode = PoseMode.DEAD_RECKONING
        self.map: Optional[SurfaceMap] = None
        self._frames: List[Tuple[float, float, float, float]] = []

    def add_pose(self, now_s: float, pose: Pose2) -> None:
        """Add a true pose; every half second it becomes a key-frame."""
        robot = RobotPose(now_s, pose)
        if self._poses is None:
            self._poses = PoseHistory(robot)
        else:
            self._poses.add(robot)
        if not self._frames or now_s - self._frames[-1][0] >= 0.5:
            self._frames.append((now_s, pose.x, pose.y, pose.heading))

    def follow(self, now_s: float, estimate: Estimate, scans: Sequence[Scan]) -> None:
        """Process the locator's order."""
        if estimate.phase is MapPhase.COLLECT and estimate.map_id != self._map_id:
            self._map_id, self._freeze_s, self.revision = estimate.map_id, math.inf, 0
            self._grid = SurfelGrid(self._centre.x, self._centre.y)
            self.mode = PoseMode.MAPPING
        for scan in scans:
            seen = returns_in_map(scan, self._poses, self._scene.range_bias) if self._poses else None
            if seen is not None:
                self._grid.add(seen.points, seen.viewer)
        if estimate.phase is MapPhase.FREEZE and math.isinf(self._freeze_s):
            self._freeze_s = now_s + 2.0
        if now_s >= self._freeze_s and self.revision == 0:
            valid = not self._scene.map_problem
            self.revision = 1 + (self.map.revision if self.map else 0) if valid else 0
            self.mode = PoseMode.LOCALIZED
            self.map = SurfaceMap(self._map_id, self.revision, valid, self._grid.surfels(0.002),
                                  np.array(self._frames), Problem(text=self._scene.map_problem),
                                  self._scene.range_bias)


class World:
    """Runs a scene; map begins at the robot's start.

    Attributes:
        car: true pose of the Car in map.
        checking: order to check the Car, 0 for none.
        pushed_mps: speed at which the robot is pushed ahead.
        is_lost: localization gives no valid pose.
    """

    def __init__(self, scene: Scene):
        self.scene = scene
        self.locator = CarLocator(scene.parameters)
        self.pose = Pose2(0.0, 0.0, 0.0)
        self.mode: Optional[PoseMode] = None
        self.checking = 0
        self.pushed_mps = 0.0
        self.is_lost = False
        self.steps = 50
        self.drift = np.zeros(3)
        self.estimates: List[Estimate] = []
        self._scans: List[Tuple[float, Scan]] = []
        self._trail: List[Tuple[float, Pose2]] = []
        self.place_car(scene.start.inverse(), scene.segments)
        self.mapper = Mapper(scene, self.car)

    def place_car(self, car: Pose2, segments: np.ndarray) -> None:
        """Put the Car, and objects next to it, somewhere in map."""
        self.car = car
        self.segments = np.hstack([self._to_map(segments[:, :2]), self._to_map(segments[:, 2:])])

    @property
    def now(self) -> float:
        """Time in s."""
        return self.steps * PERIOD_S

    @property
    def newest(self) -> Estimate:
        """Newest estimate."""
        return self.estimates[-1]

    def run(self, limit_s: float = 150.0, map_car_id: int = 7) -> Estimate:
        """Map the Car until it is located or has failed."""
        for _ in range(int(limit_s / PERIOD_S)):
            self.step(mapping=True, map_car_id=map_car_id)
            if self.estimates and self.newest.state in (CarState.LOCATED, CarState.FAILED):
                break
        return self.newest

    def check(self, check_car_id: int, limit_s: float = 120.0) -> Estimate:
        """Run a check of the Car."""
        self.checking = check_car_id
        for _ in range(int(limit_s / PERIOD_S)):
            self.step(mapping=False, map_car_id=7)
            if self.newest.check.check_id == check_car_id and self.newest.check.state in (Check.PASSED, Check.FAILED):
                break
        self.checking = 0
        return self.newest

    def stand(self, duration_s: float) -> Estimate:
        """Advance the time while the robot is stationary."""
        for _ in range(int(duration_s / PERIOD_S)):
            self.step(mapping=False, map_car_id=7, drives=False)
        return self.newest

    def step(self, mapping: bool, map_car_id: int, drives: bool = True) -> None:
        """Advance by 20 ms: motion; a scan every 160 ms (320 ms on the way), a tick of the locator every 100 ms."""
        self.steps += 1
        before = self.pose
        place = self.newest.waypoint if self.estimates else None
        if place and drives and (mapping or self.checking) and place.id not in self._unreachable():
            self._drive_to(place.pose)
        self.pose = self.pose @ Pose2(self.pushed_mps * PERIOD_S, 0.0, 0.0)
        self._drift()
        self._trail = [*self._trail[-3:], (self.now, self.pose)]
        localized = self._localized(before)
        if not self.is_lost:
            self.locator.add_pose(localized)
        self.mapper.add_pose(self.now, self.pose)
        if self.steps % (8 if self.pose == before else 16) == 0 and len(self._trail) == 4:
            for is_rear, mount in enumerate(shipped_geometry().lidars()):
                self._scans.append((self.now, self._scan(mount, bool(is_rear))))
        if self.steps % 5 == 0:
            self._tick(mapping, map_car_id)

    def error(self) -> Tuple[float, float, float, float]:
        """Return distance, heading, length and width error of the newest estimate."""
        found = self.newest.rectangle
        at = self.car.inverse() @ found.pose
        return math.hypot(at.x, at.y), at.heading, found.length - 4.5, found.width - 1.8

    def _unreachable(self) -> Tuple[int, ...]:
        return (*self.scene.refused, *self.scene.blocked)

    def _tick(self, mapping: bool, map_car_id: int) -> None:
        place = self.newest.waypoint if self.estimates else None
        goal = Goal(place, 100 + place.id) if place else NO_GOAL
        due = [scan for time_s, scan in self._scans if time_s <= self.now - 0.06]
        self._scans = [entry for entry in self._scans if entry[0] > self.now - 0.06]
        task = LocatorTask(mapping, map_car_id, goal, checking=self.checking != 0, check_car_id=self.checking)
        inputs = Inputs(self.now, task, GoalReport(goal.id, self._result(place)), due, self.mapper.map)
        self.estimates.append(self.locator.step(inputs))
        if self.scene.maps:
            self.mapper.follow(self.now, self.newest, due)

    def _result(self, place: Optional[Waypoint]) -> Result:
        if place is None:
            return Result.IDLE
        if place.id in self.scene.refused:
            return Result.REFUSED
        if place.id in self.scene.blocked:
            return Result.BLOCKED
        return Result.REACHED if self.pose == place.pose else Result.PENDING

    def _drive_to(self, goal: Pose2) -> None:
        error = wrap_angle(math.atan2(goal.y - self.pose.y, goal.x - self.pose.x) - self.pose.heading)
        if self.pose.distance_to(goal) < 0.05 or self._is_through_car(goal):
            self.pose = goal
            return
        turn = max(-YAW_RADPS, min(YAW_RADPS, 2.0 * error)) * PERIOD_S
        ahead = SPEED_MPS * PERIOD_S if abs(error) < 0.8 else 0.0
        self.pose = self.pose @ Pose2(ahead, 0.0, turn)

    def _is_through_car(self, goal: Pose2) -> bool:
        """Return True for a path that a planner would lead round the Car."""
        here, there = (self.car.inverse() @ pose for pose in (self.pose, goal))
        points = [(here.x + s * (there.x - here.x), here.y + s * (there.y - here.y)) for s in np.linspace(0, 1, 20)]
        return any(abs(x) < 2.6 and abs(y) < 1.2 for x, y in points)

    def _drift(self) -> None:
        keep = math.exp(-PERIOD_S / self.scene.drift_time_s)
        sigma = np.array([self.scene.drift_m, self.scene.drift_m, self.scene.drift_rad])
        self.drift = keep * self.drift + math.sqrt(1.0 - keep ** 2) * sigma * self.scene.rng.standard_normal(3)

    def _localized(self, before: Pose2) -> RobotPose:
        x, y, heading = self.drift
        pose = Pose2(self.pose.x + x, self.pose.y + y, self.pose.heading + heading)
        variance = self.scene.pose_sigma_m ** 2
        covariance = (variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, 0.25 * variance)
        return RobotPose(self.now, pose, self.pose.distance_to(before) / PERIOD_S,
                         (self.pose.heading - before.heading) / PERIOD_S, self.mode or self.mapper.mode,
                         self.mapper.revision, covariance)

    def _scan(self, mount: Pose2, is_rear: bool) -> Scan:
        """Return a sweep that ends now; each beam from the true pose at its own time."""
        times = self.now - SWEEP_S + np.arange(BEAMS) * SWEEP_S / BEAMS
        known = np.array([(t, p.x, p.y, p.heading) for t, p in self._trail])
        heading = np.interp(times, known[:, 0], np.unwrap(known[:, 3]))
        x = np.interp(times, known[:, 0], known[:, 1]) + mount.x * np.cos(heading)
        y = np.interp(times, known[:, 0], known[:, 2]) + mount.x * np.sin(heading)
        beam = heading + mount.heading - 0.5 * FIELD_RAD + np.arange(BEAMS) * FIELD_RAD / BEAMS
        ranges = cast(x, y, beam, self.segments) + self.scene.rng.normal(0.0, self.scene.range_sigma_m, BEAMS)
        ranges += self.scene.range_bias.of(is_rear)
        return Scan(times[0], SWEEP_S / BEAMS, -0.5 * FIELD_RAD, FIELD_RAD / BEAMS, 0.1, 30.0, ranges, mount, is_rear)

    def _to_map(self, points: np.ndarray) -> np.ndarray:
        return np.array([self.car.apply(x, y) for x, y in points])


def cast(x: np.ndarray, y: np.ndarray, angle: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Return the distance to the nearest segment along each beam, or infinity."""
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    ax, ay = segments[:, 0] - x[:, None], segments[:, 1] - y[:, None]
    ex, ey = segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = cos * ey - sin * ex
        along = (ax * ey - ay * ex) / cross
        share = (ax * sin - ay * cos) / cross
        hit = (along > 0.0) & (share >= 0.0) & (share <= 1.0)
    return np.where(hit, along, np.inf).min(axis=1)
