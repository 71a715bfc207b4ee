"""A Car whose bumpers the LiDARs look under: its length and centre from the wheels alone."""
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

# Surface so near the side's level is the outer face of a tyre; pieces farther apart than the gap may be two things,
# and those of one tyre, with what stands beside it, together are no longer than a face.
FACE_DEPTH_M, GAP_M = 0.08, 0.15
MIN_FACE_M, MAX_FACE_M = 0.25, 0.95
MIN_WHEELBASE_M, MAX_WHEELBASE_M = 1.8, 4.0
# The axles of one side must not differ more from those of the other; the ends of the faces may be missing.
SQUARE_M = 0.20
# Faces that all returns tell must agree better.
EXACT_SQUARE_M = 0.05
# A tread is square to the Car within 18 degrees, which its rounded shoulder is not; it is no broader than this.
TREAD_COSINE, TYRE_WIDTH_M = 0.95, 0.30
# Between two wheels the LiDARs look under the Car: mirrors and steps together are shorter than this, a sill is longer.
MAX_BETWEEN_M = 0.4
# Two pairs of wheels nearer to each other than this are two readings of one.
SAME_WHEELS_M = 0.8


class Face(NamedTuple):
    """What may be a tyre's outer face, from low to high along its side, m."""

    low_m: float
    high_m: float

    @property
    def middle_m(self) -> float:
        """Where the axle is."""
        return 0.5 * (self.low_m + self.high_m)

    @property
    def size_m(self) -> float:
        """How long it is."""
        return self.high_m - self.low_m


# The rear and the front one of a side.
FacePair = Tuple[Face, Face]


@dataclass(frozen=True)
class CarWheels:
    """The Car along its x axis, as its wheels tell, in the frame of the sides."""

    axles: Axles
    ends: Ends


def wheel_sides(in_frame: Surfels) -> Dict[str, Side]:
    """Outer faces and treads of all tyres, on the sides to which they face."""
    return {**{name: side_of(name, in_frame, -math.inf) for name in LONG_SIDES},
            **{name: side_of(name, in_frame, -math.inf, TREAD_COSINE) for name in ENDS}}


def wheels_between(sides: Dict[str, Side], y: float, width: float, sheet: DataSheet) -> List[CarWheels]:
    """Both axles, when each long side shows two wheels at its level and next to nothing between them; the pairs that
    are squarest to each other first. A car parked in line has wheels at the same levels, too."""
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
    """Both axles from exact outer faces along the left and the right side, m from about the Car's middle; None when
    these do not stand as a car's do.

    What else is as long as a tyre at that level, such as the end of a bumper, is told by the other side and by the
    wheelbase; that something lengthens a face or hides its end, such as a mirror beside it, by their sizes.
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
    """1 sigma of a face's middle, which is off by half of what the face is too long or too short.

    Which of the sizes is right is not known. Both sides of the Car are alike, as is the ground below them, so that
    their mean is no surer than one of them.
    """
    too_long_m = max(0.0, _off_size_m(left, right) - FACE_SIZE_NOISE_M)
    return math.hypot(math.sqrt(2.0) * EXACT_FACE_SIGMA_M, math.sqrt(0.5) * too_long_m)


def off_square_m(left: FacePair, right: FacePair) -> float:
    """How far the axles of one side are from those of the other."""
    return max(abs(one.middle_m - other.middle_m) for one, other in zip(left, right))


def _off_size_m(left: FacePair, right: FacePair) -> float:
    """How much the four differ in size: a car has four tyres of one size."""
    sizes = [each.size_m for each in (*left, *right)]
    return max(sizes) - min(sizes)


def face_pairs(side: Side, level: float) -> Iterator[FacePair]:
    """What may be the two wheels along a side."""
    along = np.sort(side.along[np.abs(side.outward - level) <= FACE_DEPTH_M])
    parts = np.split(along, np.nonzero(np.diff(along) > GAP_M)[0] + 1)
    pieces = [Face(float(part[0]), float(part[-1])) for part in parts if len(part)]
    # Of one wheel a part may be missing, and beside it something may stand: neighbouring pieces are tried together.
    joined = (Face(first.low_m, last.high_m) for first, last in itertools.combinations_with_replacement(pieces, 2))
    faces = [each for each in joined if MIN_FACE_M <= each.size_m <= MAX_FACE_M]
    for rear, front in itertools.product(faces, faces):
        between_m = sum(each.size_m for each in pieces if rear.high_m < each.low_m and each.high_m < front.low_m)
        if MIN_WHEELBASE_M <= front.middle_m - rear.middle_m <= MAX_WHEELBASE_M and between_m <= MAX_BETWEEN_M:
            yield rear, front


def car_on(axles: Axles, sheet: DataSheet) -> CarWheels:
    """The Car on these axles, by the prior of the overhangs and what its data sheet says."""
    return CarWheels(axles, ends_on(axles, sheet))
