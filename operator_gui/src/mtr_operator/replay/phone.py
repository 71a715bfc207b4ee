"""Recomputes the phone's distances of a Digital key test from a signal of the Car's bus, by its log and a profile."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Mapping

from mtr_operator.car_link.phone.car_signal import CarSignalFeed, PhoneSignal, is_bus_feed
from mtr_operator.car_link.profile import CarProfile
from mtr_operator.domain.actions.distance import Distance, measure_at
from mtr_operator.domain.actions.pose_history import PoseHistory
from mtr_operator.domain.distance_feed import Reported
from mtr_operator.domain.geometry.outline import OriginError
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import PHONE_FEED
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus
from mtr_operator.domain.scenario import ScenarioParameters
from mtr_operator.domain.scenarios.digital_key.constant import beside_others
from mtr_operator.domain.scenarios.digital_key.parameters import DigitalKeyParameters
from mtr_operator.domain.scenarios.digital_key.place_result import place_result, stood_at
from mtr_operator.domain.scenarios.digital_key.places import MapPlace, places_around
from mtr_operator.domain.scenarios.digital_key.reading import read
from mtr_operator.domain.scenarios.digital_key.result import DigitalKeyResult

from .cannot import CannotReplay


class ReplayedPhone:
    """Phone distances, updated with consecutive recorded runs. places: of the test, by their number.

    Attributes: frame: receives each frame of the log.
    """

    def __init__(self, signal: PhoneSignal, parameters: DigitalKeyParameters, car: CarDimensions):
        self._feed = CarSignalFeed(signal)
        self._parameters = parameters
        self._car = car
        self._places: Mapping[int, MapPlace] = {place.number: place for place in places_around(parameters, car)}
        self._heard: list[Reported] = []
        self._begun_s = math.nan
        self._results: dict[int, DigitalKeyResult] = {}
        self.frame = self._feed.frame

    def observe(self, status: RobotStatus) -> None:
        """Add a Status after the log was read up to it."""
        self._heard += self._feed.observe(status)

    def forget(self) -> None:
        """Discard earlier distances, which belong to another clock or run."""
        self._heard = []

    def begin(self, now_s: float) -> None:
        """Start the measurement at a place where the robot has stopped."""
        self._begun_s = now_s

    def result(self, number: int, made: Distance, poses: PoseHistory, now_s: float) -> DigitalKeyResult:
        """Return the result of the place at which the robot was stopped until now; made: on the place's ray.

        PoseUnknown, or LineInvalid, if the position of the phone is unknown.
        """
        def key_distance(ray: Ray, time_s: float, origin: OriginError) -> Distance:
            return measure_at(ray, poses, time_s, 0.0, origin)

        line = self._places[number]
        stood = stood_at(line, made, self._parameters, self._car, key_distance)
        reading = read(self._heard, (self._begun_s, now_s), self._parameters)
        result = beside_others(place_result(line, reading, stood), list(self._results.values()))
        former = self._results.get(number)
        # As in the test, a repeated measurement counts unless it is worse.
        if former is None or former.invalid_count >= result.invalid_count:
            self._results[number] = result
        return result


def replayed_phone(parameters: ScenarioParameters, progress: Progress, profile: CarProfile) -> ReplayedPhone | None:
    """Return the phone; None for a test without one. CannotReplay if the phone's distances are not in the log of the
    bus."""
    if not isinstance(parameters, DigitalKeyParameters) or progress.car is None:
        return None
    source = progress.session.get(PHONE_FEED, "")
    if not is_bus_feed(source):
        raise CannotReplay(f"The phone's distances came from {source or 'nobody knows where'}, not over the Car's bus: "
                           "its log does not hold them, and none can be computed anew.")
    if not isinstance(profile.phone, PhoneSignal):
        raise CannotReplay(f"The car profile {profile.name} names no signal with the phone's distance "
                           "(phone_distance); choose one that does.")
    return ReplayedPhone(profile.phone, parameters, progress.car)
