"""A Car whose bumpers the LiDARs look under: its length and centre from the wheels alone."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np

from ..parameters import DataSheet
from ..surfels import Surfels
from .axles import Axles, axles_at, axles_between
from .side import ENDS, LONG_SIDES, Side, side_of

# Surface so near the side's level is the outer face of a tyre; pieces farther apart than the gap are two wheels.
FACE_DEPTH_M, GAP_M = 0.08, 0.5
MIN_FACE_M, MAX_FACE_M = 0.25, 0.95
MIN_WHEELBASE_M, MAX_WHEELBASE_M = 1.8, 4.0
# The axles of one side must not differ more from those of the other; the ends of the faces may be missing.
SQUARE_M = 0.20
# Faces that all returns tell must agree better.
EXACT_SQUARE_M = 0.05
# A tread is square to the Car within 18 degrees, which its rounded shoulder is not; it is no broader than this.
TREAD_COSINE, TYRE_WIDTH_M = 0.95, 0.30
# The wheelbase of passenger cars is 0.56 to 0.63 of the length, and the front overhang 0.15 m shorter than the rear one
# to 0.15 m longer; these are the middles of the ranges and a third of their widths, see the README.
WHEELBASE_SHARE, WHEELBASE_SHARE_SIGMA = 0.595, 0.02
OVERHANG_SIGMA_M = 0.08
# A data sheet's length and overhang differ from this Car's by number plates, load and trim levels.
DATA_SHEET_SIGMA_M = 0.005


@dataclass(frozen=True)
class CarWheels:
    """The Car along its x axis, as its wheels tell, in the frame of the sides; 1 sigma each."""

    front_axle_m: float
    rear_axle_m: float
    centre_m: float
    centre_sigma_m: float
    length_m: float
    length_sigma_m: float


def wheel_sides(in_frame: Surfels) -> Dict[str, Side]:
    """Outer faces and treads of all tyres, on the sides to which they face."""
    return {**{name: side_of(name, in_frame, -math.inf) for name in LONG_SIDES},
            **{name: side_of(name, in_frame, -math.inf, TREAD_COSINE) for name in ENDS}}


def wheels_between(sides: Dict[str, Side], y: float, width: float, sheet: DataSheet) -> Optional[CarWheels]:
    """Both axles, when each long side shows two wheels at its level and nothing between them; else None."""
    levels = {"left": 0.5 * width + y, "right": 0.5 * width - y}
    faces = [wheel_faces(sides[name], levels[name]) for name in LONG_SIDES]
    if any(len(each) != 2 for each in faces) or np.any(np.ptp(faces, axis=0) > SQUARE_M):
        return None
    rear, front = np.mean(faces, axis=0).tolist()
    if not MIN_WHEELBASE_M <= front - rear <= MAX_WHEELBASE_M:
        return None
    widths = ((y + 0.5 * width - TYRE_WIDTH_M, y + 0.5 * width), (y - 0.5 * width, y - 0.5 * width + TYRE_WIDTH_M))
    ahead, behind = ([sides[name].within(*each) for each in widths] for name in ENDS)
    return _from_axles(axles_at(front, rear, ahead, behind, sheet.wheelbase_m), sheet)


def wheels_from(faces: Sequence[Sequence[float]], sheet: DataSheet) -> Optional[CarWheels]:
    """Both axles from exact middles of the outer faces along the left and the right side, m; None when these do not
    stand as a car's do.

    What else is as long as a tyre at that level, such as the end of a bumper, is told by the other side and by the
    wheelbase.
    """
    pairs = [[pair for pair in itertools.combinations(sorted(each), 2)
              if MIN_WHEELBASE_M <= pair[1] - pair[0] <= MAX_WHEELBASE_M] for each in faces]
    both = [(left, right) for left, right in itertools.product(*pairs)
            if max(abs(left[0] - right[0]), abs(left[1] - right[1])) <= EXACT_SQUARE_M]
    if sheet.wheelbase_m:
        both = [each for each in both if all(abs(front - rear - sheet.wheelbase_m) <= EXACT_SQUARE_M
                                             for rear, front in each)]
    if len(both) != 1:
        return None
    rears, fronts = zip(*both[0])
    return _from_axles(axles_between(fronts, rears, sheet.wheelbase_m), sheet)


def wheel_faces(side: Side, level: float) -> List[float]:
    """Middles of the wheels along a side, from the rear; empty when there is a surface that is none."""
    along = np.sort(side.along[np.abs(side.outward - level) <= FACE_DEPTH_M])
    pieces = np.split(along, np.nonzero(np.diff(along) > GAP_M)[0] + 1)
    spans = [(piece[0], piece[-1]) for piece in pieces if len(piece)]
    spans = [(low, high) for low, high in spans if high - low >= MIN_FACE_M]
    if any(high - low > MAX_FACE_M for low, high in spans):
        return []
    return [0.5 * (low + high) for low, high in spans]


def _from_axles(axles: Axles, sheet: DataSheet) -> CarWheels:
    length, length_sigma = _length_of(axles.wheelbase_m, sheet)
    if sheet.front_overhang_m:
        centre = axles.front_m + sheet.front_overhang_m - 0.5 * length
        centre_sigma = math.hypot(axles.front_sigma_m, DATA_SHEET_SIGMA_M, 0.5 * length_sigma)
    else:
        centre, centre_sigma = axles.middle_m, math.hypot(axles.middle_sigma_m, OVERHANG_SIGMA_M)
    return CarWheels(axles.front_m, axles.rear_m, centre, centre_sigma, length, length_sigma)


def _length_of(wheelbase: float, sheet: DataSheet) -> Tuple[float, float]:
    if sheet.known_length_m:
        return sheet.known_length_m, DATA_SHEET_SIGMA_M
    length = wheelbase / WHEELBASE_SHARE
    return length, length * WHEELBASE_SHARE_SIGMA / WHEELBASE_SHARE
