"""Observation of the Car by a stationary robot."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import List, Optional, Sequence

import numpy as np

from ..measure.car_fit import CarFit
from ..poses import PoseHistory
from ..scan import RangeBias, Returns, Scan, returns_in_map
from .comparison import CarReference, Evidence

# A robot that has just stopped still sways.
SETTLING_S = 0.3
# Points within this distance of the Car's outline may belong to it.
NEAR_M = 0.4


class CarObservation:
    """Collects scans of a stationary robot and compares them with the measured Car.

    The observation restarts if the robot moves.
    """

    def __init__(self, duration_s: float, range_bias: RangeBias):
        """Create an observation. range_bias: bias that the Car's surfels are corrected for."""
        self._duration_s, self._range_bias = duration_s, range_bias
        self._returns: List[Returns] = []
        self._first_s: Optional[float] = None

    def collect(self, now_s: float, scans: Sequence[Scan], poses: PoseHistory) -> None:
        """Add scans of a stationary robot."""
        if poses.stands_since_s is None or poses.standing_s(now_s) < SETTLING_S:
            self._returns, self._first_s = [], None
            return
        since_s = poses.stands_since_s + SETTLING_S
        for scan in scans:
            seen = returns_in_map(scan, poses, self._range_bias) if scan.start_s >= since_s else None
            if seen is not None:
                self._first_s = scan.start_s if self._first_s is None else self._first_s
                self._returns.append(seen)

    def is_over(self, now_s: float) -> bool:
        """Return True if the duration is reached."""
        return self._first_s is not None and now_s - self._first_s >= self._duration_s

    def result(self, car: CarFit, reference: CarReference, poses: PoseHistory) -> Optional[Evidence]:
        """Return the evidence; None if too little of the Car was seen."""
        near = [each for each in (_near(seen, car) for seen in self._returns) if len(each.points)]
        return reference.compare(near, car.rectangle.pose, poses.newest)


def _near(seen: Returns, car: CarFit) -> Returns:
    pose, reach = car.rectangle.pose, 0.5 * car.rectangle.length + NEAR_M
    near = np.hypot(seen.points[:, 0] - pose.x, seen.points[:, 1] - pose.y) < reach + 0.5
    return replace(seen, points=seen.points[near])
