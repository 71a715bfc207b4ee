"""What a zone is likely to take and to tell, and whether the interval wanted of its coverage can be reached at all."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Iterator, Sequence

from ...estimation.field.forecast import SHARP, SOFT, USUAL, zone_forecast
from ...forecast import Forecast
from .parameters import ZoneMapParameters
from .result import ZoneMapResult

_PER_CENT = 100.0
_DECLARED = ZoneMapParameters.declarations()
_MAX_PRESSES, _MAX_PERCENT = int(_DECLARED["presses_limit"].high), _DECLARED["coverage_percent"].high
# Of each way beside its length by the speed: turning, speeding up, slowing down; measured in the demo.
MOVE_S = 3.0


def press_s(parameters: ZoneMapParameters) -> float:
    """Of a press with its way: half of the presses work, and ways are a quarter of the map's depth."""
    way_m = (parameters.maximum_distance_m - parameters.minimum_distance_m) / 4.0
    return (way_m / parameters.maximum_speed_mps + MOVE_S + parameters.settle_time_s + parameters.press_duration_s
            + parameters.response_timeout_s / 2.0)


def forecast_of(parameters: ZoneMapParameters, results: Sequence[ZoneMapResult]) -> Forecast:
    """From a field that ends sharply to a soft one; as the zones so far, if there are some."""
    sharp, soft = (zone_forecast(parameters.coverage_percent / _PER_CENT, parameters.presses_limit, spread)
                   for spread in (SHARP, SOFT))
    presses, halves = (sharp.presses, soft.presses), (sharp.half_width, soft.half_width)
    known = [(result.presses, (result.coverage_high - result.coverage_low) / 2.0) for result in results
             if result.coverage_low is not None and result.coverage_high is not None]
    if known:
        counts, widths = [count for count, _ in known], [half for _, half in known]
        presses, halves = (min(counts), max(counts)), (min(widths), max(widths))
    each_s = press_s(parameters)
    return Forecast(presses, None, (presses[0] * each_s, presses[1] * each_s),
                    (_PER_CENT * halves[0], _PER_CENT * halves[1]))


def cautions_of(parameters: ZoneMapParameters) -> Iterator[str]:
    """A sentence when the interval cannot be reached with the presses allowed, and what would."""
    wanted = parameters.coverage_percent / _PER_CENT
    found = zone_forecast(wanted, parameters.presses_limit, USUAL)
    if found.is_reached:
        return
    enough = zone_forecast(wanted, _MAX_PRESSES, USUAL)
    more = f"allow {enough.presses} presses (presses_limit), or " if enough.is_reached else ""
    percent = min(math.ceil(_PER_CENT * found.half_width), int(_MAX_PERCENT))
    yield (f"{parameters.presses_limit} presses in each zone reach an interval of the coverage of {percent} %; "
           f"coverage_percent asks for {parameters.coverage_percent:g} %: {more}ask for {percent} %.")
