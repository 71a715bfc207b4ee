"""What a scan of a radial is likely to take: it ends where the first press works."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ...forecast import Forecast
from ..key_press_parameters import KeyPressParameters
from ..key_press_result import KeyPressResult


def scan_forecast(parameters: KeyPressParameters, results: Sequence[KeyPressResult]) -> Forecast:
    """From a Car that obeys at the first place to one that obeys at the last; as the radials so far, if there are some.

    A scan gives no interval.
    """
    places, confirming = len(parameters.press_distances_m), min(parameters.confirming_presses, 1)
    attempts = [result.attempts for result in results if not result.invalid_count]
    few, many = ((min(attempts), max(attempts)) if attempts
                 else (1 + confirming, (places - 1) * parameters.attempts + 1 + confirming))
    return Forecast((few, many), None, (scan_s(parameters, 0), scan_s(parameters, places - 1)))


def scan_s(parameters: KeyPressParameters, failed: int) -> float:
    """Robot time until a press works, after so many places at which none did."""
    way_m = parameters.maximum_distance_m - parameters.press_distances_m[failed]
    press_s = parameters.settle_time_s + parameters.press_duration_s
    waited_s = failed * parameters.attempts * (press_s + parameters.response_timeout_s) + press_s
    return way_m / parameters.maximum_speed_mps + waited_s
