"""Search for the Car among surfels in map, and its measurement."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import List, Optional

import numpy as np

from .. import problems
from ..measure.car_fit import CarFit
from ..measure.close_up import CloseUp
from ..measure.measurement import measured
from ..parameters import LocatorParameters
from ..rectangle import Rectangle
from ..surfels import Surfels
from .alignment import Alignment
from .blobs import guess_from_blobs
from .candidates import CarCandidate, candidates, is_allowed, near
from .errors import NotLocated
from .prior import Prior
from .scoring import new_share, score_of

# Quality of a complete Car seen from all sides: at least 0.7; seen from one side and one end: 0.35. A wall, a group of
# persons or the near side of a neighbour stays below 0.2 (tests/unit/test_locator_scenes.py).
MIN_QUALITY = 0.25
# The faces of four tyres cover 0.2 to 0.3 of a Car's outline; their arrangement has already been checked.
MIN_QUALITY_ON_WHEELS = 0.15
# Distance of the centres of two different objects, and ratio of their scores that makes them ambiguous.
TWO_THINGS_M, ALIKE = 0.8, 0.5
MIN_SURFACE_M = 1.0
# A different object has at least this share of surface that the first one does not explain.
MIN_NEW_SHARE = 0.2


def fit_car(surfels: Surfels, prior: Prior, parameters: LocatorParameters,
            close_up: Optional[CloseUp] = None) -> CarFit:
    """Return the Car near the prior; NotLocated with the reason if in doubt.

    Surfels determine the Car and its pose; close_up, all returns near it, determines its sides to millimetres.
    """
    seen = near(surfels, prior, parameters)
    if seen.length.sum() < MIN_SURFACE_M:
        raise NotLocated(problems.NOTHING_THERE())
    best = _chosen(candidates(seen, prior, parameters))
    seen = best.seen
    found = Alignment(seen, close_up, parameters.sheet, on_wheels=best.wheels is not None).aligned(best.car)
    fit = measured(seen, found, parameters.sheet, close_up)
    fit = replace(fit, quality=score_of(seen, found.car, prior, parameters.sheet).quality)
    _check(fit, prior, parameters)
    return fit


def rough_car(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> Rectangle:
    """Return a guess for the drive round the Car; NotLocated with the reason if there is none."""
    try:
        return fit_car(surfels, prior, parameters).rectangle
    except NotLocated:
        guess = guess_from_blobs(surfels, prior, parameters)
        if guess is None:
            raise
        return guess


def _chosen(found: List[CarCandidate]) -> CarCandidate:
    if not found:
        raise NotLocated(problems.TOO_LITTLE_SEEN())
    best = found[0]
    minimum = MIN_QUALITY_ON_WHEELS if best.wheels else MIN_QUALITY
    if best.score.quality < minimum:
        raise NotLocated(problems.UNLIKE(cover_percent=100.0 * best.score.cover, likeness=best.score.quality,
                                         low=minimum))
    for other in found[1:]:
        apart = other.car.pose.distance_to(best.car.pose)
        if (apart > TWO_THINGS_M and other.score.quality >= minimum
                and other.score.total >= ALIKE * best.score.total and not _is_same_thing(best, other)):
            raise NotLocated(problems.TWO_CARS(apart_m=apart))
    return best


def _is_same_thing(best: CarCandidate, other: CarCandidate) -> bool:
    """Return True for a rectangle that shares the Car's wheel treads at one end, without evidence at the other."""
    return best.wheels is not None and new_share(best.seen, best.car, other.car) < MIN_NEW_SHARE


def _check(fit: CarFit, prior: Prior, parameters: LocatorParameters) -> None:
    sheet, car, size = parameters.sheet, fit.rectangle, fit.in_plane
    # A length derived from wheels has a large sigma.
    guess_m = 2.0 * fit.length_sigma if fit.by_wheels else 0.0
    for name, found_m, expected, unsure_m in (("length", size.length or car.length, sheet.length_m, guess_m),
                                              ("width", size.width or car.width, sheet.width_m, 0.0)):
        if abs(found_m - expected) > sheet.size_tolerance_m + unsure_m:
            raise NotLocated(problems.OTHER_SIZE(dimension=name, found_m=found_m, expected_m=expected,
                                                 allowed_m=sheet.size_tolerance_m))
    off_m, off_rad = prior.error_of(car.pose)
    if not is_allowed(car, prior, parameters):
        raise NotLocated(problems.ELSEWHERE(off_m=off_m, off_deg=math.degrees(off_rad),
                                            allowed_m=parameters.position_tolerance_m,
                                            allowed_deg=math.degrees(parameters.heading_tolerance_rad)))
    if not np.all(np.isfinite([car.pose.x, car.pose.y, car.pose.heading, *fit.sigmas, fit.length_sigma,
                               fit.width_sigma])):
        raise NotLocated(problems.NOT_A_NUMBER())
