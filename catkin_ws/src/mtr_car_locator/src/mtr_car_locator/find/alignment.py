"""Alignment of a candidate rectangle with surfels, and for a Car on wheels with all returns."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Dict, Optional

from mtr_core.se2 import Pose2

from .. import problems
from ..measure.axis import SymmetryAxis, axis_of
from ..measure.belonging import belongs
from ..measure.close_up import CloseUp
from ..measure.measurement import BEYOND_M, AlignedCar, extents_of, sized
from ..measure.side import ENDS, LONG_SIDES, SideExtent, sides_of
from ..measure.tyre_faces import faces_in
from ..measure.wheels import CarWheels, wheel_sides, wheels_between, wheels_from
from ..parameters import DataSheet
from ..rectangle import Rectangle
from ..surfels import Surfels
from .errors import NotLocated

ROUNDS = 4
# The first round uses a larger gate, because the rectangle is rough.
FIRST_BEYOND_M = 0.12


class Alignment:
    """Fits rectangles to given surfels in map."""

    def __init__(self, seen: Surfels, close_up: Optional[CloseUp], sheet: DataSheet, *, on_wheels: bool):
        """Create an alignment.

        close_up: all returns near the Car, or None; on_wheels: neither front nor rear was seen.
        """
        self._seen, self._close_up, self._sheet, self._on_wheels = seen, close_up, sheet, on_wheels

    def aligned(self, car: Rectangle) -> AlignedCar:
        """Return the rectangle aligned with the surfels; NotLocated if they do not determine it."""
        found = self._moved(car, FIRST_BEYOND_M)
        for _ in range(ROUNDS - 1):
            found = self._moved(found.car, BEYOND_M)
        return found if self._on_wheels else replace(found, wheels=None)

    def _moved(self, rough: Rectangle, beyond_m: float) -> AlignedCar:
        axis = self._axis(rough, beyond_m)
        car = rough.moved_by(Pose2(0.0, axis.offset_m if axis.is_centred else 0.0, math.atan(axis.slope)))
        in_car = self._seen.in_frame(car.pose)
        extents = extents_of(sides_of(in_car.where(belongs(in_car, car, FIRST_BEYOND_M))), car)
        wheels = self._wheels(in_car, car, extents)
        return AlignedCar(sized(car, extents, axis, wheels, self._sheet), axis, wheels)

    def _axis(self, car: Rectangle, beyond_m: float) -> SymmetryAxis:
        in_car = self._seen.in_frame(car.pose)
        sides = sides_of(in_car.where(belongs(in_car, car, beyond_m)))
        axis = axis_of(*(sides[name] for name in LONG_SIDES), length=car.length)
        if axis is None:
            raise NotLocated(problems.HEADING_UNSEEN())
        return axis

    def _wheels(self, in_car: Surfels, car: Rectangle, extents: Dict[str, SideExtent]) -> Optional[CarWheels]:
        """Return the wheels if they must determine the Car's position along its axis, otherwise None.

        A single end leaves the rectangle too rough to assign surfels to the Car.
        """
        lacks_an_end = not all(name in extents for name in ENDS)
        if not self._on_wheels and not lacks_an_end:
            return None
        wheels = self._exact_wheels(car)
        return self._rough_wheels(in_car, car) if wheels is None and self._on_wheels else wheels

    def _exact_wheels(self, car: Rectangle) -> Optional[CarWheels]:
        if self._close_up is None:
            return None
        in_car = self._close_up.in_frame(car.pose)
        return wheels_from([faces_in(in_car, name, 0.5 * car.width, in_arches=not self._on_wheels)
                            for name in LONG_SIDES], self._sheet)

    def _rough_wheels(self, in_car: Surfels, car: Rectangle) -> CarWheels:
        found = wheels_between(wheel_sides(in_car), 0.0, car.width, self._sheet)
        if not found:
            raise NotLocated(problems.WHEELS_APART())
        return min(found, key=lambda each: abs(each.ends.centre_m))
