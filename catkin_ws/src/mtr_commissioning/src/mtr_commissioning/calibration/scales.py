"""Scales of wheels and gyro: a distance against a tape, full turns against a mark; each out and back."""
# SPDX-License-Identifier: Apache-2.0
from typing import Sequence, Tuple

from .readings import Estimate, ReadingsUnusable, mean_of

# The ends of a path are read to some millimetres, the ends of a turn to about a degree.
MIN_WAY_M = 2.0
MIN_TURN_RAD = 6.0


def scale_of(pairs: Sequence[Tuple[float, float]], least: float, unit: str) -> Estimate:
    """Return the factor from the sensor's value to the true one.

    Args:
        pairs: sensor values and true values, in one unit with signs; out and back.
        least: minimum distance or rotation.
        unit: of both, for the sentence.

    Raises:
        ReadingsUnusable: fewer than two, too short, all in one direction, or of opposite sign to the true value.
    """
    for said, true in pairs:
        if abs(true) < least:
            raise ReadingsUnusable(f"One of the readings is {abs(true):g} {unit}; at least {least:g} {unit} are "
                                   "needed.")
        if said * true <= 0.0:
            raise ReadingsUnusable(f"The sensor says {said:.2f} {unit} where it was {true:.2f} {unit}: its sign is "
                                   "wrong, or it is silent. Run preflight --drive.")
    if len({true > 0.0 for _, true in pairs}) == 1:
        raise ReadingsUnusable("All readings are in one direction; read out and back, so that a drift cancels.")
    return mean_of([true / said for said, true in pairs])
