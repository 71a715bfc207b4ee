"""Comparison of the data sheet size, to which distances refer, with the size in the scan plane."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Dict, Iterator, List, Optional, Tuple

from ..parameters import DATA_SHEET_SIGMA_M, MAX_INSET_M, DataSheet
from ..rectangle import Point, Rectangle
from .car_fit import CarFit
from .ends import Ends
from .side import ENDS, LONG_SIDES, SideExtent

# Deviations above this number of sigmas are significant.
SIGMAS = 3.0
# A larger inset, in sigmas of its prior, is unusual for a car.
INSET_SIGMAS = 2.0
# A larger 1 sigma of the front makes distances from it uncertain by centimetres.
VAGUE_M = 0.02


def with_data_sheet(fit: CarFit, sheet: DataSheet, warning: str, contradiction: str = "") -> CarFit:
    """Return the fit with length and width of the data sheet, if given, and an outline of that size."""
    car = fit.rectangle
    car = replace(car, length=sheet.known_length_m or car.length, width=sheet.known_width_m or car.width)
    return replace(fit, rectangle=car, outline=_grown(fit.outline, car), warning=warning,
                   contradiction=contradiction)


def _grown(outline: Tuple[Point, ...], car: Rectangle) -> Tuple[Point, ...]:
    """Extend the outline to each side of the Car; never shrink it, because the seen parts are there."""
    half = (0.5 * car.length, 0.5 * car.width)
    # Factors for the parts in front of and behind the centre, then left and right of it.
    factors = [[max(1.0, half[axis] / max(sign * point[axis] for point in outline)) for sign in (1.0, -1.0)]
               for axis in (0, 1)]
    return tuple((x * factors[0][int(x < 0.0)], y * factors[1][int(y < 0.0)]) for x, y in outline)


def warning_of(extents: Dict[str, SideExtent], ends: Ends, sheet: DataSheet) -> str:
    """Return sentences about contradictions of the data sheet or about ends with a large uncertainty; empty if none."""
    return " ".join(filter(None, (contradiction_of(extents, ends, sheet), _vagueness_of(ends, sheet))))


def contradiction_of(extents: Dict[str, SideExtent], ends: Ends, sheet: DataSheet) -> str:
    """Return sentences about contradictions of the data sheet; empty if none."""
    found = [_disagreement("wide", [extents.get(name) for name in LONG_SIDES], sheet.known_width_m, 2.0 * MAX_INSET_M)]
    if sheet.known_length_m:
        insets_m = INSET_SIGMAS * math.hypot(sheet.front_inset_sigma_m, sheet.rear_inset_sigma_m)
        found.append(_disagreement("long", [extents.get(name) for name in ENDS], sheet.known_length_m, insets_m))
    if ends.front_beyond_m:
        found.append(_end_elsewhere("front", -ends.front_beyond_m))
    found += _ends_that_disagree(extents, ends, sheet)
    return " ".join(filter(None, found))


def _vagueness_of(ends: Ends, sheet: DataSheet) -> str:
    if sheet.known_length_m and max(ends.front_sigma_m, ends.rear_sigma_m) > VAGUE_M:
        vague_cm = 100.0 * max(ends.front_sigma_m, ends.rear_sigma_m)
        return (f"The Car's front and rear are known to {vague_cm:.1f} cm (1 sigma) only; front_overhang_m and "
                "wheelbase_m of its data sheet make them more exact.")
    return ""


def _disagreement(name: str, pair: List[Optional[SideExtent]], known_m: float, most_m: float) -> str:
    """Return a sentence about a contradiction. most_m: largest sum of the insets of both sides."""
    seen = [each for each in pair if each is not None]
    if len(seen) < 2 or not known_m:
        return ""
    measured_m, sigma_m = seen[0].level + seen[1].level, math.hypot(seen[0].sigma, seen[1].sigma)
    over_m, allowed_m = measured_m - known_m, SIGMAS * (sigma_m + DATA_SHEET_SIGMA_M)
    if -most_m - allowed_m <= over_m <= allowed_m:
        return ""
    return (f"The Car is {measured_m:.3f} m {name} at the LiDARs' height, {100.0 * abs(over_m):.1f} cm "
            f"{'more' if over_m > 0.0 else 'less'} than its data sheet says; check which car stands there.")


def _ends_that_disagree(extents: Dict[str, SideExtent], ends: Ends, sheet: DataSheet) -> Iterator[str]:
    """Yield one sentence for each end whose bumper is not at the position from axles and data sheet."""
    for name, outward_m, sigma_m, inset_sigma_m in (
            ("front", ends.front_m, ends.front_sigma_m, sheet.front_inset_sigma_m),
            ("rear", -ends.rear_m, ends.rear_sigma_m, sheet.rear_inset_sigma_m)):
        level = extents.get(name)
        if level is None or sigma_m > VAGUE_M:
            continue
        inset_m, allowed_m = outward_m - level.level, SIGMAS * math.hypot(sigma_m, level.sigma)
        if not -allowed_m <= inset_m <= INSET_SIGMAS * inset_sigma_m + allowed_m:
            yield _end_elsewhere(name, inset_m)


def _end_elsewhere(name: str, inset_m: float) -> str:
    return (f"The Car's {name} bumper at the LiDARs' height is {100.0 * abs(inset_m):.1f} cm "
            f"{'inside' if inset_m > 0.0 else 'beyond'} the {name} of its data sheet; check front_overhang_m and which "
            "car stands there.")
