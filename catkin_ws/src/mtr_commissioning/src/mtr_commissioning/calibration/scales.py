"""Scale of wheels and gyro: a way against a tape, full turns against a mark; each out and back."""
# SPDX-License-Identifier: Apache-2.0
from typing import Sequence, Tuple

from .readings import Estimate, ReadingsUnusable, mean_of

# The start and the end of a way are read to some millimetres, those of a turn to a degree or so.
MIN_WAY_M = 2.0
MIN_TURN_RAD = 6.0


def scale_of(pairs: Sequence[Tuple[float, float]], least: float, unit: str) -> Estimate:
    """What the sensor says has to be multiplied by this, to be true.

    Args:
        pairs: what the sensor said, and what was true, in one unit with signs; out and back.
        least: a shorter way or turn tells too little.
        unit: of both, for the sentence.

    Raises:
        ReadingsUnusable: fewer than two, too short, all in one direction, or of the other sign than the truth.
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
