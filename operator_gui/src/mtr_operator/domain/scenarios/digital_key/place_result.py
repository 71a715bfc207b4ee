"""The result of one place, from where the phone was and what it told there. No robot is here."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ... import limits
from ...actions.distance import Distance
from ...estimation.interval import SIGMAS_OF_LEVEL
from ...geometry.pose import Point
from ...results.line_result import LineStatus
from ...robot_status import CarDimensions
from .parameters import DigitalKeyParameters
from .places import KeyDistance, MapPlace, key_point, reference_of
from .reading import Answer, Reading
from .result import MAX_FIGURES, DigitalKeyResult


@dataclass(frozen=True)
class Stood:
    """Where the phone was, on its radial and from the reference; car_point: in the Car coordinate system."""

    made: Distance
    reference: Distance
    car_point: Point


def stood_at(line: MapPlace, made: Distance, parameters: DigitalKeyParameters, car: CarDimensions,
             key_distance: KeyDistance) -> Stood:
    """made: on the place's ray. For what is raised see reference_of."""
    return Stood(made, reference_of(made, line.ray, parameters, car, key_distance), key_point(line.ray, made))


def place_result(line: MapPlace, reading: Reading, stood: Stood) -> DigitalKeyResult:
    """Of one place, without regard to the others."""
    made, reference, median = stood.made, stood.reference, reading.median
    figures_m = tuple(round(figure_m, 6) for figure_m in reading.figures_m)
    result = DigitalKeyResult(
        line.number, line.side, line.distance_m, _rounded(made.key_height_m), LineStatus.INVALID,
        answer=reading.answer.value, samples=len(figures_m),
        age_s=None if reading.age_s is None else _rounded(reading.age_s), reference_m=_rounded(reference.distance_m),
        robot_time_s=_rounded(made.robot_time_s), x_m=_rounded(stood.car_point[0]), y_m=_rounded(stood.car_point[1]),
        along_m=_rounded(made.distance_m), lateral_offset_m=_rounded(made.lateral_m),
        heading_offset_deg=_rounded(math.degrees(made.heading_rad)), reason=reading.reason,
        figures_m=figures_m[::-(-len(figures_m) // MAX_FIGURES) or 1])
    if median is None:
        return result
    result = replace(result, reported_m=_rounded(median.value_m), reported_spread_m=_rounded(median.spread_m),
                     reported_sigma_m=_rounded(median.sigma_m))
    if math.isnan(reference.uncertainty_m):
        return replace(result, reason=reading.reason or "The robot does not say how sure it is of its position.",
                       answer=Answer.NOT_MEASURED.value if reading.answer is Answer.DISTANCE else result.answer)
    result = replace(result, uncertainty_m=_rounded(reference.uncertainty_m))
    if reading.answer is not Answer.DISTANCE:
        return result
    error_m = median.value_m - reference.distance_m
    reach_m = SIGMAS_OF_LEVEL * math.hypot(median.sigma_m, reference.uncertainty_m)
    if not (limits.DISTANCE.allows(error_m - reach_m) and limits.DISTANCE.allows(error_m + reach_m)):
        return replace(result, answer=Answer.NONE.value, reason=f"The phone's distance, {median.value_m:.1f} m, is off "
                                                                f"by {abs(error_m):.1f} m; that is none.")
    return replace(result, status=LineStatus.OK, error_m=_rounded(error_m), error_low_m=_rounded(error_m - reach_m),
                   error_high_m=_rounded(error_m + reach_m))


def _rounded(value: float) -> float:
    return round(value, 6)
