"""Fits Cars with different ends, and counts the ends within their published intervals."""
# SPDX-License-Identifier: Apache-2.0
import math
from collections import Counter
from dataclasses import asdict, dataclass
from typing import Any, Dict, List, Optional, Sequence

from mtr_car_locator.find.errors import NotLocated
from mtr_car_locator.find.fit import fit_car
from mtr_car_locator.find.prior import prior_at
from mtr_car_locator.parameters import LocatorParameters
from mtr_car_locator.rectangle import Rectangle
from mtr_core.se2 import Pose2

from ...harness.report import BenchmarkReport
from ...harness.rows import Requirement, Row
from .bodies import DrawnCar, drawn_car
from .views import view_of

# Half width of a 95 % interval, in sigmas.
SIGMAS = 1.96
LEAST, MOST = 0.93, 0.98
# Pose of the Car according to the Operator's starting place.
GUESS = Pose2(0.25, -0.15, 0.05)
SIDES = ("front", "rear", "left", "right")
LOCATED = Requirement("Cars with different ends: located", "(share)", must=0.98, at_least=True)
ABOUT = {
    "front_error_m": "published end less the true one, outwards; positive where distances are too short; of a side "
                     "likewise, in the true Car's frame at its middle",
    "held": "the error is within 1.96 of the end's published sigma",
    "kind": "what is known: bumpers in the LiDARs' plane (both, one, wheels), then the data sheet (size, axles)",
}


@dataclass(frozen=True)
class EndErrors:
    """Errors and sigmas of one Car's sides, m, positive outwards; the names are those in the file."""

    seed: int
    kind: str
    front_error_m: float
    rear_error_m: float
    left_error_m: float
    right_error_m: float
    front_sigma_m: float
    rear_sigma_m: float
    left_sigma_m: float
    right_sigma_m: float
    warning: str = ""

    def error_m(self, side: str) -> float:
        """Return the error of a side."""
        return float(getattr(self, f"{side}_error_m"))

    def sigma_m(self, side: str) -> float:
        """Return the published sigma of a side."""
        return float(getattr(self, f"{side}_sigma_m"))

    def is_held(self, side: str) -> bool:
        """Return True if the side is within its 95 % interval."""
        return abs(self.error_m(side)) <= SIGMAS * self.sigma_m(side)


def ends_of_seed(seed: int) -> Optional[EndErrors]:
    """Return the errors of the seed's Car; None if the Car locator does not find it."""
    car = drawn_car(seed)
    surfels, close_up = view_of(car.segments, car.length_m, car.width_m, seed)
    parameters = LocatorParameters(sheet=car.sheet)
    guess = prior_at(Rectangle(GUESS, car.sheet.length_m, car.sheet.width_m))
    try:
        fit = fit_car(surfels, guess, parameters, close_up)
    except NotLocated:
        return None
    found, x, y = fit.rectangle, 0.5 * fit.rectangle.length, 0.5 * fit.rectangle.width
    at = [found.pose.apply(*place) for place in ((x, 0.0), (-x, 0.0), (0.0, y), (0.0, -y))]
    return EndErrors(seed, kind_of(car), at[0][0] - 0.5 * car.length_m, -at[1][0] - 0.5 * car.length_m,
                     at[2][1] - 0.5 * car.width_m, -at[3][1] - 0.5 * car.width_m, *fit.side_sigmas, fit.warning)


def kind_of(car: DrawnCar) -> str:
    """Return a description of the known data of a Car."""
    bumpers = {0: "wheels", 1: "one bumper", 2: "both bumpers"}[car.front_seen + car.rear_seen]
    sheet = {"size": car.sheet.known_length_m, "axles": car.sheet.front_overhang_m}
    known = [name for name, value_m in sheet.items() if value_m]
    return f"{bumpers}; {' and '.join(known) or 'nothing'} known"


def report(found: Sequence[Optional[EndErrors]]) -> BenchmarkReport:
    """Return the content of car_ends.json."""
    located = [each for each in found if each is not None]
    return BenchmarkReport(rows(found), {"about": ABOUT, "kinds": by_kind(located),
                                         "cars": [asdict(each) for each in located]})


def rows(found: Sequence[Optional[EndErrors]]) -> List[Row]:
    """Return two rows for each side, for intervals that are too narrow and too wide."""
    located = [each for each in found if each is not None]
    told = [Row(LOCATED, len(located) / len(found) if found else None, bool(found), remark=f"{len(found)} Cars")]
    for side in SIDES:
        share = sum(each.is_held(side) for each in located) / len(located) if located else None
        is_end = side in SIDES[:2]
        told += [Row(Requirement(f"Cars with different ends: {side} in its 95 % interval", "(share)",
                                 must=LEAST if is_end else None, at_least=True), share, bool(located)),
                 Row(Requirement(f"Cars with different ends: {side}, not too wide", "(share)",
                                 must=MOST if is_end else None), share, bool(located))]
    return told


def by_kind(located: Sequence[EndErrors]) -> Dict[str, Any]:
    """Return number, covered share and median sigma of each kind of Car."""
    counts = Counter(each.kind for each in located)
    return {kind: {"cars": count, **{side: _figures([each for each in located if each.kind == kind], side)
                                     for side in SIDES}} for kind, count in sorted(counts.items())}


def _figures(cars: Sequence[EndErrors], side: str) -> Dict[str, float]:
    sigmas_m = sorted(each.sigma_m(side) for each in cars)
    return {"held": sum(each.is_held(side) for each in cars) / len(cars), "median_sigma_m": sigmas_m[len(cars) // 2],
            "rms_error_m": math.sqrt(sum(each.error_m(side) ** 2 for each in cars) / len(cars))}
