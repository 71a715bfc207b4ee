"""Heights of the Remote key at which a scenario measures."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..errors import InvalidParameter

# Lowest height at which a scenario measures; the mast is stowed there.
LOWEST_KEY_M = 0.35


def heights_between(lowest_m: float, highest_m: float, count: int) -> list[float]:
    """Return evenly spaced heights from low to high; a single one is the lowest."""
    if count == 1:
        return [lowest_m]
    step_m = (highest_m - lowest_m) / (count - 1)
    return [lowest_m + index * step_m for index in range(count)]


def check_heights(lowest_m: float, highest_m: float, count: int) -> None:
    """Raise InvalidParameter for several heights without a valid range."""
    if count > 1 and highest_m <= lowest_m:
        raise InvalidParameter(f"Parameter highest_key_height_m is {highest_m:g} m; it has to be above key_height_m, "
                               f"{lowest_m:g} m.")
