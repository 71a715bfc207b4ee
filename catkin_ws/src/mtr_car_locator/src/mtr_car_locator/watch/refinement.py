"""Observation of the Car whenever the robot is stationary during a test, with frame corrections."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple

from mtr_core.se2 import Pose2, wrap_angle

from ..measure.car_fit import CarFit
from ..parameters import RefinementParameters
from ..poses import PoseHistory
from ..scan import Scan
from .comparison import CarReference, Evidence
from .observation import SETTLING_S, CarObservation

# A change must exceed its uncertainty by this Mahalanobis distance (99.9 % of three degrees of freedom).
SIGNIFICANT = 4.0
# Two consecutive observations must agree.
AGREE_M, AGREE_RAD = 0.01, math.radians(0.3)
# A robot that remains stationary observes again after this time; one observation costs about 20 ms.
AGAIN_AFTER_S = 10.0
# A Car that is invisible for this time from this distance has gone; passing persons hide it for less.
UNSEEN_LIMIT_S, SEEN_FROM_M = 5.0, 8.0


@dataclass(frozen=True)
class Change:
    """A changed position of the Car.

    Attributes:
        motion: of the Car in its own frame, None if it has gone.
        is_correction: small enough to be applied.
        sigmas: 1 sigma of the motion's x, y (m) and heading (rad).
    """

    motion: Optional[Pose2]
    is_correction: bool
    sigmas: Tuple[float, float, float] = (0.0, 0.0, 0.0)


class Refinement:
    """Reports a Change after two agreeing significant observations; an insignificant one pauses the observation."""

    def __init__(self, car: CarFit, parameters: RefinementParameters):
        self._car, self._parameters = car, parameters
        self._reference = CarReference(car.surfels, car.range_bias.sigma_m)
        self._observation: Optional[CarObservation] = None
        self._suspected: Optional[Pose2] = None
        self._satisfied_s: Optional[float] = None
        self._unseen_since_s: Optional[float] = None

    def wants_scans(self, now_s: float, poses: PoseHistory) -> bool:
        """Return True while an observation is in progress or due."""
        if poses.standing_s(now_s) < SETTLING_S:
            self._satisfied_s = self._unseen_since_s = None
            return False
        return self._satisfied_s is None or now_s - self._satisfied_s >= AGAIN_AFTER_S

    def step(self, now_s: float, scans: Sequence[Scan], poses: PoseHistory) -> Optional[Change]:
        """Process one tick; a change is reported only while the robot is stationary."""
        if not self.wants_scans(now_s, poses):
            self._observation = None
            return None
        self._observation = self._observation or CarObservation(self._parameters.look_s, self._car.range_bias)
        self._observation.collect(now_s, scans, poses)
        if not self._observation.is_over(now_s):
            return None
        evidence = self._observation.result(self._car, self._reference, poses)
        self._observation = None
        if evidence is None and poses.newest.pose.distance_to(self._car.rectangle.pose) <= SEEN_FROM_M:
            return self._miss(now_s)
        self._unseen_since_s = None
        return self._judge(now_s, evidence)

    def _miss(self, now_s: float) -> Optional[Change]:
        self._suspected = None
        self._unseen_since_s = now_s if self._unseen_since_s is None else self._unseen_since_s
        return Change(None, False) if now_s - self._unseen_since_s >= UNSEEN_LIMIT_S else None

    def _judge(self, now_s: float, evidence: Optional[Evidence]) -> Optional[Change]:
        before, self._suspected = self._suspected, None
        if evidence is None or not self._is_change(evidence):
            self._satisfied_s = now_s
            return None
        motion = self._suspected = evidence.motion
        if before is None or not _agree(before, motion):
            return None
        self._suspected = None
        return Change(motion, self._is_small(motion), evidence.pose_sigmas)

    def _is_change(self, evidence: Evidence) -> bool:
        limits, motion = self._parameters, evidence.motion
        large = (math.hypot(motion.x, motion.y) > limits.refine_least_m
                 or abs(motion.heading) > limits.refine_least_rad)
        return large and evidence.significance() > SIGNIFICANT

    def _is_small(self, motion: Pose2) -> bool:
        limits = self._parameters
        return math.hypot(motion.x, motion.y) <= limits.refine_most_m and abs(motion.heading) <= limits.refine_most_rad


def _agree(one: Pose2, other: Pose2) -> bool:
    return one.distance_to(other) <= AGREE_M and abs(wrap_angle(one.heading - other.heading)) <= AGREE_RAD
