"""Mast's lean: distance of the key from a plumb line, with the lift low and high, the robot facing both ways.

On a sloping floor the whole robot leans: after half a turn it leans the other way, while the mast leans with the robot.
Half the sum of both readings is the mast's lean, half the difference the floor's slope.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Sequence, Tuple

from .readings import Estimate, ReadingsUnusable, mean_of

# Minimum distance of the low and the high reading; with a smaller one a millimetre is a large angle.
MIN_RISE_M = 0.2
# Accuracy of reading a rule next to a plumb line, one millimetre.
RESOLUTION_M = 0.001


@dataclass(frozen=True)
class Reading:
    """Distance of the key ahead of the plumb line, in m, at a low and a high position of the lift, with their heights
    in m."""

    low_height_m: float
    low_ahead_m: float
    high_height_m: float
    high_ahead_m: float

    @property
    def lean_deg(self) -> float:
        """Lean of mast and floor together, positive forwards.

        Raises:
            ReadingsUnusable: the rise of the lift is too small.
        """
        rise_m = self.high_height_m - self.low_height_m
        if rise_m < MIN_RISE_M:
            raise ReadingsUnusable(f"The lift rose by {rise_m:.2f} m between the readings; at least {MIN_RISE_M:.2f} m "
                                   "are needed.")
        return math.degrees(math.atan2(self.high_ahead_m - self.low_ahead_m, rise_m))


def lean_of(pairs: Sequence[Tuple[Reading, Reading]]) -> Tuple[Estimate, Estimate]:
    """Return the lean of the mast, forwards, and the slope of the floor towards the first facing, in degrees.

    Args:
        pairs: a reading and one after half a turn on the same spot.

    Raises:
        ReadingsUnusable: fewer than two pairs, or too small a rise of the lift.
    """
    leans = [(first.lean_deg, turned.lean_deg) for first, turned in pairs]
    rises = [reading.high_height_m - reading.low_height_m for pair in pairs for reading in pair]
    # A pair consists of four readings; half of the sum of two differences has the sigma of one reading.
    step_deg = math.degrees(RESOLUTION_M / min(rises)) if rises else 0.0
    return (mean_of([(first + turned) / 2.0 for first, turned in leans], step_deg),
            mean_of([(first - turned) / 2.0 for first, turned in leans], step_deg))
