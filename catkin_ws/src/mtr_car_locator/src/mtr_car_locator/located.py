"""Located Car: its frame is constant until there is evidence for a change."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Optional, Tuple

from mtr_core import names
from mtr_core.problems import Problem
from mtr_core.requests import CAR_LOCATOR, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Direction

from . import problems
from .estimate import NO_MOTION, Inputs, LocatorTask, result_at
from .find.errors import NotLocated
from .measure.car_fit import CarFit
from .parameters import RefinementParameters
from .poses import PoseHistory
from .watch.refinement import Change, Refinement
from .watch.self_check import CheckReport, SelfCheck

# A length with a larger sigma is not from a data sheet.
KNOWN_SIGMA_M = 0.05


class LocatedCar:
    """Frame, self-check and corrections of a Car.

    Attributes:
        fit: the Car.
        revision: of its frame.
        correction: the frame relative to the previous revision.
        map_revision: of the localization map that it is in.
        message: about the location, or about the last correction.
    """

    def __init__(self, fit: CarFit, map_revision: int, revision: int, parameters: RefinementParameters):
        self.map_revision, self._parameters = map_revision, parameters
        self._refinement = Refinement(fit, parameters)
        self._check: Optional[SelfCheck] = None
        self._waypoint: Optional[Waypoint] = None
        self.fit, self.revision, self.correction = fit, revision, NO_MOTION
        self.message = found(fit)

    @property
    def waypoint(self) -> Optional[Waypoint]:
        """Waypoint of the self-check."""
        return self._waypoint

    @property
    def places_ahead(self) -> Tuple[Pose2, ...]:
        """Remaining places of the self-check."""
        return self._check.places_ahead if self._check else ()

    @property
    def report(self) -> CheckReport:
        """Result of the last self-check."""
        return self._check.report if self._check else CheckReport()

    def wants_scans(self, inputs: Inputs, poses: PoseHistory) -> bool:
        """Return True while an observation requires scans."""
        if inputs.task is not None and inputs.task.checking:
            return self._waypoint is not None
        return self._refinement.wants_scans(inputs.now_s, poses)

    def step(self, inputs: Inputs, poses: PoseHistory, next_id: int) -> None:
        """Process one tick; NotLocated if the Car's frame is no longer valid."""
        if poses.newest.map_revision != self.map_revision:
            raise NotLocated(problems.OTHER_MAP())
        if inputs.task is not None and inputs.task.checking:
            self._run_check(inputs, inputs.task, poses, next_id)
            return
        self._waypoint = None
        change = self._refinement.step(inputs.now_s, inputs.scans, poses)
        if change:
            self._apply(change)

    def _run_check(self, inputs: Inputs, task: LocatorTask, poses: PoseHistory, next_id: int) -> None:
        if self._check is None or self._check.report.check_id != task.check_car_id:
            self._check = SelfCheck(task.check_car_id, inputs.now_s, poses.newest.pose, self.fit, self._parameters)
            self._waypoint = None
        result = result_at(self._waypoint, task, inputs.motion)
        self._check.step(inputs.now_s, result, inputs.scans, poses)
        self._waypoint = self._placed(self._check.place, next_id)

    def _placed(self, pose: Optional[Pose2], next_id: int) -> Optional[Waypoint]:
        if pose is None or (self._waypoint and self._waypoint.pose == pose):
            return self._waypoint if pose else None
        return Waypoint(next_id, CAR_LOCATOR, names.MAP, pose, Direction.FORWARD)

    def _apply(self, change: Change) -> None:
        if change.motion is None:
            raise NotLocated(problems.GONE())
        shift_cm = 100.0 * math.hypot(change.motion.x, change.motion.y)
        turn_deg = math.degrees(abs(change.motion.heading))
        if not change.is_correction:
            raise NotLocated(problems.MOVED(shift_cm=shift_cm, turn_deg=turn_deg))
        # The fit of the frame to the Car's surfaces is unchanged. The present observation, including the robot's pose,
        # now determines the position of these surfaces instead of the map.
        x, y, heading = (math.hypot(first, now) for first, now in zip(self.fit.sigmas, change.sigmas))
        self.fit = replace(self.fit, rectangle=self.fit.rectangle.moved_by(change.motion), sigmas=(x, y, heading),
                           side_sigmas=self.fit.side_sigmas.moved(*change.sigmas[:2]))
        self.revision, self.correction = self.revision + 1, change.motion
        self._refinement = Refinement(self.fit, self._parameters)
        self.message = told(self.fit, problems.CORRECTED(shift_cm=shift_cm, turn_deg=turn_deg, revision=self.revision))


def found(fit: CarFit) -> Problem:
    """Return the message about the located Car."""
    sentence = problems.FOUND
    if fit.by_wheels:
        is_known = fit.length_sigma < KNOWN_SIGMA_M
        sentence = problems.FOUND_BY_WHEELS if is_known else problems.FOUND_BY_WHEELS_ALONE
    return told(fit, sentence(
        length_m=fit.rectangle.length, length_sigma_cm=100.0 * fit.length_sigma, width_m=fit.rectangle.width,
        width_sigma_cm=100.0 * fit.width_sigma))


def told(fit: CarFit, message: Problem) -> Problem:
    """The message, within the one on a data sheet that the Car contradicts."""
    return problems.SHEET_CONTRADICTED(cause=message, details=fit.contradiction) if fit.contradiction else message
