"""The Car as it was found, with everything that is known of it."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Tuple

from ..rectangle import Point, Rectangle
from ..scan import NO_BIAS, RangeBias
from ..surfels import Surfels


@dataclass(frozen=True)
class PlaneSize:
    """Length and width in m of what the LiDARs' plane meets of the Car, 1 sigma each; None where an end or a side was
    not seen."""

    length: Optional[float] = None
    length_sigma: float = 0.0
    width: Optional[float] = None
    width_sigma: float = 0.0


class SideSigmas(NamedTuple):
    """1 sigma of where each side of the rectangle is, across itself at its middle, m: of centre and size together."""

    front: float
    rear: float
    left: float
    right: float

    def moved(self, along_m: float, across_m: float) -> "SideSigmas":
        """With independent 1 sigma of a motion of the whole Car added."""
        return SideSigmas(math.hypot(self.front, along_m), math.hypot(self.rear, along_m),
                          math.hypot(self.left, across_m), math.hypot(self.right, across_m))


# Nobody has measured it.
UNKNOWN_SIDES = SideSigmas(math.nan, math.nan, math.nan, math.nan)


@dataclass(frozen=True)
class CarFit:
    """The Car in map.

    Attributes:
        rectangle: pose of its centre, length and width over its widest parts, as far as they are known.
        outline: counterclockwise polygon in its own frame, without the gaps at the wheels.
        sigmas: 1 sigma of x, y (in its own frame, m) and heading (rad).
        length_sigma: m, 1 sigma.
        width_sigma: m, 1 sigma.
        seen: names of the sides that were seen.
        surfels: all that lie within its outline, in its own frame: sides, wheels, what is seen under it.
        quality: evidence that it is a Car, 0 to 1.
        by_wheels: length and centre come from the wheels alone.
        in_plane: what was measured.
        warning: sentence on a data sheet that does not agree with that.
        side_sigmas: 1 sigma of each side; those of the ends hold that front and rear may be known differently well.
        range_bias: constant errors of the LiDARs' ranges that the surfels are free of; it has to be taken off whatever
            is compared with them. Zero for surfels of ranges as they are: these share it with what is seen again.
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
    in_plane: PlaneSize = PlaneSize()
    warning: str = ""
    range_bias: RangeBias = NO_BIAS
    side_sigmas: SideSigmas = UNKNOWN_SIDES
