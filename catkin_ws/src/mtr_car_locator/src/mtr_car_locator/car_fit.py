"""The Car as it was found, with everything that is known of it."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Tuple

from .rectangle import Rectangle
from .surfels import Surfels

Point = Tuple[float, float]


@dataclass(frozen=True)
class CarFit:
    """The Car in map.

    Attributes:
        rectangle: pose of its centre, length and width.
        outline: counterclockwise polygon in its own frame, without the gaps at the wheels.
        sigmas: 1 sigma of x, y (in its own frame, m) and heading (rad).
        length_sigma: m, 1 sigma.
        width_sigma: m, 1 sigma.
        seen: names of the sides that were seen.
        surfels: all that lie within its outline, in its own frame: sides, wheels, what is seen under it.
        quality: evidence that it is a Car, 0 to 1.
        by_wheels: length and centre come from the wheels alone.
    """

    rectangle: Rectangle
    outline: Tuple[Point, ...]
    sigmas: Tuple[float, float, float]
    length_sigma: float
    width_sigma: float
    seen: Tuple[str, ...]
    surfels: Surfels
    quality: float
    by_wheels: bool = False
