"""A substitute robot in a hall, which it sees: walls, the Car, and its own way."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
from typing import Iterator

from mtr_operator.domain.robot_status import CarDimensions, RobotStatus
from mtr_operator.domain.surroundings import StopZone, Surroundings
from mtr_operator.robot_link.virtual.robot import VirtualRobot

# Half sides of the hall, whose middle is the Car's, and beams.
HALF_LENGTH_M, HALF_WIDTH_M = 9.0, 7.0
BEAMS = 360


class SeeingRobot(VirtualRobot):
    """Sees in every second Status, as the real one does."""

    def status(self) -> RobotStatus:
        """See VirtualRobot."""
        told = super().status()
        if told.id % 2 or told.car is None:
            return told
        points = tuple(_return(told, told.car, 2.0 * math.pi * beam / BEAMS) for beam in range(BEAMS))
        way = ((told.x, told.y), *self._way) if self._way else ()
        return dataclasses.replace(told, surroundings=Surroundings(points, way, StopZone.CLEAR))


def _return(status: RobotStatus, car: CarDimensions, bearing: float) -> tuple:
    """Where a beam of base_link ends."""
    ahead, left = math.cos(status.heading + bearing), math.sin(status.heading + bearing)
    far = min(_crossings(status, ahead, left, HALF_LENGTH_M, HALF_WIDTH_M), default=0.0)
    near = min(_crossings(status, ahead, left, car.length / 2.0, car.width / 2.0), default=far)
    return near * math.cos(bearing), near * math.sin(bearing)


def _crossings(status: RobotStatus, ahead: float, left: float, half_x: float, half_y: float) -> Iterator[float]:
    """Distances to the sides of a rectangle around the origin."""
    for place, step, half, other, other_step, other_half in (
            (status.x, ahead, half_x, status.y, left, half_y), (status.y, left, half_y, status.x, ahead, half_x)):
        for side in (-half, half) if step else ():
            distance = (side - place) / step
            if distance > 0.0 and abs(other + distance * other_step) <= other_half:
                yield distance
