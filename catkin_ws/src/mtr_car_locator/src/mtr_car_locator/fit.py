"""Finds the Car among surfels in map and measures it."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Dict, List, Optional, Tuple

import numpy as np

from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2

from .axis import Axis, axis_of
from .blobs import guess_from_blobs
from .candidates import MIDDLE_SHARE, Candidate, candidates, is_allowed, near
from .car_fit import CarFit
from .outline import outline_of
from .parameters import CarProfile, LocatorParameters
from .prior import Prior
from .rectangle import Rectangle
from .scoring import belongs, score_of
from .side import ENDS, LONG_SIDES, OUTWARDS, Extent, Side, middle_of, sides_of
from .surfels import Surfels
from .wheels import Wheels, wheel_sides, wheels_between

# Fit of a whole Car, seen from all sides, is 0.7 and more, of one seen from one side and one end 0.35; a wall, a group
# of persons or a neighbour's near side stays below 0.2 (tests/unit/test_locator_scenes.py).
LEAST_QUALITY = 0.25
# The faces of four tyres are 0.2 to 0.3 of a Car's outline; that they stand as a car's do has been checked before.
LEAST_QUALITY_ON_WHEELS = 0.15
# Two candidates are two things when their centres are so far apart, and alike when their evidence is.
TWO_THINGS_M, ALIKE = 0.8, 0.5
LEAST_SURFACE_M = 1.0
# What is not known of a passenger car that is 3.6 to 5.1 m long and 1.65 to 2.05 m wide; 1 sigma.
UNSEEN_SIGMA_M = {ENDS: 0.4, LONG_SIDES: 0.1}
ROUNDS = 4
# Tyres stand inside of the body by more than sills and bumpers do; 1 sigma of that on each side.
TYRE_INSET_SIGMA_M = 0.03
# First the rectangle is rough; in the end only what lies on the outline is the Car's.
FIRST_BEYOND_M, LAST_BEYOND_M = 0.12, 0.06


class NotLocated(RobotError):
    """The surfels do not show a Car that can be trusted; the text says what they show."""


def fit_car(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> CarFit:
    """The Car near the prior; NotLocated, with what was seen, when in doubt."""
    seen = near(surfels, prior, parameters)
    if seen.length.sum() < LEAST_SURFACE_M:
        raise NotLocated("There is nothing of a Car's size where the Car should stand.")
    best = _chosen(candidates(seen, prior, parameters))
    car, axis, wheels = _refined(seen, best, parameters.profile)
    fit = _measured(seen, car, axis, wheels, parameters.profile)
    fit = replace(fit, quality=score_of(seen, fit.rectangle, prior, parameters.profile).quality)
    _check(fit, prior, parameters)
    return fit


def rough_car(surfels: Surfels, prior: Prior, parameters: LocatorParameters) -> Rectangle:
    """A guess that is good enough to go round the Car; NotLocated, with what was seen, when there is none."""
    try:
        return fit_car(surfels, prior, parameters).rectangle
    except NotLocated:
        guess = guess_from_blobs(surfels, prior, parameters)
        if guess is None:
            raise
        return guess


def _chosen(found: List[Candidate]) -> Candidate:
    if not found:
        raise NotLocated("Not enough of a Car was seen: one long side and one end are needed at least, or all four "
                         "wheels.")
    best = found[0]
    least = LEAST_QUALITY_ON_WHEELS if best.wheels else LEAST_QUALITY
    if best.score.quality < least:
        raise NotLocated(f"What stands there looks too little like a Car: {100.0 * best.score.cover:.0f} % of a Car's "
                         f"outline was seen; its likeness is {best.score.quality:.2f}, needed is {least:g}.")
    for other in found[1:]:
        apart = other.car.pose.distance_to(best.car.pose)
        if (apart > TWO_THINGS_M and other.score.quality >= least
                and other.score.total >= ALIKE * best.score.total):
            raise NotLocated(f"Two things of a Car's size stand there, {apart:.1f} m apart, and which of them is the "
                             "Car cannot be told.")
    return best


def _refined(seen: Surfels, best: Candidate, profile: CarProfile) -> Tuple[Rectangle, Optional[Axis], Optional[Wheels]]:
    """The candidate moved to what the surfels on its outline show."""
    car, wheels, axis = best.car, best.wheels, None
    for turn in range(ROUNDS):
        beyond_m = FIRST_BEYOND_M if turn == 0 else LAST_BEYOND_M
        in_car = seen.in_frame(car.pose)
        sides = sides_of(in_car.where(belongs(in_car, car, beyond_m)))
        axis = axis_of(*(sides[name] for name in LONG_SIDES), length=car.length)
        if axis is None:
            raise NotLocated("The Car's long sides were seen too little to tell its heading.")
        car = car.moved_by(Pose2(0.0, axis.offset_m if axis.is_centred else 0.0, math.atan(axis.slope)))
        if best.wheels:
            wheels = _wheels_of(seen.in_frame(car.pose), car, profile)
        car = _sized(seen, car, axis, wheels, profile)
    return car, axis, wheels


def _wheels_of(in_car: Surfels, car: Rectangle, profile: CarProfile) -> Wheels:
    found = wheels_between(wheel_sides(in_car), 0.0, car.width, profile)
    if found is None:
        raise NotLocated("Only wheels of the Car were seen, and they do not stand as a car's do.")
    return found


def _sized(seen: Surfels, car: Rectangle, axis: Axis, wheels: Optional[Wheels], profile: CarProfile) -> Rectangle:
    """Centre and size from the outermost levels."""
    in_car = seen.in_frame(car.pose)
    extents = _extents(sides_of(in_car.where(belongs(in_car, car, FIRST_BEYOND_M))), car)
    y, width = _span([extents.get(name) for name in LONG_SIDES], profile.width_m)
    if wheels:
        x, length = wheels.centre_m, wheels.length_m
    else:
        x, length = _span([extents.get(name) for name in ENDS], profile.length_m)
    # The axis of symmetry tells more than two outermost points.
    return Rectangle(car.pose @ Pose2(x, 0.0 if axis.is_centred else y, 0.0), length, width)


def _extents(sides: Dict[str, Side], car: Rectangle) -> Dict[str, Extent]:
    """Levels of the sides that were seen."""
    reach = {name: (-0.5 * size, 0.5 * size) for name, size in _sizes(car).items()}
    parts = {name: side.within(*middle_of(reach[name], MIDDLE_SHARE)) if name in ENDS else side
             for name, side in sides.items()}
    found = {name: part.extent() for name, part in parts.items()}
    return {name: extent for name, extent in found.items() if extent is not None}


def _sizes(car: Rectangle) -> Dict[str, float]:
    return {name: car.width if name in ENDS else car.length for name in OUTWARDS}


def _span(pair: List[Optional[Extent]], expected_m: float) -> Tuple[float, float]:
    ahead, behind = pair
    if ahead and behind:
        return 0.5 * (ahead.level - behind.level), ahead.level + behind.level
    if ahead:
        return ahead.level - 0.5 * expected_m, expected_m
    return (0.5 * expected_m - behind.level, expected_m) if behind else (0.0, expected_m)


def _measured(seen: Surfels, car: Rectangle, axis: Axis, wheels: Optional[Wheels], profile: CarProfile) -> CarFit:
    """Sigmas, outline and the surfels that are the Car's."""
    in_car = seen.in_frame(car.pose)
    mine = in_car.where(belongs(in_car, car, LAST_BEYOND_M))
    extents = _extents(sides_of(mine), car)
    names = tuple(name for name in OUTWARDS if name in extents and not (wheels and name in ENDS))
    y_sigma, width_sigma = _sigmas(LONG_SIDES, extents, profile.known_width_m, profile)
    if axis.is_centred:
        y_sigma = axis.offset_sigma_m
    if wheels:
        x_sigma, length_sigma = wheels.centre_sigma_m, wheels.length_sigma_m
        width_sigma = math.hypot(width_sigma, 0.0 if profile.known_width_m else math.sqrt(2.0) * TYRE_INSET_SIGMA_M)
    else:
        x_sigma, length_sigma = _sigmas(ENDS, extents, profile.known_length_m, profile)
    if wheels and profile.known_width_m:
        car = replace(car, width=profile.known_width_m)
    elif all(name in extents for name in LONG_SIDES):
        car = replace(car, width=car.width + 2.0 * profile.side_inset_m)
    whole = in_car.where(car.outside(in_car.position) <= LAST_BEYOND_M)
    return CarFit(car, outline_of(mine, car, names), (x_sigma, y_sigma, axis.slope_sigma), length_sigma, width_sigma,
                  names, whole, 0.0, wheels is not None)


