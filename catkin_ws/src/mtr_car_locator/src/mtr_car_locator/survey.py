"""One mapping of the Car: points collected on the way round it, and where the robot shall go next."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import dataclasses
import math
from dataclasses import dataclass
from typing import Dict, List, Optional

from mtr_core.se2 import Pose2

from .cluster import car_points
from .drift import drift_between
from .fit import CarFit, NotLocated, fit_car, profiles_of
from .parameters import LocatorParameters
from .point_grid import PointGrid
from .poses import PoseHistory
from .profile import Profile
from .rectangle import Rectangle
from .ring import Ring
from .scan import Scan, points_in_map

# Part of the drift between first and last look that goes into the errors of the dimensions, as 1 sigma.
DRIFT_SHARE = 0.5


@dataclass(frozen=True)
class Place:
    """Where the robot shall go; place_id grows with each new place."""

    place_id: int
    pose: Pose2


class Survey:
    """Collects until the robot has been round the Car.

    Attributes:
        prior: where the Car should be.
        car: what is known of the Car so far, the prior before the first look.
        was_seen: True when car comes from points.
        finished: True when the robot has been everywhere.
    """

    def __init__(self, prior: Rectangle, started_s: float, first_place_id: int, parameters: LocatorParameters):
        self._parameters = parameters
        self._started_s = started_s
        # All points, and apart those of the first look and of the last piece of the way.
        self._all, self._first, self._last = (PointGrid(prior.pose.x, prior.pose.y) for _ in range(3))
        self._ring: Optional[Ring] = None
        self._first_place_id = first_place_id
        self._index = 0
        self.prior, self.car = prior, prior
        self.was_seen = False
        self.finished = False

    @property
    def place(self) -> Optional[Place]:
        """Where the robot shall go now."""
        if self._ring is None or self.finished:
            return None
        return Place(self._first_place_id + self._index, self._ring.place(self._index, self.car))

    @property
    def progress(self) -> str:
        """One sentence for a person."""
        if self._ring is None:
            return "The robot looks at the Car from where it stands."
        return f"The robot goes round the Car: place {min(self._index + 1, len(self._ring))} of {len(self._ring)}."

    def collect(self, scans: List[Scan], poses: PoseHistory) -> None:
        """Take the returns of new scans."""
        for scan in scans:
            points = points_in_map(scan, poses)
            self._all.add(points)
            if self._ring is None:
                self._first.add(points)
            elif self._index == len(self._ring) - 1:
                self._last.add(points)

    def advance(self, now_s: float, robot: Pose2, is_settled: bool) -> None:
        """Lay the way round after the first look; later go on to the next place.

        is_settled: the motion planner has ended the drive to the present place, well or not.
        """
        if self._ring is None:
            if now_s - self._started_s >= self._parameters.look_first_s:
                self._look()
                self._ring = Ring(robot, self.car, self._parameters.ring_distance_m)
            return
        place = self.place
        if place and (is_settled or robot.distance_to(place.pose) <= self._parameters.arrival_m):
            self._index += 1
            self.finished = self._index == len(self._ring)
            if not self.finished:
                self._look()

    def result(self) -> CarFit:
        """The Car from all points, sigmas widened by the drift of the pose; NotLocated when it cannot be trusted."""
        fit = self._fit()
        x_m, y_m = drift_between(self._profiles(self._first, fit.rectangle), self._profiles(self._last, fit.rectangle))
        limit_m = self._parameters.drift_limit_m
        if max(x_m, y_m) > limit_m:
            raise NotLocated(f"The robot's pose drifted by {max(x_m, y_m):.2f} m on the way round; allowed is "
                             f"{limit_m:.2f} m.")
        return dataclasses.replace(fit, length_sigma=math.hypot(fit.length_sigma, DRIFT_SHARE * x_m),
                                   width_sigma=math.hypot(fit.width_sigma, DRIFT_SHARE * y_m))

    def _fit(self) -> CarFit:
        return fit_car(*self._all.points(), self.prior, self._parameters)

    def _profiles(self, grid: PointGrid, car: Rectangle) -> Dict[str, Profile]:
        points, hits = grid.points()
        kept, _ = car_points(points, car)
        return profiles_of(points[kept], hits[kept], car.pose)

    def _look(self) -> None:
        """A better idea of the Car for the rest of the way, if the points give one."""
        with contextlib.suppress(NotLocated):
            self.car = self._fit().rectangle
            self.was_seen = True
