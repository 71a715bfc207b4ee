"""Uncertainty of a line's origin on the Car's outline, from the side or sides at which it begins."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from ..robot_status import CarDimensions
from .ray import Ray

FRONT, REAR, LEFT, RIGHT = SIDES = "front", "rear", "left", "right"


@dataclass(frozen=True)
class SideError:
    """Position error of a side of the Car, common to all lines that begin on it.

    Attributes:
        side: front, rear, left or right.
        sigma_m: 1 sigma across the side, of the Car's centre and size together.
        share: part of the error that moves the line's origin along the line, 0 to 1.
    """

    side: str
    sigma_m: float
    share: float

    @property
    def along_m(self) -> float:
        """1 sigma along the line."""
        return self.share * self.sigma_m


def side_errors(ray: Ray, car: CarDimensions) -> tuple[SideError, ...]:
    """Return the errors of the sides at which a line begins, two at a corner.

    Empty for a line from the centre, or if the robot does not report the accuracy of each side.
    """
    if ray.begins_in_centre or not car.knows_sides:
        return ()
    sides = (SideError(FRONT if ray.direction_x > 0.0 else REAR,
                       car.front_sigma if ray.direction_x > 0.0 else car.rear_sigma, abs(ray.direction_x)),
             SideError(LEFT if ray.direction_y > 0.0 else RIGHT,
                       car.left_sigma if ray.direction_y > 0.0 else car.right_sigma, abs(ray.direction_y)))
    return tuple(side for side in sides if side.share > 1e-9)


class OriginError(NamedTuple):
    """Contribution of a line's origin to the uncertainty of a position along it.

    Attributes:
        added_m2: added to the variance of a position in the Car coordinate system, which includes the error of the
        Car's
            centre. It replaces this error by the error of the side at which the line begins: negative if the side is
            known better.
        least_m: 1 sigma of the origin alone.
    """

    added_m2: float
    least_m: float


NO_ERROR = OriginError(0.0, 0.0)


def origin_error(ray: Ray, car: CarDimensions) -> OriginError:
    """Return the error of a line's origin on the Car's outline; zero for the Car's centre."""
    least_m = math.hypot(*(side.along_m for side in side_errors(ray, car)))
    return NO_ERROR if ray.begins_in_centre else OriginError(_added_variance(ray, car), least_m)


def _added_variance(ray: Ray, car: CarDimensions) -> float:
    along, across = ray.direction_x ** 2, ray.direction_y ** 2
    sizes = (along * car.length_sigma ** 2 + across * car.width_sigma ** 2) / 4.0
    if not car.knows_sides:
        return sizes
    # Half the difference of opposite sides' variances is the covariance of centre and size.
    ends, sides = (car.front_sigma ** 2 - car.rear_sigma ** 2) / 2.0, (car.left_sigma ** 2 - car.right_sigma ** 2) / 2.0
    return sizes + math.copysign(along, ray.direction_x) * ends + math.copysign(across, ray.direction_y) * sides
