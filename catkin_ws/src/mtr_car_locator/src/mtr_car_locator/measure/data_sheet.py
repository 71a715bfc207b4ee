"""The size on a Car's data sheet, which distances count from, against what the LiDARs' plane shows of the Car."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import Optional

from ..parameters import MAX_INSET_M, DataSheet
from .car_fit import CarFit, PlaneSize
from .wheels import DATA_SHEET_SIGMA_M

# What is measured beyond this is no chance.
SIGMAS = 3.0


def with_data_sheet(fit: CarFit, sheet: DataSheet) -> CarFit:
    """Length and width of the data sheet where they are given; centre, heading and what was measured stay."""
    car = fit.rectangle
    length, width = sheet.known_length_m or car.length, sheet.known_width_m or car.width
    # The outline is grown only: what was seen of the Car is there, whatever its data sheet says.
    along, across = max(1.0, length / car.length), max(1.0, width / car.width)
    return replace(
        fit, rectangle=replace(car, length=length, width=width),
        outline=tuple((along * x, across * y) for x, y in fit.outline),
        length_sigma=DATA_SHEET_SIGMA_M if sheet.known_length_m else fit.length_sigma,
        width_sigma=DATA_SHEET_SIGMA_M if sheet.known_width_m else fit.width_sigma,
        warning=_warning(fit.in_plane, sheet))


def _warning(size: PlaneSize, sheet: DataSheet) -> str:
    found = (_disagreement("long", size.length, size.length_sigma, sheet.known_length_m),
             _disagreement("wide", size.width, size.width_sigma, sheet.known_width_m))
    return " ".join(sentence for sentence in found if sentence)


def _disagreement(name: str, measured_m: Optional[float], sigma_m: float, known_m: float) -> str:
    if not measured_m or not known_m:
        return ""
    over_m, allowed_m = measured_m - known_m, SIGMAS * (sigma_m + DATA_SHEET_SIGMA_M)
    if -2.0 * MAX_INSET_M - allowed_m <= over_m <= allowed_m:
        return ""
    return (f"The Car is {measured_m:.3f} m {name} at the LiDARs' height, {100.0 * abs(over_m):.1f} cm "
            f"{'more' if over_m > 0.0 else 'less'} than its data sheet says; check which car stands there.")
