"""Size and centre of a Car whose rectangle has been found, with their uncertainty."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np

from mtr_core.se2 import Pose2

from ..parameters import ORDINARY_LENGTH_M, ORDINARY_WIDTH_M, DataSheet
from ..rectangle import Rectangle
from ..surfels import Surfels
from .axis import SymmetryAxis
from .belonging import belongs
from .car_fit import CarFit, PlaneSize
from .close_up import CloseUp
from .data_sheet import with_data_sheet
from .incidence import MIN_INCIDENCE_COSINE
from .outline import outline_of
from .side import ENDS, LONG_SIDES, MAP_SHARE, MIDDLE_SHARE, OUTWARDS, Side, SideExtent, middle_of, sides_of
from .side_profile import outermost, profile_of, summit
from .wheels import CarWheels

# What lies on the outline is the Car's.
BEYOND_M = 0.06
# When nothing is seen of an end or a side each ordinary size is as likely: 1 sigma of a uniform distribution.
UNSEEN_SIGMA_M = {pair: (high - low) / math.sqrt(12.0)
                  for pair, (low, high) in ((ENDS, ORDINARY_LENGTH_M), (LONG_SIDES, ORDINARY_WIDTH_M))}
# Tyres stand inside of the body by more than sills and bumpers do; 1 sigma of that on each side.
TYRE_INSET_SIGMA_M = 0.03
# Returns so near the level that surfels show are the side's.
NEAR_M = 0.12
# A level is wrong by what its profile does not show too, such as the sway of the robot: with this lengths and widths in
# 36 drives with 2 cm of noise are as far off as their sigmas say.
LEVEL_SIGMA_M = 0.0008
# Surfels need more support than returns do; so far beyond them there is a leg or a mirror.
BEYOND_ROUGH_M = 0.04


@dataclass(frozen=True)
class AlignedCar:
    """A Car's rectangle in map, its axis of symmetry, and its wheels if neither front nor rear was seen."""

    car: Rectangle
    axis: SymmetryAxis
    wheels: Optional[CarWheels]


def measured(seen: Surfels, found: AlignedCar, sheet: DataSheet, close_up: Optional[CloseUp]) -> CarFit:
    """Centre, size, sigmas, outline and the surfels that are the Car's; quality is still 0."""
    car, axis, wheels = found.car, found.axis, found.wheels
    in_car = seen.in_frame(car.pose)
    extents = extents_of(sides_of(in_car.where(belongs(in_car, car, BEYOND_M))), car)
    if close_up is not None:
        extents = finer(extents, close_up.in_frame(car.pose), car, [] if wheels else ENDS)
    car = sized(car, extents, axis, wheels, sheet)
    in_car = seen.in_frame(car.pose)
    mine = in_car.where(belongs(in_car, car, BEYOND_M))
    names = tuple(name for name in OUTWARDS if name in extents and not (wheels and name in ENDS))
    sigmas, sizes = _sigmas(extents, found, sheet)
    fit = CarFit(car, outline_of(mine, car, names), sigmas, *sizes, names,
                 in_car.where(car.outside(in_car.position) <= BEYOND_M), 0.0, wheels is not None,
                 PlaneSize() if wheels else _plane_size(extents))
    return with_data_sheet(_with_inset(fit, sheet), sheet)


def sized(car: Rectangle, extents: Dict[str, SideExtent], axis: SymmetryAxis, wheels: Optional[CarWheels],
          sheet: DataSheet) -> Rectangle:
    """Centre and size from the outermost levels."""
    y, width = _span([extents.get(name) for name in LONG_SIDES], sheet.width_m)
    if wheels:
        x, length = wheels.centre_m, wheels.length_m
    else:
        x, length = _span([extents.get(name) for name in ENDS], sheet.length_m)
    # The axis of symmetry tells more than two outermost points.
    return Rectangle(car.pose @ Pose2(x, 0.0 if axis.is_centred else y, 0.0), length, width)


def extents_of(sides: Dict[str, Side], car: Rectangle) -> Dict[str, SideExtent]:
    """Levels of the sides that surfels show."""
    parts = {name: side.within(*middle_of(_reach(name, car), MIDDLE_SHARE)) if name in ENDS else side
             for name, side in sides.items()}
    found = {name: part.extent() for name, part in parts.items()}
    return {name: extent for name, extent in found.items() if extent is not None}


