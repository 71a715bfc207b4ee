"""Compares the weighing with the description, and states the values to set. Pure."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Dict, List, Mapping

from .estimate import Balance, limit_mps2

LEVERS = {"tip_lever_along_m": "ahead or back", "tip_lever_across_m": "to a side"}
# Parameters are written to a tenth of a millimetre.
_STEPS_PER_M = 1e4


def values_to_set(balance: Balance) -> Dict[str, float]:
    """Return the parameters of drive control, rounded in the direction of gentler braking."""
    rounded = {}
    for name, estimate in balance.parameters().items():
        steps = round(estimate.value * _STEPS_PER_M, 6)
        rounded[name] = (math.floor(steps) if name in LEVERS else math.ceil(steps)) / _STEPS_PER_M
    return rounded


def optimistic(balance: Balance, described: Mapping[str, float], key_heights_m: List[float]) -> List[str]:
    """Return a sentence for each direction and key height at which the description tips later than the robot.

    Differences within 1 sigma of the measurement are ignored.
    """
    measured = {name: estimate.value for name, estimate in balance.parameters().items()}
    sentences = []
    for lever, direction in LEVERS.items():
        for key_height_m in key_heights_m:
            true_mps2 = limit_mps2(measured, lever, key_height_m)
            said_mps2 = limit_mps2(dict(described), lever, key_height_m)
            sigma_mps2 = true_mps2 * relative_sigma(balance, lever, key_height_m)
            if said_mps2 > true_mps2 + sigma_mps2:
                sentences.append(
                    f"WARNING: with the key at {key_height_m:.2f} m the robot tips {direction} at {true_mps2:.2f} m/s2 "
                    f"(1 sigma {sigma_mps2:.2f}); by its description at {said_mps2:.2f} m/s2, which is too optimistic.")
    return sentences


def relative_sigma(balance: Balance, lever: str, key_height_m: float) -> float:
    """Return 1 sigma of the measured limit, relative to it."""
    parameters = balance.parameters()
    height_m = balance.low.value + balance.rise.value * key_height_m
    # Upper bound: height at zero and slope count as independent.
    height_sigma_m = math.hypot(balance.low.sigma, balance.rise.sigma * key_height_m)
    return math.hypot(parameters[lever].sigma / parameters[lever].value, height_sigma_m / height_m)
