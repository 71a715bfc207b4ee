"""Mass and centre of mass from all readings, as the parameters of drive control. Pure."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, List, Sequence

import numpy as np

from ..readings import Estimate, ReadingsUnusable, mean_of
from .readings import Chassis, Height, Level, Raised, Tilt

# Minimum distance of the lowest and the highest key; closer heights do not show the rise of the centre with the key.
LEAST_KEY_TRAVEL_M = 0.3
LEAST_HEIGHTS = 4
# Chi-square per degree of freedom above which heights contradict each other.
LARGEST_CHI_SQUARE_PER_FREEDOM = 9.0
GRAVITY_MPS2 = 9.81


@dataclass(frozen=True)
class Balance:
    """Result of the weighing.

    Attributes:
        mass: kg.
        ahead, left: of the centre of mass from the middle of the wheels' contact points, m.
        low: height of the centre of mass above ground with the key at height zero, m (extrapolated). rise: of the
        centre of mass per rise of the key.
    """

    chassis: Chassis
    mass: Estimate
    ahead: Estimate
    left: Estimate
    low: Estimate
    rise: Estimate

    def parameters(self) -> Dict[str, Estimate]:
        """Return the parameters of drive control by their names."""
        return {"centre_of_mass_m": self.low, "centre_of_mass_rise": self.rise,
                "tip_lever_along_m": _lever(self.chassis.base_m, self.ahead),
                "tip_lever_across_m": _lever(self.chassis.track_m, self.left)}


def balance_of(chassis: Chassis, levels: Sequence[Level], raised: Sequence[Raised], tilts: Sequence[Tilt],
               step_kg: float) -> Balance:
    """Return mass and centre of mass.

    Args:
        step_kg: step of the scales.

    Raises:
        ReadingsUnusable: too few or contradicting readings.
    """
    mass = mean_of([level.mass_kg for level in levels], step_kg)
    ahead = mean_of([level.ahead_m(chassis) for level in levels], 0.5 * chassis.base_m * step_kg / mass.value)
    left = mean_of([level.left_m(chassis) for level in levels], 0.5 * chassis.track_m * step_kg / mass.value)
    heights = [each.height(chassis, mass.value, ahead.value, step_kg) for each in raised]
    heights += [each.height(chassis, ahead.value, left.value) for each in tilts]
    low, rise = line_through(heights)
    return Balance(chassis, mass, ahead, left, low, rise)


def line_through(heights: List[Height]) -> List[Estimate]:
    """Return the centre's height with the key at zero, and its slope, by weighted least squares; ReadingsUnusable."""
    if len(heights) < LEAST_HEIGHTS:
        raise ReadingsUnusable(f"The height was read {len(heights)} times; at least {LEAST_HEIGHTS} are needed.")
    keys = np.array([each.key_height_m for each in heights])
    if np.ptp(keys) < LEAST_KEY_TRAVEL_M:
        raise ReadingsUnusable(f"The heights of the key are {np.ptp(keys):.2f} m apart; at least "
                               f"{LEAST_KEY_TRAVEL_M:.2f} m are needed.")
    sigmas = np.array([each.sigma_m for each in heights])
    rows = np.column_stack((np.ones_like(keys), keys)) / sigmas[:, None]
    targets = np.array([each.centre_m for each in heights]) / sigmas
    solution = np.linalg.lstsq(rows, targets, rcond=None)[0]
    freedom = len(heights) - len(solution)
    spread = float(np.sum((targets - rows @ solution) ** 2)) / freedom
    if spread > LARGEST_CHI_SQUARE_PER_FREEDOM:
        raise ReadingsUnusable("The heights of the centre of mass contradict each other: they differ by "
                               f"{math.sqrt(spread):.1f} times their uncertainty. Let the wheels roll freely, and read "
                               "again.")
    deviations = np.sqrt(np.diag(np.linalg.inv(rows.T @ rows)) * max(spread, 1.0))
    return [Estimate(float(value), float(sigma), float(freedom)) for value, sigma in zip(solution, deviations)]


def _lever(width_m: float, offset: Estimate) -> Estimate:
    return Estimate(0.5 * width_m - abs(offset.value), offset.sigma, offset.freedom)


def limit_mps2(parameters: Dict[str, float], lever: str, key_height_m: float) -> float:
    """Return the acceleration at which the robot tips on level ground about the contact points of this lever."""
    height_m = parameters["centre_of_mass_m"] + parameters["centre_of_mass_rise"] * key_height_m
    return GRAVITY_MPS2 * parameters[lever] / height_m
