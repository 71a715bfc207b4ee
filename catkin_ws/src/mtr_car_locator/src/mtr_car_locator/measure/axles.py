"""Axles of a Car: midway between the front and rear treads of its tyres."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Sequence, Tuple

import numpy as np

from ..surfels import SAMPLE_M
from .side import Side

# Half the chord of a tyre in the scan plane. Radii of passenger car tyres are 0.29 to 0.36 m, and the plane is 0.15 to
# 0.35 m high; the values are the middle of the range and a quarter of its width.
HALF_CHORD_M, HALF_CHORD_SIGMA_M = 0.31, 0.025
# The middle of an outer face with possibly missing ends was up to 5 cm off in recorded drives.
FACE_SIGMA_M = 0.04
# From all returns, the error was 1 mm rms on level ground and 5 mm on slopes of 1 deg (recorded drives).
EXACT_FACE_SIGMA_M = 0.004
# Largest difference of face lengths on one Car, because tyres are met at different heights on uneven ground. A longer
# face includes an adjacent object on one side.
FACE_SIZE_NOISE_M = 0.04
# Search range of a tread round its position from the face, and its lowest visible width.
TREAD_GATE_M, MIN_TREAD_M = 0.12, 0.06
# Treads in recorded drives are up to 5 mm inside, because of rounded shoulders and the smeared edge of the face.
TREAD_SIGMA_M = 0.005
# Deviation of a wheelbase from the data sheet by wheel alignment tolerance and load.
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
        """Distance between the axles."""
        return self.front_m - self.rear_m


def axles_at(front_m: float, rear_m: float, ahead: Sequence[Side], behind: Sequence[Side],
             known_wheelbase_m: float = 0.0) -> Axles:
    """Return the axles near the middles of the outer faces, from treads by direction, left and right.

    Least squares over both axles and the half chord, which is common to all tyres. Sufficient are three treads (the
    inner ones of both axles and one more), or the inner ones and the wheelbase.
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
    """Return the axles from the middles of the outer faces with 1 sigma each, left and right, from all returns.

    On uneven ground, the front of a tyre is met at another height and chord than its rear, but both ends of a face are
    met at the same height.
    """
    rows: List[Tuple[Tuple[float, float, float], float, float]] = [((0.0, 0.0, 1.0), HALF_CHORD_M, HALF_CHORD_SIGMA_M)]
    rows += [((1.0, 0.0, 0.0), *front) for front in fronts]
    rows += [((0.0, 1.0, 0.0), *rear) for rear in rears]
    if known_wheelbase_m:
        rows.append(((1.0, -1.0, 0.0), known_wheelbase_m, WHEELBASE_SIGMA_M))
    return _solved(rows)


def _treads(sides: Sequence[Side], outward_m: float) -> List[Tuple[float, float]]:
    """Return level and 1 sigma of each tread near a distance outwards."""
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
    # Residuals larger than their sigmas increase the covariance.
    covariance = covariance * max(1.0, float(rest @ rest) / (len(rows) - 3 or 1))
    return Axles(float(front), float(rear), math.sqrt(covariance[0, 0]), math.sqrt(covariance[1, 1]),
                 float(covariance[0, 1]))
