"""Survey of the Car: the drive round it, and the fit to the map of localization."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import math
from concurrent.futures import Executor
from dataclasses import replace
from typing import Optional, Sequence, Tuple

from mtr_core import names, sensor_figures
from mtr_core.problems import Problem
from mtr_core.requests import CAR_LOCATOR, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result

from .. import problems
from ..find.errors import NotLocated
from ..find.fit import fit_car, rough_car
from ..find.prior import Prior
from ..measure.car_fit import CarFit
from ..measure.close_up import Sweeps, WayRound
from ..parameters import LocatorParameters
from ..poses import PoseHistory, PoseMode, RobotPose
from ..scan import Scan, returns_in_map
from .ring import Ring
from .surface_map import MapPhase, SurfaceMap
from .surfel_grid import SurfelGrid


class Survey:
    """Guides the robot round the Car, orders the map, and fits the Car.

    Attributes:
        map_id: number of the map for localization.
        prior: expected Car.
        car: present estimate of the Car, the prior before it was seen.
        was_seen: True if car is based on points.
        fit: the Car, once it was found.
    """

    def __init__(self, prior: Prior, map_id: int, first_waypoint_id: int, parameters: LocatorParameters,
                 fits: Executor):
        """Create a survey. fits: executor of the fits, whose results are awaited."""
        self._parameters, self._fits = parameters, fits
        self._grid = SurfelGrid(prior.car.pose.x, prior.car.pose.y)
        self._way = WayRound(prior.car.pose.x, prior.car.pose.y)
        self._ring: Optional[Ring] = None
        self._waypoint_id = first_waypoint_id
        self._begun_s: Optional[float] = None
        self._blocked_since_s: Optional[float] = None
        self._frozen_since_s: Optional[float] = None
        self._is_mapped = False
        self.map_id = map_id
        self.prior, self.car = prior, prior.car
        self.was_seen = False
        self.fit: Optional[CarFit] = None

    @property
    def phase(self) -> MapPhase:
        """Order to localization."""
        return MapPhase.COLLECT if self._frozen_since_s is None else MapPhase.FREEZE

    @property
    def waypoint(self) -> Optional[Waypoint]:
        """Next waypoint of the robot."""
        if self._ring is None or self._ring.is_finished:
            return None
        return Waypoint(self._waypoint_id, CAR_LOCATOR, names.MAP, self._ring.place(self.car), Direction.FORWARD)

    @property
    def places_ahead(self) -> Tuple[Pose2, ...]:
        """Remaining places."""
        return self._ring.places_ahead(self.car) if self._ring else ()

    @property
    def next_waypoint_id(self) -> int:
        """Id that no waypoint of this survey has had."""
        return self._waypoint_id + 1

    @property
    def progress(self) -> Problem:
        """Message about the present activity."""
        if self._ring is None:
            return problems.FIRST_LOOK()
        if self._ring.is_finished:
            return problems.MAKES_MAP()
        return problems.GOES_ROUND(place=self._ring.done + 1, total=self._ring.total)

    def collect(self, scans: Sequence[Scan], poses: PoseHistory) -> None:
        """Add the returns of new scans."""
        self._is_mapped = self._is_mapped or poses.newest.mode is PoseMode.MAPPING
        for scan in scans:
            seen = returns_in_map(scan, poses)
            if seen is not None:
                self._grid.add(seen.points, seen.viewer)
                self._way.add(seen, scan.base_from_lidar)

    def advance(self, now_s: float, robot: RobotPose, result: Result) -> None:
        """Plan the path once the Car is seen; later continue to the next place.

        result: of the motion planner at the present place.
        """
        if self._begun_s is None:
            self._begun_s = now_s
        if self._ring is None:
            self._find_first(now_s - self._begun_s, robot)
        elif not self._ring.is_finished:
            self._go_on(self._ring, now_s, robot, result)

    def conclude(self, now_s: float, robot: RobotPose, surfaces: Optional[SurfaceMap]) -> None:
        """Use the adjusted map after the drive once the robot's pose is in it; NotLocated without a valid map."""
        if self._ring is None or not self._ring.is_finished:
            return
        if self._frozen_since_s is None:
            self._frozen_since_s = now_s
        if not self._is_mapped and robot.mode is PoseMode.DEAD_RECKONING:
            # Dead reckoning alone gives no map, so the locator's own surfels are used, with an unknown range bias.
            sigma_m = math.hypot(robot.position_sigma_m, sensor_figures.ASSUMED_RANGE_BIAS_M.value)
            self.fit = self._fits.submit(fit_car, self._grid.surfels(sigma_m), self.prior, self._parameters).result()
        elif surfaces is not None and surfaces.map_id == self.map_id:
            self.judge(surfaces)
            if robot.map_revision == surfaces.revision:
                self.fit = self._fits.submit(_fit_to_map, surfaces, self._way.sweeps(), self.prior,
                                             self._parameters).result()
        elif now_s - self._frozen_since_s > self._parameters.map_limit_s:
            raise NotLocated(problems.MAP_LATE(limit_s=self._parameters.map_limit_s))

    def judge(self, surfaces: Optional[SurfaceMap]) -> None:
        """Raise NotLocated if the map of this drive is not usable."""
        if surfaces is not None and surfaces.map_id == self.map_id and not surfaces.valid:
            raise NotLocated(surfaces.message or problems.NO_MAP())

    def _go_on(self, ring: Ring, now_s: float, robot: RobotPose, result: Result) -> None:
        is_settled = result in (Result.REACHED, Result.REFUSED)
        if is_settled or robot.pose.distance_to(ring.place(self.car)) <= self._parameters.arrival_m:
            ring.pass_place()
            with contextlib.suppress(NotLocated):
                self._find(robot)
            self._begin_leg()
        elif result is not Result.BLOCKED:
            self._blocked_since_s = None
        elif self._blocked_since_s is None:
            self._blocked_since_s = now_s
        elif now_s - self._blocked_since_s >= self._parameters.blocked_limit_s:
            ring.turn_back()
            self._begin_leg()

    def _begin_leg(self) -> None:
        self._waypoint_id += 1
        self._blocked_since_s = None

    def _find_first(self, since_s: float, robot: RobotPose) -> None:
        """Start the drive once the Car is seen: without that, its place is too uncertain."""
        if since_s < self._parameters.look_first_s:
            return
        try:
            self._find(robot)
        except NotLocated:
            if since_s >= self._parameters.look_limit_s:
                raise
            return
        self._ring = Ring(robot.pose, self.car, self._parameters.ring_distance_m)

    def _find(self, robot: RobotPose) -> None:
        """Improve the estimate of the Car for the rest of the path; NotLocated if the points do not allow one."""
        seen = self._grid.surfels(robot.position_sigma_m)
        self.car = self._fits.submit(rough_car, seen, self.prior, self._parameters).result()
        self.was_seen = True


def _fit_to_map(surfaces: SurfaceMap, sweeps: Sweeps, prior: Prior, parameters: LocatorParameters) -> CarFit:
    """Return the Car in the adjusted map, with its size from all returns of the drive."""
    fit = fit_car(surfaces.surfels, prior, parameters, sweeps.close_up(surfaces.key_frames, surfaces.range_bias))
    return replace(fit, range_bias=surfaces.range_bias)
