"""Size and centre of a Car with a known rectangle, with their uncertainties."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, replace
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np

from mtr_core.se2 import Pose2

from ..parameters import DATA_SHEET_SIGMA_M, ORDINARY_LENGTH_M, ORDINARY_WIDTH_M, DataSheet
from ..rectangle import Rectangle
from ..surfels import Surfels
from .axis import SymmetryAxis
from .axles import Axles
from .belonging import belongs
from .car_fit import CarFit, PlaneSize, SideSigmas
from .close_up import CloseUp
from .data_sheet import contradiction_of, warning_of, with_data_sheet
from .ends import EndEvidence, Ends, Estimate, ends_of
from .incidence import MIN_INCIDENCE_COSINE
from .outline import outline_of
from .overhangs import outwards_of
from .side import ENDS, LONG_SIDES, MAP_SHARE, MIDDLE_SHARE, OUTWARDS, Side, SideExtent, middle_of, sides_of
from .side_profile import outermost, profile_of, summit
from .tyre_faces import faces_in
from .wheels import CarWheels, wheels_from

# Surfels within this distance of the outline belong to the Car.
BEYOND_M = 0.06
# For an unseen end or side, each ordinary size is equally likely: 1 sigma of a uniform distribution.
UNSEEN_SIGMA_M = {pair: (high - low) / math.sqrt(12.0)
                  for pair, (low, high) in ((ENDS, ORDINARY_LENGTH_M), (LONG_SIDES, ORDINARY_WIDTH_M))}
# Tyres are farther inside the body than sills and bumpers; 1 sigma of that on each side.
TYRE_INSET_SIGMA_M = 0.03
# Gate of returns round the level from surfels.
NEAR_M = 0.12
# Level error that is not visible in its profile, such as sway of the robot. With this value, length and width errors in
# 36 drives with 2 cm of noise agree with their sigmas.
LEVEL_SIGMA_M = 0.0008
# Surfels need more support than returns do; farther out than this, a return belongs to a leg or a mirror.
BEYOND_ROUGH_M = 0.04


@dataclass(frozen=True)
class AlignedCar:
    """A Car's rectangle in map, its axis of symmetry, and its wheels if neither front nor rear was seen."""

    car: Rectangle
    axis: SymmetryAxis
    wheels: Optional[CarWheels]


def measured(seen: Surfels, found: AlignedCar, sheet: DataSheet, close_up: Optional[CloseUp]) -> CarFit:
    """Return centre, size, sigmas, outline and surfels of the Car; quality is still 0."""
    car, axis, wheels = found.car, found.axis, found.wheels
    in_car = seen.in_frame(car.pose)
    extents = extents_of(sides_of(in_car.where(belongs(in_car, car, BEYOND_M))), car)
    near = None if close_up is None else close_up.in_frame(car.pose)
    if near is not None:
        extents = finer(extents, near, car, [] if wheels else ENDS)
    names = tuple(name for name in OUTWARDS if name in extents and not (wheels and name in ENDS))
    ends = wheels.ends if wheels else ends_in(extents, None if near is None else axles_in(near, extents, sheet), sheet)
    plane = _in_plane(sized(car, extents, axis, wheels, sheet), car, ends, {name: extents[name] for name in names})
    sides = sides_across(extents, axis, sheet, on_wheels=wheels is not None)
    in_plane = seen.in_frame(plane.pose)
    outline = outline_of(in_plane.where(belongs(in_plane, plane, BEYOND_M)), plane, names)
    # The Car's centre may differ from the middle between its bumpers in the scan plane.
    ahead = Pose2(ends.centre_m - (car.pose.inverse() @ plane.pose).x, 0.0, 0.0)
    mine = in_plane.where(plane.outside(in_plane.position) <= BEYOND_M).in_frame(ahead)
    width_m = plane.width + (2.0 * sheet.side_inset_m if all(name in extents for name in LONG_SIDES) else 0.0)
    fit = CarFit(Rectangle(plane.pose @ ahead, ends.length_m, width_m), tuple((x - ahead.x, y) for x, y in outline),
                 (ends.centre_sigma_m, sides.middle_sigma_m, axis.slope_sigma), ends.length_sigma_m,
                 sides.width_sigma_m, names, mine, 0.0, wheels is not None,
                 PlaneSize() if wheels else _plane_size(extents), side_sigmas=SideSigmas(
                     ends.front_sigma_m, ends.rear_sigma_m, *sides.side_sigmas_m))
    compared = extents if not wheels else {}
    return with_data_sheet(fit, sheet, warning_of(compared, ends, sheet), contradiction_of(compared, ends, sheet))


def _in_plane(rough: Rectangle, car: Rectangle, ends: Ends, seen: Dict[str, SideExtent]) -> Rectangle:
    """Return the rectangle in the scan plane: bumpers that were seen, otherwise the ends."""
    ahead_m = seen["front"].level if "front" in seen else ends.front_m
    behind_m = -seen["rear"].level if "rear" in seen else ends.rear_m
    y_m = (car.pose.inverse() @ rough.pose).y
    return Rectangle(car.pose @ Pose2(0.5 * (ahead_m + behind_m), y_m, 0.0), ahead_m - behind_m, rough.width)


