"""Random Cars with and without a data sheet; every second one has bumpers above the LiDAR plane."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, NamedTuple, Tuple

import numpy as np

from mtr_core.se2 import Pose2
from mtr_simulation.noise import stream

from .bodies import SPARE_WHEEL_M, Fitting, TrueCar

# Data known to the laboratory: nothing, length and width, or also overhang and wheelbase.
NO_SHEET, SIZE, WHOLE = "no data sheet", "size", "data sheet"
SHEETS = (NO_SHEET, SIZE, WHOLE)
LOW, HIGH = ("saloon", "hatchback"), ("pickup", "van", "off-roader", "long saloon")
# Length, share of the wheelbase, width and height by class; the long saloon is the Ford Crown Victoria.
LENGTHS_M: Dict[str, Tuple[float, float]] = {
    "saloon": (4.5, 5.1), "hatchback": (3.6, 4.4), "pickup": (5.1, 5.6), "van": (4.9, 5.5), "off-roader": (4.0, 5.0),
    "long saloon": (5.1, 5.4)}
WHEELBASE_SHARES = {"saloon": (0.56, 0.62), "hatchback": (0.60, 0.68), "pickup": (0.57, 0.62), "van": (0.58, 0.64),
                    "off-roader": (0.55, 0.64), "long saloon": (0.54, 0.56)}
HEIGHTS_M = {"saloon": 1.45, "hatchback": 1.5, "pickup": 1.8, "van": 2.0, "off-roader": 1.8, "long saloon": 1.5}
FRONT_SHARE_OF_OVERHANGS = (0.38, 0.56)
# The LiDAR plane is at 0.3 m.
LOW_CLEARANCE_M, HIGH_CLEARANCE_M = (0.14, 0.26), (0.32, 0.40)
FRONT_INSET_SIGMA_M, REAR_INSET_SIGMA_M, MAX_INSET_M = 0.06, 0.04, 0.20
MIRRORS_M, WHEEL_RADII_M = (0.10, 0.25), (0.29, 0.38)
# Shares of the Cars with a tow bar; with a carrier, a lowered tailgate or an open lid; with a spare wheel. Protrusions
# above 0.25 m are entered as rear_fitting_m, as the checklist before mapping requires.
HAS_TOW_BAR, HAS_LARGE_FITTING, HAS_SPARE_WHEEL = 0.3, 0.2, 0.5
ENTERED_FROM_M = 0.25


class RandomClearanceCar(NamedTuple):
    """Random Car of a seed.

    Attributes:
        kind: class of the Car.
        sheet: data known to the laboratory.
        pose: pose in map.
        rear_fitting_m: protrusion entered by the laboratory.
    """

    kind: str
    car: TrueCar
    sheet: str
    pose: Pose2
    rear_fitting_m: float


def random_car(seed: int, number: int) -> RandomClearanceCar:
    """Return the Car with that number; the same on every machine."""
    chance = stream(seed, f"clearance {number}")
    kind = str(chance.choice(HIGH if number % 2 else LOW))
    length_m = chance.uniform(*LENGTHS_M[kind])
    wheelbase_m = chance.uniform(*WHEELBASE_SHARES[kind]) * length_m
    fittings = _fittings(chance, kind)
    car = TrueCar(length_m, chance.uniform(1.65, 1.75) + 0.25 * (length_m - 3.6) / 2.0, HEIGHTS_M[kind],
                  chance.uniform(*FRONT_SHARE_OF_OVERHANGS) * (length_m - wheelbase_m), wheelbase_m,
                  chance.uniform(*WHEEL_RADII_M),
                  chance.uniform(*(HIGH_CLEARANCE_M if kind in HIGH else LOW_CLEARANCE_M)),
                  _inset(chance, FRONT_INSET_SIGMA_M), _inset(chance, REAR_INSET_SIGMA_M),
                  chance.uniform(*MIRRORS_M), kind == "off-roader" and _has_room_for_a_spare(chance, length_m,
                                                                                             wheelbase_m), fittings)
    entered_m = max((each.out_m for each in fittings), default=0.0)
    pose = Pose2(chance.uniform(-1.0, 1.0), chance.uniform(-1.0, 1.0), chance.uniform(-3.0, 3.0))
    return RandomClearanceCar(kind, car, SHEETS[number // 2 % len(SHEETS)], pose,
                              entered_m if entered_m > ENTERED_FROM_M else 0.0)


def _inset(chance: np.random.Generator, sigma_m: float) -> float:
    return float(min(abs(chance.normal(0.0, sigma_m)), MAX_INSET_M))


def _has_room_for_a_spare(chance: np.random.Generator, length_m: float, wheelbase_m: float) -> bool:
    return bool(chance.random() < HAS_SPARE_WHEEL and length_m - wheelbase_m > 1.5 + SPARE_WHEEL_M)


def _fittings(chance: np.random.Generator, kind: str) -> Tuple[Fitting, ...]:
    found = []
    if chance.random() < HAS_TOW_BAR:
        found.append(Fitting(float(chance.uniform(0.08, 0.20)), 0.04, 0.34, 0.50))
    if chance.random() < HAS_LARGE_FITTING:
        low_m, high_m = (0.60, 0.75) if kind == "pickup" else (1.0, 1.6)
        found.append(Fitting(float(chance.uniform(0.30, 0.65)), 0.65, low_m, high_m))
    return tuple(found)
