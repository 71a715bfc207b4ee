"""What is tried on an axis of Handle request, and what is recorded of it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Sequence

from ...actions.car import Car
from ...actions.distance import recorded_values
from ...actions.line_watch import LineWatch
from ...actions.pose_history import worst_known, worst_sigma
from ...actions.robot import Robot
from ...estimation.press.radial_search import PRESSES_IN_DOUBT
from ...geometry.axes import axes_around
from ...geometry.ray import Ray
from ...results.carried import carried_values
from ...results.document import Texts
from ...results.line_result import LineStatus
from ...robot_status import CarDimensions
from ..handle.fields import ALL_SIDES
from ..line_search.attempt import AttemptMade, AttemptsMade
from ..line_search.campaign import DIGITS
from ..line_search.silence import MAX_SILENT_LINES
from ..line_search.trial import Trial
from .parameters import HandleRequestParameters
from .request import Requester
from .result import HANDLE_WORD, HandleRequestResult

# Columns of the farthest request inside.
_OF_FARTHEST = ("distance_m", "uncertainty_m", "robot_time_s", "lateral_offset_m", "heading_offset_deg", "cause",
                "key_number", "doors")


@dataclass(frozen=True)
class HandleAxis:
    """One axis at one height; number counts from 1."""

    number: int
    side: str
    key_height_m: float
    ray: Ray


def axes_of(parameters: HandleRequestParameters, car: CarDimensions) -> list[HandleAxis]:
    """Those of the side, or of all, from the lowest height to the highest."""
    axes = [axis for axis in axes_around(car, parameters.measurements_distance_m)
            if parameters.side in (ALL_SIDES, axis.side)]
    return [HandleAxis(index * len(axes) + number, axis.side, height_m, axis.ray)
            for index, height_m in enumerate(parameters.heights_m) for number, axis in enumerate(axes, start=1)]


class AxisTrial(Trial[HandleRequestResult]):
    """An axis on which the handle is taken."""

    word = HANDLE_WORD

    def __init__(self, line: HandleAxis, parameters: HandleRequestParameters, car: Car):
        self.number, self.ray = line.number, line.ray
        self.start = f"axis {line.number} ({line.side.replace('_', ' ')}): go to the start"
        self.tolerances = self.parameters = parameters
        self.first_places_m = parameters.border_places_m
        self._line = line
        self._handle_request = parameters
        self._car = car
        self._requested_by = ""

    def begin(self, robot: Robot) -> None:
        """See Trial."""
        robot.move_key_to(self._line.key_height_m)

    def action_at(self, distance_m: float) -> str:
        """See Trial."""
        return f"handle request at {distance_m:.2f} m"

    def attempt(self, watch: LineWatch, robot: Robot, word: str) -> AttemptMade:
        """See Trial."""
        requester = Requester(self.ray, self._handle_request, robot, self._car, watch)
        made, self._requested_by = requester.request(word)
        return made

    def invalid(self, made: AttemptsMade, reason: str, evidence: Texts = ()) -> HandleRequestResult:
        """See Trial."""
        line, parameters = self._line, self._handle_request
        inside_m, outside_m = _places(made.counted, worked=True), _places(made.counted, worked=False)
        at_border = made.all[:parameters.border_requests]
        sigma_m = worst_sigma(each.place.uncertainty_m for each in made.counted)
        ray = self.ray
        return HandleRequestResult(
            line.number, line.side, round(line.key_height_m, DIGITS), LineStatus.INVALID, len(made.all),
            len(_places(made.all, worked=True)), len(outside_m),
            parameters.border_distance_m if parameters.border_requests else None,
            len(_places(at_border, worked=True)), len(_places(at_border, worked=False)), self._requested_by,
            unconfirmed_m=made.unconfirmed_text, origin_x_m=ray.origin_x, origin_y_m=ray.origin_y,
            direction_x=ray.direction_x, direction_y=ray.direction_y, reason=reason, worked_at_m=inside_m,
            failed_at_m=outside_m, place_sigma_m=sigma_m if math.isfinite(sigma_m) else None, evidence=evidence)

    def result(self, made: AttemptsMade) -> HandleRequestResult:
        """See Trial."""
        farthest = max((each.place for each in made.counted if each.worked),
                       key=lambda place: place.distance_m, default=None)
        distance_m, uncertainty_m, robot_time_s = recorded_values(farthest)
        carried = {name: value for name, value in carried_values("", farthest).items() if name in _OF_FARTHEST}
        return replace(self.invalid(made, ""), distance_m=distance_m, uncertainty_m=uncertainty_m,
                       robot_time_s=robot_time_s, **carried)

    def joined(self, before: HandleRequestResult, after: HandleRequestResult) -> HandleRequestResult:
        """See Trial; the requests at the border were made before."""
        farther = max((before, after), key=lambda result: -math.inf if result.distance_m is None else result.distance_m)
        return replace(
            after, requests=before.requests + after.requests, inside=before.inside + after.inside,
            outside=before.outside + after.outside, inside_at_border=before.inside_at_border,
            outside_at_border=before.outside_at_border, requested_by=after.requested_by or before.requested_by,
            unconfirmed_m=f"{before.unconfirmed_m} {after.unconfirmed_m}".strip(),
            worked_at_m=before.worked_at_m + after.worked_at_m, failed_at_m=before.failed_at_m + after.failed_at_m,
            place_sigma_m=worst_known(each.place_sigma_m for each in (before, after) if each.attempts_made),
            **{name: getattr(farther, name) for name in _OF_FARTHEST})

    @property
    def silence(self) -> str:
        """See Trial."""
        return (f"No handle request unlocked the Car, and none of {PRESSES_IN_DOUBT} at "
                f"{self._handle_request.minimum_distance_m:.2f} m either: the key sleeps, its battery is empty, the "
                "handle was not taken, or the zone ends nearer; then decrease minimum_distance_m.")

    @property
    def lasting_silence(self) -> str:
        """See Trial."""
        return (f"No handle request has unlocked the Car on {MAX_SILENT_LINES} axes one after the other; see whether "
                "the key sleeps, whether its battery is empty, whether it is the Car's key and whether the handle of "
                "this side is taken, then continue the test, or begin one of another side or with a smaller "
                "minimum_distance_m.")


def _places(made: Sequence[AttemptMade], worked: bool) -> tuple[float, ...]:
    return tuple(round(each.place.distance_m, DIGITS) for each in made if each.worked is worked)
