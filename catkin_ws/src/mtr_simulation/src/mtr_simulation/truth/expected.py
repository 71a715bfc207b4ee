"""Results of a perfect measurement of a line, from the Car's model: distances at 50 and 95 %, static boundary."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from ..car.honest.radio.key_antenna import Attitude
from ..car.reaction.model import ReactionModel
from .distance import CarSize, Expected, start_and_direction
from .monotone import falls_below
from .results import MeasuredEvent

# Range and step of the evaluation of p along a line: passive entry ends within 10 m, buttons work farther away.
_NEAREST_M = 0.1
_STEP_M = 0.02
_FARTHEST_M = {"unlock": 10.0, "lock": 10.0, "handle": 10.0, "press": 60.0, "reach": 60.0}


class Line:
    """Places of the key along a line, carried by the robot ahead of itself towards the Car."""

    def __init__(self, event: MeasuredEvent, size: CarSize, key_height_m: float):
        (start_x, start_y), (along_x, along_y) = start_and_direction(event, size)
        self.distances_m = np.arange(_NEAREST_M, _FARTHEST_M[event.event], _STEP_M)
        self.places = np.array([start_x, start_y, key_height_m]) + self.distances_m[:, None] * (along_x, along_y, 0.0)
        self.attitude = Attitude(math.atan2(-along_y, -along_x))

    def probability(self, reaction: Callable[[FloatArray, Attitude], FloatArray]) -> Tuple[FloatArray, FloatArray]:
        """Return distances, and the probability of the reaction at each."""
        return self.distances_m, reaction(self.places, self.attitude)


def expected(event: MeasuredEvent, size: CarSize, model: ReactionModel, key_height_m: float) -> Expected:
    """Return the expected results of one line and event, at the event's own height or else at key_height_m."""
    line = Line(event, size, key_height_m if math.isnan(event.key_height_m) else event.key_height_m)
    if event.event in ("press", "reach"):
        distances_m, p = line.probability(model.press)
        return Expected(falls_below(distances_m, p, 0.5), falls_below(distances_m, p, 0.95))
    if event.event == "handle":
        distances_m, p = line.probability(model.handle)
        at_border = math.nan if math.isnan(event.border_m) else float(np.interp(event.border_m, distances_m, p))
        return Expected(falls_below(distances_m, p, 0.5), falls_below(distances_m, p, 0.95), border_share=at_border)
    if event.event == "unlock":
        distances_m, p = line.probability(model.unlock)
        static_m = falls_below(*line.probability(model.unlock_poll), 0.5)
        return Expected(falls_below(distances_m, p, 0.5), falls_below(distances_m, p, 0.95), static_m)
    # The probability of locking rises with the distance, so its complement falls.
    distances_m, p = line.probability(model.lock)
    _, polled = line.probability(model.lock_poll)
    static_m = falls_below(distances_m, 1.0 - polled, 0.5)
    return Expected(falls_below(distances_m, 1.0 - p, 0.5), falls_below(distances_m, 1.0 - p, 0.05), static_m)
