"""Where a Car's axles are: midway between front and rear of its tyres' treads."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Sequence, Tuple

import numpy as np

from ..surfels import SAMPLE_M
from .side import Side

# The LiDARs' plane cuts twice this out of a tyre: radii of passenger cars' tyres are 0.29 to 0.36 m, the plane is
# 0.15 to 0.35 m high; these are the middle of the range and a quarter of its width.
HALF_CHORD_M, HALF_CHORD_SIGMA_M = 0.31, 0.025
# The middle of an outer face of which the ends may be missing was up to 5 cm off on recorded drives.
FACE_SIGMA_M = 0.04
# When all returns tell it, it was 1 mm rms off on level ground, 5 mm on slopes of 1 deg (recorded drives).
EXACT_FACE_SIGMA_M = 0.004
# Faces of one Car differ so much in length at most: tyres are met at different heights where the ground is uneven. What
# is longer has something beside it, on one side of its middle.
FACE_SIZE_NOISE_M = 0.04
# So far from where the face puts it a tread is looked for, and so much of its width has to be seen.
TREAD_GATE_M, MIN_TREAD_M = 0.12, 0.06
# Treads of recorded drives lie up to 5 mm inside, by their rounded shoulders and the smeared edge towards the face.
TREAD_SIGMA_M = 0.005
# The wheelbase of a data sheet differs from this Car's by the tolerance of the wheels' alignment, and load.
WHEELBASE_SIGMA_M = 0.005


@dataclass(frozen=True)
class Axles:
    """Both axles along the Car, m, with 1 sigma of each and the covariance of their errors in m^2."""

    front_m: float
    rear_m: float
    front_sigma_m: float
    rear_sigma_m: float
    covariance_m2: float = 0.0

    @property
    def wheelbase_m(self) -> float:
        """Distance between them."""
        return self.front_m - self.rear_m


def axles_at(front_m: float, rear_m: float, ahead: Sequence[Side], behind: Sequence[Side],
             known_wheelbase_m: float = 0.0) -> Axles:
    """Axles near the middles of the outer faces; ahead and behind are treads by the way they face, left and right.

    Least squares over both axles and the half chord, which all tyres share: so three treads, the inner ones of both
    axles and one more, or the inner ones and the wheelbase, tell all.
    """
    rows: List[Tuple[Tuple[float, float, float], float, float]] = [
        ((1.0, 0.0, 0.0), front_m, FACE_SIGMA_M), ((0.0, 1.0, 0.0), rear_m, FACE_SIGMA_M),
        ((0.0, 0.0, 1.0), HALF_CHORD_M, HALF_CHORD_SIGMA_M)]
    if known_wheelbase_m:
        rows.append(((1.0, -1.0, 0.0), known_wheelbase_m, WHEELBASE_SIGMA_M))
    for axle_m, factors in ((front_m, (1.0, 0.0)), (rear_m, (0.0, 1.0))):
        for sign, sides in ((1.0, ahead), (-1.0, behind)):
            rows.extend(((*factors, sign), sign * level, sigma)
                        for level, sigma in _treads(sides, sign * axle_m + HALF_CHORD_M))
    return _solved(rows)


def axles_between(fronts: Sequence[Tuple[float, float]], rears: Sequence[Tuple[float, float]],
                  known_wheelbase_m: float = 0.0) -> Axles:
    """Axles from the middles of the outer faces alone, left and right, with 1 sigma each, when all returns tell these.

    Where the ground is uneven the front of a tyre is met at another height than its rear, and so at another chord; both
    ends of its face are met at the same.
    """
    rows: List[Tuple[Tuple[float, float, float], float, float]] = [((0.0, 0.0, 1.0), HALF_CHORD_M, HALF_CHORD_SIGMA_M)]
    rows += [((1.0, 0.0, 0.0), *front) for front in fronts]
    rows += [((0.0, 1.0, 0.0), *rear) for rear in rears]
    if known_wheelbase_m:
        rows.append(((1.0, -1.0, 0.0), known_wheelbase_m, WHEELBASE_SIGMA_M))
    return _solved(rows)


def _treads(sides: Sequence[Side], outward_m: float) -> List[Tuple[float, float]]:
    """Level and 1 sigma of each tread near a distance outwards."""
    found = []
    for side in sides:
        near = np.abs(side.outward - outward_m) <= TREAD_GATE_M
        if np.count_nonzero(near) * SAMPLE_M >= MIN_TREAD_M:
            sigma = math.hypot(float(np.median(side.sigma[near])), TREAD_SIGMA_M)
            found.append((float(np.median(side.outward[near])), sigma))
    return found


def _solved(rows: List[Tuple[Tuple[float, float, float], float, float]]) -> Axles:
    sigmas = np.array([sigma for _, _, sigma in rows])
    matrix = np.array([factors for factors, _, _ in rows]) / sigmas[:, np.newaxis]
    values = np.array([value for _, value, _ in rows]) / sigmas
    covariance = np.linalg.inv(matrix.T @ matrix)
    front, rear, half_chord = covariance @ (matrix.T @ values)
    rest = values - matrix @ (front, rear, half_chord)
    # What does not fit together makes all of it less sure.
    covariance = covariance * max(1.0, float(rest @ rest) / (len(rows) - 3 or 1))
    return Axles(float(front), float(rear), math.sqrt(covariance[0, 0]), math.sqrt(covariance[1, 1]),
                 float(covariance[0, 1]))
