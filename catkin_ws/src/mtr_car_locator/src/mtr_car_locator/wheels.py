"""A Car whose bumpers the LiDARs look under: its length and centre from the wheels alone."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, Optional, Tuple

import numpy as np

from .parameters import CarProfile
from .side import Side

# Surface so near the side's level is the outer face of a tyre; pieces farther apart than the gap are two wheels.
FACE_DEPTH_M, GAP_M = 0.08, 0.5
LEAST_FACE_M, MOST_FACE_M = 0.25, 0.95
SHORTEST_WHEELBASE_M, LONGEST_WHEELBASE_M = 1.8, 4.0
# The axles of one side must not differ more from those of the other.
SQUARE_M = 0.10
# Of passenger cars the wheelbase is 0.56 to 0.63 of the length, and the front overhang 0.15 m shorter than the rear one
# to 0.15 m longer; these are the middles of the ranges and a third of their widths, see the README.
WHEELBASE_SHARE, WHEELBASE_SHARE_SIGMA = 0.595, 0.02
OVERHANG_SIGMA_M = 0.08
AXLE_SIGMA_M = 0.02


@dataclass(frozen=True)
class Wheels:
    """The Car along its x axis, as its wheels tell, in the frame of the sides; 1 sigma each."""

    front_axle_m: float
    rear_axle_m: float
    centre_m: float
    centre_sigma_m: float
    length_m: float
    length_sigma_m: float


def wheels_between(left: Side, right: Side, y: float, width: float, profile: CarProfile) -> Optional[Wheels]:
    """Both axles, when each side shows two wheels at its level and nothing between them; else None."""
    faces = [wheel_faces(left, y + 0.5 * width), wheel_faces(right, 0.5 * width - y)]
    if any(len(each) != 2 for each in faces) or np.any(np.ptp(faces, axis=0) > SQUARE_M):
        return None
    rear, front = np.mean(faces, axis=0).tolist()
    if not SHORTEST_WHEELBASE_M <= front - rear <= LONGEST_WHEELBASE_M:
        return None
    return _from_axles(front, rear, profile)


def wheel_faces(side: Side, level: float) -> List[float]:
    """Middles of the wheels along a side, from the rear; empty when there is a surface that is none."""
    along = np.sort(side.along[np.abs(side.outward - level) <= FACE_DEPTH_M])
    pieces = np.split(along, np.nonzero(np.diff(along) > GAP_M)[0] + 1)
    spans = [(piece[0], piece[-1]) for piece in pieces if len(piece)]
    spans = [(low, high) for low, high in spans if high - low >= LEAST_FACE_M]
    if any(high - low > MOST_FACE_M for low, high in spans):
        return []
    return [0.5 * (low + high) for low, high in spans]


def _from_axles(front: float, rear: float, profile: CarProfile) -> Wheels:
    length, length_sigma = _length_of(front - rear, profile)
    if profile.front_overhang_m:
        centre, centre_sigma = front + profile.front_overhang_m - 0.5 * length, 0.5 * length_sigma
    else:
        centre, centre_sigma = 0.5 * (front + rear), OVERHANG_SIGMA_M
    return Wheels(front, rear, centre, float(np.hypot(centre_sigma, AXLE_SIGMA_M)), length, length_sigma)


def _length_of(wheelbase: float, profile: CarProfile) -> Tuple[float, float]:
    if profile.known_length_m:
        return profile.known_length_m, AXLE_SIGMA_M
    length = wheelbase / WHEELBASE_SHARE
    return length, length * WHEELBASE_SHARE_SIGMA / WHEELBASE_SHARE
