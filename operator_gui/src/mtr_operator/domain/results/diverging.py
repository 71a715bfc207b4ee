"""Colours of errors: one for too near, one for too far, and paler the smaller an error is."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence, Tuple

Colour = Tuple[int, int, int]
# Ends that colour-blind readers tell apart (Okabe and Ito), and a middle that is neither.
_NEGATIVE, _MIDDLE, _POSITIVE = (0, 114, 178), (245, 245, 245), (213, 94, 0)
_STEPS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0)
_FINEST_M = 0.01


def scale_of(errors_m: Sequence[float]) -> float:
    """Error with the full colour, in m: a round number that none exceeds."""
    largest_m = max((abs(error_m) for error_m in errors_m), default=0.0)
    if largest_m <= _FINEST_M:
        return _FINEST_M
    decade = 10.0 ** math.floor(math.log10(largest_m))
    steps_m = [step * decade for step in (*_STEPS, 10.0)]
    return next(step_m for step_m in steps_m if step_m >= largest_m * (1.0 - 1e-9))


def colour_of_error(error_m: float, scale_m: float) -> Colour:
    """Red, green and blue from 0 to 255."""
    part = min(max(error_m / scale_m, -1.0), 1.0)
    end = _POSITIVE if part > 0.0 else _NEGATIVE
    red, green, blue = (round(middle + abs(part) * (full - middle)) for middle, full in zip(_MIDDLE, end))
    return red, green, blue
