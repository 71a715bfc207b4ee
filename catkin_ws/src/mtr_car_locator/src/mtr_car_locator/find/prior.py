"""Expected pose of the Car, from the Operator or an earlier map."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Tuple

from mtr_core.se2 import Pose2, wrap_angle

from ..parameters import LocatorParameters
from ..rectangle import Rectangle


@dataclass(frozen=True)
class Prior:
    """Prior guess of the Car.

    Attributes:
        car: expected rectangle.
        pivot: pose on which the guess is based, given relative to the Car: the placement of the robot. A heading error
            there moves the Car on an arc about it.
    """

    car: Rectangle
    pivot: Pose2

    def error_of(self, car: Pose2) -> Tuple[float, float]:
        """Return the error of the guess for a true pose of the Car: m and rad, of the pivot as seen from the Car."""
        assumed, actual = self.car.pose.inverse() @ self.pivot, car.inverse() @ self.pivot
        return assumed.distance_to(actual), abs(wrap_angle(actual.heading - assumed.heading))

    @property
    def reach_m(self) -> float:
        """Distance of the Car's centre from the pivot."""
        return self.car.pose.distance_to(self.pivot)


def prior_from_start(robot: Pose2, parameters: LocatorParameters) -> Prior:
    """Return the expected Car for a robot at the starting place."""
    pose = robot @ parameters.car_from_start.inverse()
    return Prior(Rectangle(pose, parameters.sheet.length_m, parameters.sheet.width_m), robot)


def prior_at(car: Rectangle) -> Prior:
    """Return the prior for a previously located Car."""
    return Prior(car, car.pose)