def sized(car: Rectangle, extents: Dict[str, SideExtent], axis: SymmetryAxis, wheels: Optional[CarWheels],
          sheet: DataSheet) -> Rectangle:
    """Return centre and size from the outermost levels."""
    y, width = _span([extents.get(name) for name in LONG_SIDES], sheet.width_m)
    if wheels:
        x, length = wheels.ends.centre_m, wheels.ends.length_m
    else:
        x, length = _span([extents.get(name) for name in ENDS], sheet.length_m)
    # The axis of symmetry is more accurate than two outermost points.
    return Rectangle(car.pose @ Pose2(x, 0.0 if axis.is_centred else y, 0.0), length, width)


def extents_of(sides: Dict[str, Side], car: Rectangle) -> Dict[str, SideExtent]:
    """Return the levels of the sides from surfels."""
    parts = {name: side.within(*middle_of(_reach(name, car), MIDDLE_SHARE)) if name in ENDS else side
             for name, side in sides.items()}
    found = {name: part.extent() for name, part in parts.items()}
    return {name: extent for name, extent in found.items() if extent is not None}


def finer(extents: Dict[str, SideExtent], close_up: CloseUp, car: Rectangle, ends: Sequence[str]
          ) -> Dict[str, SideExtent]:
    """Return the levels from all returns near them, if sufficient; close_up is in the Car's frame."""
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
    """Return the distance of two opposite sides and its 1 sigma; None if fewer were seen."""
    if len(sides) < 2:
        return None, 0.0
    return sides[0].level + sides[1].level, math.hypot(sides[0].sigma, sides[1].sigma)


@dataclass(frozen=True)
class SidesAcross:
    """1 sigma of the middle between both long sides, of their distance, and of the left and the right one, m."""

    middle_sigma_m: float
    width_sigma_m: float
    side_sigmas_m: Tuple[float, float]


def sides_across(extents: Dict[str, SideExtent], axis: SymmetryAxis, sheet: DataSheet, *,
                 on_wheels: bool) -> SidesAcross:
    """Return the uncertainty of both long sides. A body is symmetric: both have the same inset in the scan plane."""
    found = {name: extents[name].sigma for name in LONG_SIDES if name in extents}
    tyres_m = math.sqrt(2.0) * TYRE_INSET_SIGMA_M if on_wheels else 0.0
    if len(found) == 2:
        own_m = math.hypot(*found.values())
        width_m = DATA_SHEET_SIGMA_M if sheet.known_width_m else math.hypot(
            own_m, 2.0 * sheet.side_inset_sigma_m, tyres_m)
        middle_m = axis.offset_sigma_m if axis.is_centred else 0.5 * own_m
        return SidesAcross(middle_m, width_m, 2 * (math.hypot(middle_m, 0.5 * width_m),))
    width_m = DATA_SHEET_SIGMA_M if sheet.known_width_m else UNSEEN_SIGMA_M[LONG_SIDES]
    # Opposite insets cancel in the middle between two sides, but not for a single side.
    near_m = math.hypot(*found.values(), sheet.side_inset_sigma_m, 0.5 * tyres_m) if found else width_m
    left_m, right_m = (near_m if name in found else math.hypot(near_m, width_m) for name in LONG_SIDES)
    return SidesAcross(math.hypot(near_m, 0.5 * width_m), width_m, (left_m, right_m))


def axles_in(close_up: CloseUp, extents: Dict[str, SideExtent], sheet: DataSheet) -> Optional[Axles]:
    """Return the axles of a Car with a body in the scan plane, from tyres in its wheel arches; None if unclear.

    close_up is in the frame of the extents.
    """
    if not all(name in extents for name in LONG_SIDES):
        return None
    wheels = wheels_from([faces_in(close_up, name, extents[name].level, in_arches=True) for name in LONG_SIDES], sheet)
    return wheels.axles if wheels else None


def ends_in(extents: Dict[str, SideExtent], axles: Optional[Axles], sheet: DataSheet) -> Ends:
    """Return front and rear from seen bumpers, and from the axles if the overhang is known or a bumper is missing."""
    front, rear = extents.get("front"), extents.get("rear")
    ahead, behind = outwards_of(axles, sheet) if axles else (None, None)
    at_front = EndEvidence(front, sheet.front_inset_sigma_m, ahead if sheet.front_overhang_m or not front else None)
    at_rear = EndEvidence(rear, sheet.rear_inset_sigma_m, None if rear else behind)
    # With a known wheelbase, a matching arrangement identifies the Car's wheels.
    beyond_m = at_front.contradiction_m(is_axle_sure=bool(sheet.wheelbase_m))
    if beyond_m:
        at_front = replace(at_front, by_axle=None)
    ordinary = Estimate(sheet.length_m, UNSEEN_SIGMA_M[ENDS])
    found = ends_of(at_front, at_rear, ordinary, sheet.known_length_m)
    found = found or Ends(0.5 * sheet.length_m, -0.5 * sheet.length_m, *3 * (ordinary.sigma_m,))
    return replace(found, front_beyond_m=beyond_m)
