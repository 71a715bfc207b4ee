"""The car locator: at each tick from mode, pose and scans to the estimate of the Car."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, Optional, Tuple

from mtr_core.se2 import Pose2
from mtr_core.states import CarState

from .fit import CarFit, NotLocated
from .parameters import LocatorParameters
from .poses import PoseHistory
from .rectangle import Rectangle, prior_from
from .scan import Scan
from .survey import Place, Survey

# Sigma of what the starting place alone tells.
PRIOR_POSITION_SIGMA_M, PRIOR_HEADING_SIGMA_RAD = 0.5, 0.1
POSITION_SIGMA_MIN_M = 0.01
NOWHERE = Pose2(0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Order:
    """What the state machine wants: mapping, under which id, and the goal that the motion planner has."""

    mapping: bool
    map_car_id: int
    goal_id: int
    goal_x: float
    goal_y: float


@dataclass(frozen=True)
class Drive:
    """What the motion planner says: the goal it speaks of, and whether it is done with it, well or not."""

    goal_id: int
    is_settled: bool


@dataclass(frozen=True)
class Estimate:
    """What is known of the Car at a tick; sigmas are (x, y, heading) in the Car's frame."""

    state: CarState
    rectangle: Rectangle
    outline: Tuple[Tuple[float, float], ...]
    sigmas: Tuple[float, float, float]
    length_sigma: float
    width_sigma: float
    place: Optional[Place]
    map_car_id: int
    message: str


class CarLocator:
    """Collects points while the mode says so, and then keeps the Car's frame where it was found."""

    def __init__(self, parameters: LocatorParameters):
        self._parameters = parameters
        self._poses = PoseHistory()
        self._survey: Optional[Survey] = None
        self._fit: Optional[CarFit] = None
        self._state = CarState.UNKNOWN
        self._was_mapping = False
        self._map_car_id = 0
        self._next_place_id = 1
        self._message = ""

    @property
    def needs_poses(self) -> bool:
        """False while the Car's frame stands and nobody asks for a new one."""
        return self._state != CarState.LOCATED

    def wants_scans(self, order: Optional[Order]) -> bool:
        """True while scans are collected or about to be."""
        return order is not None and order.mapping and (self._state == CarState.COLLECTING or self._is_new(order))

    def add_pose(self, time_s: float, pose: Pose2) -> None:
        """Take a valid pose of the robot."""
        if pose.is_finite():
            self._poses.add(time_s, pose)

    def step(self, now_s: float, order: Optional[Order], drive: Optional[Drive], scans: List[Scan]) -> Estimate:
        """Estimate at a tick; all poses up to the tick have been added."""
        mapping = order is not None and order.mapping
        if mapping and not self._poses.is_empty():
            if self._is_new(order):
                self._begin(now_s, order.map_car_id)
            if self._state == CarState.COLLECTING:
                self._collect(now_s, order, drive, scans)
        self._was_mapping = mapping
        return self._estimate()

    def _is_new(self, order: Order) -> bool:
        if self._state == CarState.UNKNOWN or order.map_car_id != self._map_car_id:
            return True
        return self._state == CarState.FAILED and not self._was_mapping

    def _begin(self, now_s: float, map_car_id: int) -> None:
        prior = self._fit.rectangle if self._fit else prior_from(self._poses.newest(), self._parameters)
        self._survey = Survey(prior, now_s, self._next_place_id, self._parameters)
        self._state, self._map_car_id = CarState.COLLECTING, map_car_id

    def _collect(self, now_s: float, order: Order, drive: Optional[Drive], scans: List[Scan]) -> None:
        survey = self._survey
        survey.collect(scans, self._poses)
        survey.advance(now_s, self._poses.newest(), is_settled_at(survey.place, order, drive))
        if survey.place:
            self._next_place_id = survey.place.place_id + 1
        self._message = survey.progress
        if survey.finished:
            self._finish(survey)

    def _finish(self, survey: Survey) -> None:
        try:
            self._fit = survey.result()
        except NotLocated as reason:
            self._fit, self._state = None, CarState.FAILED
            self._message = f"The Car was not found. {reason} Put the robot at the starting place and map again."
            return
        self._state = CarState.LOCATED
        found = self._fit.rectangle
        self._message = f"The Car was found: {found.length:.2f} m long, {found.width:.2f} m wide."

    def _estimate(self) -> Estimate:
        if self._state == CarState.LOCATED:
            return self._found(self._fit)
        if self._survey:
            car, was_seen = self._survey.car, self._survey.was_seen
        elif self._poses.is_empty():
            return self._rough(Rectangle(NOWHERE, 0.0, 0.0), (), "The robot's pose is not known yet.")
        else:
            car, was_seen = prior_from(self._poses.newest(), self._parameters), False
        margin = self._parameters.seen_margin_m if was_seen else self._parameters.prior_margin_m
        return self._rough(car, tuple(car.outline(margin)), self._message)

    def _rough(self, car: Rectangle, outline: Tuple[Tuple[float, float], ...], message: str) -> Estimate:
        place = self._survey.place if self._survey and self._state == CarState.COLLECTING else None
        sigma, size_sigma = PRIOR_POSITION_SIGMA_M, 0.5 * self._parameters.size_tolerance_m
        return Estimate(self._state, car, outline, (sigma, sigma, PRIOR_HEADING_SIGMA_RAD), size_sigma, size_sigma,
                        place, self._map_car_id, message)

    def _found(self, fit: CarFit) -> Estimate:
        sigmas = (max(0.5 * fit.length_sigma, POSITION_SIGMA_MIN_M), max(0.5 * fit.width_sigma, POSITION_SIGMA_MIN_M),
                  fit.heading_sigma)
        return Estimate(self._state, fit.rectangle, tuple(fit.rectangle.outline()), sigmas, fit.length_sigma,
                        fit.width_sigma, None, self._map_car_id, self._message)


def is_settled_at(place: Optional[Place], order: Order, drive: Optional[Drive]) -> bool:
    """True when the motion planner has ended the drive to the place, which the state machine gives an id of its own."""
    if place is None or drive is None or not drive.is_settled or order.goal_id == 0 or drive.goal_id != order.goal_id:
        return False
    return abs(order.goal_x - place.pose.x) < 1e-6 and abs(order.goal_y - place.pose.y) < 1e-6
