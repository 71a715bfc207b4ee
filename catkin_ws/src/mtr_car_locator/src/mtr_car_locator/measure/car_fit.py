"""The located Car with all its measurements."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Tuple

from ..rectangle import Point, Rectangle
from ..scan import NO_BIAS, RangeBias
from ..surfels import Surfels


@dataclass(frozen=True)
class PlaneSize:
    """Measured length and width in the scan plane, m, 1 sigma each; None if an end or a side was not seen."""

    length: Optional[float] = None
    length_sigma: float = 0.0
    width: Optional[float] = None
    width_sigma: float = 0.0


class SideSigmas(NamedTuple):
    """1 sigma of each side of the rectangle, perpendicular at its middle, m: of centre and size together."""

    front: float
    rear: float
    left: float
    right: float

    def moved(self, along_m: float, across_m: float) -> "SideSigmas":
        """Return the sigmas with an independent 1 sigma of a motion of the whole Car added."""
        return SideSigmas(math.hypot(self.front, along_m), math.hypot(self.rear, along_m),
                          math.hypot(self.left, across_m), math.hypot(self.right, across_m))


# Sides without a measurement.
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
        surfels: all surfels within its outline, in its own frame: sides, wheels, and objects under it.
        quality: evidence that it is a Car, 0 to 1.
        by_wheels: length and centre are derived from the wheels only.
        in_plane: measured size in the scan plane.
        warning: sentence about a contradicting data sheet.
        contradiction: the part of the warning about contradictions; empty if the data sheet may be of this Car.
        side_sigmas: 1 sigma of each side; front and rear may differ.
        range_bias: constant range errors of the LiDARs that the surfels are corrected for; scans that are compared with
            them need the same correction. Zero for surfels of uncorrected ranges, which share the bias with new scans.
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
    contradiction: str = ""
