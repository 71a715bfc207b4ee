"""What the presses of a radial come to in its result, beside the estimate."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

from ...actions.distance import recorded_values
from ...actions.pose_history import worst_known, worst_sigma
from ...geometry.radials import Radial
from ...results.carried import carried_values
from ...results.line_result import LineStatus
from ..key_press_result import ADAPTIVE, KeyPressResult
from ..line_search.attempt import AttemptsMade
from ..line_search.campaign import DIGITS

# Columns of the farthest press that worked.
_OF_FARTHEST = ("distance_m", "uncertainty_m", "robot_time_s", "lateral_offset_m", "heading_offset_deg", "key_height_m",
                "speed_mps", "cause", "key_number", "doors")


def invalid_result(line: Radial, made: AttemptsMade, reason: str, evidence: tuple[str, ...] = ()) -> KeyPressResult:
    """The presses alone, those that count and those that do not; nothing follows from them."""
    counted = made.counted
    sigma_m = worst_sigma(press.place.uncertainty_m for press in counted)
    return KeyPressResult(
        line.number, line.clockwise_deg, LineStatus.INVALID, None, None, None, len(made.all), None, reason,
        evidence=evidence, method=ADAPTIVE, place_sigma_m=sigma_m if math.isfinite(sigma_m) else None,
        unconfirmed_m=made.unconfirmed_text,
        worked_at_m=tuple(round(press.place.distance_m, DIGITS) for press in counted if press.worked),
        failed_at_m=tuple(round(press.place.distance_m, DIGITS) for press in counted if not press.worked))


def result_of(line: Radial, made: AttemptsMade) -> KeyPressResult:
    """What is known without the estimate, and without a word of doubt."""
    farthest = max((press.place for press in made.counted if press.worked),
                   key=lambda place: place.distance_m, default=None)
    distance_m, uncertainty_m, robot_time_s = recorded_values(farthest)
    return _with_failure(replace(invalid_result(line, made, ""), distance_m=distance_m, uncertainty_m=uncertainty_m,
                                 robot_time_s=robot_time_s, **carried_values("", farthest)))


def joined(before: KeyPressResult, after: KeyPressResult) -> KeyPressResult:
    """Of a radial that was measured further."""
    farther = max((before, after), key=lambda result: -math.inf if result.distance_m is None else result.distance_m)
    return _with_failure(replace(
        after, attempts=before.attempts + after.attempts, worked_at_m=before.worked_at_m + after.worked_at_m,
        failed_at_m=before.failed_at_m + after.failed_at_m,
        unconfirmed_m=f"{before.unconfirmed_m} {after.unconfirmed_m}".strip(),
        place_sigma_m=worst_known(each.place_sigma_m for each in (before, after) if each.attempts_made),
        **{name: getattr(farther, name) for name in _OF_FARTHEST}))


def _with_failure(result: KeyPressResult) -> KeyPressResult:
    """With the next farther place that failed."""
    beyond_m = [place_m for place_m in result.failed_at_m
                if result.distance_m is None or place_m > result.distance_m]
    return replace(result, failed_distance_m=min(beyond_m, default=None))
