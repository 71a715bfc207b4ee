"""Length and centre of a Car whose bumpers are above the scan plane, from its wheels only."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from dataclasses import dataclass
from typing import Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from ..parameters import DataSheet
from ..surfels import Surfels
from .axles import EXACT_FACE_SIGMA_M, FACE_SIZE_NOISE_M, Axles, axles_at, axles_between
from .ends import Ends
from .overhangs import ends_on
from .side import ENDS, LONG_SIDES, Side, side_of

# Surface this near the side's level is the outer face of a tyre. Pieces with a larger gap may be two objects; pieces of
# one tyre with an adjacent object are together not longer than a face.
FACE_DEPTH_M, GAP_M = 0.08, 0.15
MIN_FACE_M, MAX_FACE_M = 0.25, 0.95
MIN_WHEELBASE_M, MAX_WHEELBASE_M = 1.8, 4.0
# Largest difference between the axles of both sides; ends of the faces may be missing.
SQUARE_M = 0.20
# Limit for faces from all returns.
EXACT_SQUARE_M = 0.05
# A tread is perpendicular to the Car within 18 degrees, unlike its rounded shoulder; it is not wider than this.
TREAD_COSINE, TYRE_WIDTH_M = 0.95, 0.30
# Between two wheels, the LiDARs look under the Car: mirrors and steps together are shorter than this, a sill is longer.
MAX_BETWEEN_M = 0.4
# Two pairs of wheels closer than this are the same pair.
SAME_WHEELS_M = 0.8


class Face(NamedTuple):
    """Possible outer face of a tyre, from low to high along its side, m."""

    low_m: float
    high_m: float

    @property
    def middle_m(self) -> float:
        """Position of the axle."""
        return 0.5 * (self.low_m + self.high_m)

    @property
    def size_m(self) -> float:
        """Length of the face."""
        return self.high_m - self.low_m


# Rear and front face of a side.
FacePair = Tuple[Face, Face]


@dataclass(frozen=True)
class CarWheels:
    """The Car along its x axis from its wheels, in the frame of the sides."""

    axles: Axles
    ends: Ends


def wheel_sides(in_frame: Surfels) -> Dict[str, Side]:
    """Return outer faces and treads of all tyres, by the sides that they face."""
    return {**{name: side_of(name, in_frame, -math.inf) for name in LONG_SIDES},
            **{name: side_of(name, in_frame, -math.inf, TREAD_COSINE) for name in ENDS}}


def wheels_between(sides: Dict[str, Side], y: float, width: float, sheet: DataSheet) -> List[CarWheels]:
    """Return both axles if each long side has two wheels at its level with almost nothing in between.

    The squarest pairs come first. A car parked in line has wheels at the same levels, too.
    """
    levels = {"left": 0.5 * width + y, "right": 0.5 * width - y}
    left, right = (list(face_pairs(sides[name], levels[name])) for name in LONG_SIDES)
    square = [each for each in itertools.product(left, right) if off_square_m(*each) <= SQUARE_M]
    axles: List[FloatArray] = []
    for both in sorted(square, key=lambda each: off_square_m(*each) + _off_size_m(*each)):
        found = np.mean([[rear.middle_m, front.middle_m] for rear, front in both], axis=0)
        if all(np.max(np.abs(found - other)) > SAME_WHEELS_M for other in axles):
            axles.append(found)
    widths = ((y + 0.5 * width - TYRE_WIDTH_M, y + 0.5 * width), (y - 0.5 * width, y - 0.5 * width + TYRE_WIDTH_M))
    ahead, behind = ([sides[name].within(*each) for each in widths] for name in ENDS)
    return [car_on(axles_at(float(front), float(rear), ahead, behind, sheet.wheelbase_m), sheet)
            for rear, front in axles]


def wheels_from(faces: Sequence[Sequence[Face]], sheet: DataSheet) -> Optional[CarWheels]:
    """Return both axles from exact outer faces of both sides, m from about the Car's middle; None without a match.

    The other side and the wheelbase exclude other objects of a tyre's length at that level, such as the end of a
    bumper. The face sizes reveal objects that extend a face or hide its end, such as a mirror.
    """
    pairs = [[(rear, front) for rear, front in itertools.permutations(each, 2)
              if MIN_WHEELBASE_M <= front.middle_m - rear.middle_m <= MAX_WHEELBASE_M] for each in faces]
    both = [(left, right) for left, right in itertools.product(*pairs)
            if off_square_m(left, right) <= EXACT_SQUARE_M
            and abs(sum(each.middle_m for each in (*left, *right))) < 4.0 * SAME_WHEELS_M]
    if sheet.wheelbase_m:
        both = [each for each in both if all(abs(front.middle_m - rear.middle_m - sheet.wheelbase_m) <= EXACT_SQUARE_M
                                             for rear, front in each)]
    if len(both) != 1:
        return None
    sigma_m = _face_sigma_m(*both[0])
    rears, fronts = zip(*[[(each.middle_m, sigma_m) for each in side] for side in both[0]])
    return car_on(axles_between(fronts, rears, sheet.wheelbase_m), sheet)


def _face_sigma_m(left: FacePair, right: FacePair) -> float:
    """Return 1 sigma of a face's middle, which is off by half of the length error.

    The correct length is unknown. Both sides of the Car, and the ground below them, are alike, so their mean is not
    more certain than one of them.
    """
    too_long_m = max(0.0, _off_size_m(left, right) - FACE_SIZE_NOISE_M)
    return math.hypot(math.sqrt(2.0) * EXACT_FACE_SIGMA_M, math.sqrt(0.5) * too_long_m)


def off_square_m(left: FacePair, right: FacePair) -> float:
    """Return the largest difference between the axles of both sides."""
    return max(abs(one.middle_m - other.middle_m) for one, other in zip(left, right))


def _off_size_m(left: FacePair, right: FacePair) -> float:
    """Return the largest size difference of the four faces: a car has four tyres of one size."""
    sizes = [each.size_m for each in (*left, *right)]
    return max(sizes) - min(sizes)


def face_pairs(side: Side, level: float) -> Iterator[FacePair]:
    """Yield possible pairs of wheels along a side."""
    along = np.sort(side.along[np.abs(side.outward - level) <= FACE_DEPTH_M])
    parts = np.split(along, np.nonzero(np.diff(along) > GAP_M)[0] + 1)
    pieces = [Face(float(part[0]), float(part[-1])) for part in parts if len(part)]
    # A part of a wheel may be missing, or an object may be adjacent, so neighbouring pieces are also tried together.
    joined = (Face(first.low_m, last.high_m) for first, last in itertools.combinations_with_replacement(pieces, 2))
    faces = [each for each in joined if MIN_FACE_M <= each.size_m <= MAX_FACE_M]
    for rear, front in itertools.product(faces, faces):
        between_m = sum(each.size_m for each in pieces if rear.high_m < each.low_m and each.high_m < front.low_m)
        if MIN_WHEELBASE_M <= front.middle_m - rear.middle_m <= MAX_WHEELBASE_M and between_m <= MAX_BETWEEN_M:
            yield rear, front


def car_on(axles: Axles, sheet: DataSheet) -> CarWheels:
    """Return the Car on these axles, from the prior of the overhangs and the data sheet."""
    return CarWheels(axles, ends_on(axles, sheet))
