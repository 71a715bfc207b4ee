"""Self-check: observation of the Car from two places, compared with its measured pose."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import List, Optional, Sequence, Tuple

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.se2 import Pose2
from mtr_core.states import Check, Result

from .. import problems
from ..measure.car_fit import CarFit
from ..parameters import RefinementParameters
from ..poses import PoseHistory
from ..scan import Scan
from .comparison import CarReference, Evidence, joined
from .corners import corners, nearest
from .observation import CarObservation

PLACES = 2
# A place that is blocked longer is skipped; the Car has four corners.
BLOCKED_LIMIT_S = 10.0
# Time limit for seeing the Car at the place.
OBSERVATION_LIMIT_S = 5.0


@dataclass(frozen=True)
class CheckReport:
    """State of the self-check; NaN while unknown."""

    check_id: int = 0
    state: Check = Check.NONE
    difference_m: float = math.nan
    difference_rad: float = math.nan
    message: Problem = NO_PROBLEM


class SelfCheck:
    """Drives to two corners of the Car and observes it from there.

    Attributes:
        report: state of the check.
    """

    def __init__(self, check_id: int, now_s: float, robot: Pose2, car: CarFit, parameters: RefinementParameters):
        self._car, self._parameters = car, parameters
        self._reference = CarReference(car.surfels, car.range_bias.sigma_m)
        places = corners(car.rectangle, parameters.check_distance_m)
        self._places = _order(places, nearest(places, robot))
        self._found: List[Evidence] = []
        self._observation: Optional[CarObservation] = None
        self._since_s = now_s
        self.report = CheckReport(check_id, Check.RUNNING, message=problems.CHECK_RUNNING())

    @property
    def place(self) -> Optional[Pose2]:
        """Next place of the robot, in map; None when finished."""
        return self._places[0] if self._places and self.report.state is Check.RUNNING else None

    @property
    def places_ahead(self) -> Tuple[Pose2, ...]:
        """Remaining places."""
        return tuple(self._places[:PLACES - len(self._found)]) if self.place else ()

    def step(self, now_s: float, result: Result, scans: Sequence[Scan], poses: PoseHistory) -> None:
        """Process one tick; result: of the motion planner at the present place."""
        if self.report.state is not Check.RUNNING:
            return
        if result in (Result.PENDING, Result.IDLE):
            self._since_s = now_s
        if result is Result.REACHED:
            self._observe(now_s, scans, poses)
        elif result is Result.REFUSED or now_s - self._since_s >= BLOCKED_LIMIT_S:
            self._next(now_s)
        if not self._places or len(self._found) == PLACES:
            self._judge()

    def _observe(self, now_s: float, scans: Sequence[Scan], poses: PoseHistory) -> None:
        if self._observation is None:
            self._observation = CarObservation(self._parameters.look_s, self._car.range_bias)
            self._since_s = now_s
        self._observation.collect(now_s, scans, poses)
        if self._observation.is_over(now_s):
            evidence = self._observation.result(self._car, self._reference, poses)
            if evidence:
                self._found.append(evidence)
            self._next(now_s)
        elif now_s - self._since_s >= OBSERVATION_LIMIT_S:
            self._next(now_s)

    def _next(self, now_s: float) -> None:
        self._places = self._places[1:]
        self._observation, self._since_s = None, now_s

    def _judge(self) -> None:
        check_id = self.report.check_id
        if len(self._found) < PLACES:
            self.report = CheckReport(check_id, Check.FAILED, message=problems.CHECK_BLOCKED(
                seen=len(self._found), needed=PLACES))
            return
        evidence = joined(*self._found)
        shift_m, turn_rad = evidence.shift_m, abs(evidence.motion.heading)
        state, words = self._verdict(shift_m, turn_rad, evidence)
        self.report = CheckReport(check_id, state, shift_m, turn_rad, words)

    def _verdict(self, shift_m: float, turn_rad: float, evidence: Evidence) -> Tuple[Check, Problem]:
        limits = self._parameters
        sigma_m, sigma_rad = evidence.sigmas
        found = {"shift_cm": 100.0 * shift_m, "turn_deg": math.degrees(turn_rad),
                 "shift_sigma_cm": 100.0 * sigma_m, "turn_sigma_deg": math.degrees(sigma_rad)}
        if shift_m > limits.check_limit_m or turn_rad > limits.check_limit_rad:
            return Check.FAILED, problems.CHECK_FAILED(
                **found, allowed_cm=100.0 * limits.check_limit_m,
                allowed_deg=math.degrees(limits.check_limit_rad))
        return Check.PASSED, problems.CHECK_PASSED(**found)


def _order(places: List[Pose2], first: int) -> List[Pose2]:
    """Return the nearest corner, the other one at the same end, and the remaining ones as replacements."""
    second = 3 - first
    rest = [index for index in range(len(places)) if index not in (first, second)]
    return [places[first], places[second], *(places[index] for index in rest)]