def finer(extents: Dict[str, SideExtent], close_up: CloseUp, car: Rectangle, ends: Sequence[str]
          ) -> Dict[str, SideExtent]:
    """The same levels from all returns near them, as far as these tell; close_up is in the Car's frame."""
    found = dict(extents)
    for name in (*LONG_SIDES, *ends):
        level = _close_level(name, extents[name], close_up, car) if name in extents else None
        if level is not None:
            shared_m = math.hypot(LEVEL_SIGMA_M, MAP_SHARE * extents[name].map_sigma)
            found[name] = replace(level, sigma=math.hypot(level.sigma, shared_m))
    return found


def _close_level(name: str, rough: SideExtent, close_up: CloseUp, car: Rectangle) -> Optional[SideExtent]:
    outwards = np.array(OUTWARDS[name])
    along, outward = close_up.points @ np.abs(outwards[::-1]), close_up.points @ outwards
    low, high = middle_of(_reach(name, car), MIDDLE_SHARE if name in ENDS else 1.0)
    used = ((along >= low) & (along <= high) & (close_up.beams @ outwards < -MIN_INCIDENCE_COSINE)
            & (np.abs(outward - rough.level) < NEAR_M))
    profile = profile_of(along[used], outward[used])
    if profile is None:
        return None
    profile = profile.below(rough.level + BEYOND_ROUGH_M)
    return summit(profile) if name in ENDS else outermost(profile)


def _reach(name: str, car: Rectangle) -> Tuple[float, float]:
    half = 0.5 * (car.width if name in ENDS else car.length)
    return -half, half


def _span(pair: List[Optional[SideExtent]], expected_m: float) -> Tuple[float, float]:
    ahead, behind = pair
    if ahead and behind:
        return 0.5 * (ahead.level - behind.level), ahead.level + behind.level
    if ahead:
        return ahead.level - 0.5 * expected_m, expected_m
    return (0.5 * expected_m - behind.level, expected_m) if behind else (0.0, expected_m)


def _plane_size(extents: Dict[str, SideExtent]) -> PlaneSize:
    length, width = (_distance_between([extents[name] for name in pair if name in extents])
                     for pair in (ENDS, LONG_SIDES))
    return PlaneSize(*length, *width)


def _distance_between(sides: List[SideExtent]) -> Tuple[Optional[float], float]:
    """Of two opposite sides, and its 1 sigma; None when fewer were seen."""
    if len(sides) < 2:
        return None, 0.0
    return sides[0].level + sides[1].level, math.hypot(sides[0].sigma, sides[1].sigma)


def _with_inset(fit: CarFit, sheet: DataSheet) -> CarFit:
    if fit.in_plane.width is None:
        return fit
    return replace(fit, rectangle=replace(fit.rectangle, width=fit.rectangle.width + 2.0 * sheet.side_inset_m))


def _sigmas(extents: Dict[str, SideExtent], found: AlignedCar,
            sheet: DataSheet) -> Tuple[Tuple[float, float, float], Tuple[float, float]]:
    """1 sigma of the Car's pose, and of its length and width."""
    x_sigma, length_sigma = _pair_sigmas(ENDS, extents, sheet.known_length_m, sheet)
    y_sigma, width_sigma = _pair_sigmas(LONG_SIDES, extents, sheet.known_width_m, sheet)
    if found.axis.is_centred:
        y_sigma = found.axis.offset_sigma_m
    if found.wheels:
        x_sigma, length_sigma = found.wheels.centre_sigma_m, found.wheels.length_sigma_m
        width_sigma = math.hypot(width_sigma, math.sqrt(2.0) * TYRE_INSET_SIGMA_M)
    return (x_sigma, y_sigma, found.axis.slope_sigma), (length_sigma, width_sigma)


def _pair_sigmas(pair: Tuple[str, str], extents: Dict[str, SideExtent], known_m: float,
                 sheet: DataSheet) -> Tuple[float, float]:
    """1 sigma of the middle between two opposite sides and of their distance."""
    found = [extents[name].sigma for name in pair if name in extents]
    # A body is symmetric: both sides stand back alike, and both ends in the same direction.
    inset = 2.0 * sheet.side_inset_sigma_m
    if len(found) == 2:
        own = math.hypot(*found)
        return 0.5 * own, math.hypot(own, inset)
    size_sigma = inset if known_m else UNSEEN_SIGMA_M[pair]
    if not found:
        return math.hypot(0.5 * size_sigma, size_sigma), size_sigma
    # Opposite insets cancel in the middle between two sides; that of a single one does not.
    return math.hypot(math.hypot(0.5 * size_sigma, sheet.side_inset_sigma_m), found[0]), size_sigma