def _sigmas(pair: Tuple[str, str], extents: Dict[str, Extent], known_m: float,
            profile: CarProfile) -> Tuple[float, float]:
    """1 sigma of the middle between two opposite sides and of their distance."""
    found = [extents[name].sigma for name in pair if name in extents]
    inset = math.sqrt(2.0) * profile.side_inset_sigma_m
    if len(found) == 2:
        own = math.hypot(*found)
        return 0.5 * own, math.hypot(own, inset)
    size_sigma = inset if known_m else UNSEEN_SIGMA_M[pair]
    return math.hypot(0.5 * size_sigma, found[0] if found else size_sigma), size_sigma


def _check(fit: CarFit, prior: Prior, parameters: LocatorParameters) -> None:
    profile, car = parameters.profile, fit.rectangle
    for name, size, expected in (("length", car.length, profile.length_m), ("width", car.width, profile.width_m)):
        if abs(size - expected) > profile.size_tolerance_m:
            raise NotLocated(f"What was found has a {name} of {size:.2f} m; expected is {expected:.2f} m, at most "
                             f"{profile.size_tolerance_m:.2f} m off.")
    off_m, off_rad = prior.error_of(car.pose)
    if not is_allowed(car, prior, parameters):
        raise NotLocated(f"What was found is {off_m:.2f} m and {math.degrees(off_rad):.0f} deg away from where the Car "
                         f"should stand; allowed is {parameters.position_tolerance_m:.2f} m and "
                         f"{math.degrees(parameters.heading_tolerance_rad):.0f} deg.")
    if not np.all(np.isfinite([car.pose.x, car.pose.y, car.pose.heading, *fit.sigmas, fit.length_sigma,
                               fit.width_sigma])):
        raise NotLocated("The fit of the Car is not a number.")
