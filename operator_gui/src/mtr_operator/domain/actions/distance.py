"""The distance of the Remote key on a ray at an instant, with its uncertainty.

The uncertainty is 1 sigma, the root of the sum of squares of independent parts:
    position    of base_link in the Car coordinate system along the ray, or in its worst direction when the robot does
                not say more; the error of the Car's centre and heading is in it and is not added again,
    heading     sigma of the heading times the lever from base_link to the key across the ray,
    time        sigma of the instant (the CAN message's cycle is part of it) times the robot's speed, or how far the key
                was from there about that instant, as the root of its mean square, whichever is more: at the end of a
                way the robot stands, and may have moved within the cycle,
    outline     of a ray from the Car's outline: the error of the side where it begins takes the place of the error of
                the Car's centre, which the position holds.
It is NaN when the robot does not say how well it knows its pose.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Any, Mapping, Sequence

from ..geometry.outline import NO_ERROR, OriginError
from ..geometry.pose import Point, wrap_angle
from ..geometry.ray import Ray
from ..ports import CarEvent
from ..robot_status import CarDimensions
from .pose_history import PoseHistory, PoseSample


@dataclass(frozen=True)
class Distance:
    """Measured distance of the Remote key, in m, with 1 sigma, at an instant of robot time, and how it was carried.

    lateral_m: of the key, to the left of the ray seen from the Car. heading_rad: of the robot, from the way to the Car.
    source: what moved the Car's locks, key_number: of which key, doors: that it unlocked, see CarEvent. rest_s: for
    how long the key had been at rest, NaN where nobody asked.
    """

    distance_m: float
    uncertainty_m: float
    robot_time_s: float
    lateral_m: float = math.nan
    heading_rad: float = math.nan
    key_height_m: float = math.nan
    speed_mps: float = math.nan
    source: str = ""
    key_number: int | None = None
    doors: str = ""
    rest_s: float = math.nan

    def answered_by(self, event: CarEvent) -> Distance:
        """The same, of this change of the locks."""
        return replace(self, source=event.source, key_number=event.key_number, doors=event.doors)


# An instant that is as likely anywhere within a cycle of the message, as one is that a cyclic message tells.
_END_PER_SIGMA = math.sqrt(3.0)
# In a record what is not known is null; of these it is NaN here, of a key's number None.
_MAY_BE_NAN = {each.name for each in fields(Distance) if each.type == "float"}


def distance_from(values: Mapping[str, Any]) -> Distance:
    """The distance of which these are the fields in a record; TypeError when they are not those of one."""
    known: dict[str, Any] = {name: math.nan if value is None and name in _MAY_BE_NAN else value
                             for name, value in values.items()}
    return Distance(**known)


def recorded_values(distance: Distance | None) -> tuple[float | None, float | None, float | None]:
    """Distance, uncertainty and robot time as they are recorded; None for what is not known."""
    if distance is None:
        return None, None, None
    known = not math.isnan(distance.uncertainty_m)
    return (round(distance.distance_m, 6), round(distance.uncertainty_m, 6) if known else None,
            round(distance.robot_time_s, 6))


def measure_at(ray: Ray, poses: PoseHistory, time_s: float, time_sigma_s: float,
               origin: OriginError = NO_ERROR) -> Distance:
    """Distance on a ray at an instant of robot time; PoseUnknown when the pose then is not known well enough."""
    return measure(ray, poses.at(time_s), time_sigma_s, origin,
                   poses.about(time_s, _END_PER_SIGMA * time_sigma_s))


def measure(ray: Ray, sample: PoseSample, time_sigma_s: float, origin: OriginError = NO_ERROR,
            about: Sequence[PoseSample] = ()) -> Distance:
    """Distance on a ray when base_link is at the sample; about: poses at instants, evenly spread, that may be the one
    meant instead."""
    key_in_base = (sample.key_x, sample.key_y)
    lever_x, lever_y = sample.pose.rotate(key_in_base)
    across_m = ray.direction_y * lever_x - ray.direction_x * lever_y
    distance_m = ray.distance_of(sample.pose.apply(key_in_base))
    moved_m = [ray.distance_of(each.pose.apply(key_in_base)) - distance_m for each in about]
    time_m = max(abs(time_sigma_s * sample.speed_mps), math.hypot(*moved_m) / math.sqrt(max(len(moved_m), 1)))
    place_m = math.sqrt(max(position_sigma(ray, sample) ** 2 + origin.added_m2, origin.least_m ** 2))
    sigma_m = math.hypot(place_m, sample.heading_sigma_rad * across_m, time_m)
    return Distance(distance_m, sigma_m, sample.stamp_s, ray.offset_of(sample.pose.apply(key_in_base)),
                    wrap_angle(sample.pose.heading - ray.heading), sample.key_height_m, sample.speed_mps)


def position_sigma(ray: Ray, sample: PoseSample) -> float:
    """1 sigma of base_link along the ray, in m."""
    variance_x, variance_y, covariance = sample.covariance
    along = (ray.direction_x ** 2 * variance_x + ray.direction_y ** 2 * variance_y
             + 2.0 * ray.direction_x * ray.direction_y * covariance)
    return sample.position_sigma_m if math.isnan(along) else math.sqrt(max(along, 0.0))


def distance_to_outline(ray: Ray, distance_m: float, car: CarDimensions) -> float:
    """Distance of a point on the ray from the Car's rectangle, 0 inside."""
    return gap_to_outline(ray.point(distance_m), car)


def gap_to_outline(point: Point, car: CarDimensions) -> float:
    """Distance of a point of the Car coordinate system from the Car's rectangle, in m; 0 inside."""
    return math.hypot(max(abs(point[0]) - car.length / 2.0, 0.0), max(abs(point[1]) - car.width / 2.0, 0.0))
