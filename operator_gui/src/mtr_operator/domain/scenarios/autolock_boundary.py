"""The static boundaries of the axes and the Car's reaction time, from the passes of all of them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Iterator, Sequence

from ..estimation.interval import UNKNOWN
from ..estimation.looks import deviate
from ..estimation.passes.boundary import NO_BOUNDARY, Boundary, BoundaryCampaign, Pass
from ..estimation.passes.delay import has_two_speeds
from ..estimation.passes.steps import Steps
from .autolock_parameters import AutolockParameters
from .autolock_result import LOCK, UNLOCK, AutolockResult

# A key that hardly moves reacts where it stands: the speed tells nothing.
_STANDING_MPS = 0.02
_DIGITS = 6


def with_boundaries(results: Sequence[AutolockResult], parameters: AutolockParameters,
                    wanted: Sequence[AutolockResult]) -> list[AutolockResult]:
    """Those wanted with what all results say; without passes at two speeds, or in steps, nothing more."""
    of_words = [_boundaries(results, word, parameters, wanted) for word in (UNLOCK, LOCK)]
    return [replace(result, **unlock, **lock) for result, unlock, lock in zip(wanted, *of_words)]


def _boundaries(results: Sequence[AutolockResult], word: str, parameters: AutolockParameters,
                wanted: Sequence[AutolockResult]) -> Iterator[dict[str, Any]]:
    """Columns of each one wanted."""
    cycle_s = max((each.told_every_s or 0.0 for each in results), default=0.0)
    campaign, tells_reaction = BoundaryCampaign(cycle_s), False
    for each in results:
        passes = list(_passes(each, word, parameters))
        campaign.keep(each.axis, passes)
        tells_reaction = tells_reaction or _tell_reaction(passes)
    for result in wanted:
        sigmas, place_m = deviate(result.looks), _place_sigma(result, word)
        boundary = campaign.boundary(result.axis, sigmas) if tells_reaction else NO_BOUNDARY
        look = boundary.look.widened(place_m, sigmas) if result.looks else UNKNOWN
        yield {f"{word}_passes": len(result.passes(word)),
               **_columns(word, replace(boundary, static=boundary.static.widened(place_m), look=look))}


def _passes(result: AutolockResult, word: str, parameters: AutolockParameters) -> Iterator[Pass]:
    for distance_m, speed_mps in result.passes(word):
        if speed_mps >= _STANDING_MPS:
            yield Pass(distance_m, speed_mps, word == LOCK)
        elif speed_mps == 0.0 and parameters.last_step_m is not None:
            yield Pass(distance_m, 0.0, word == LOCK, Steps(parameters.last_step_m, parameters.response_timeout_s))


def _tell_reaction(passes: Sequence[Pass]) -> bool:
    return any(each.steps for each in passes) or has_two_speeds([each.speed_mps for each in passes])


def _place_sigma(result: AutolockResult, word: str) -> float:
    """1 sigma in m of the first pass that all passes share: its own without the part of the bus' cycle; NaN when it is
    not known."""
    sigma_m, speed_mps = getattr(result, f"{word}_uncertainty_m"), getattr(result, f"{word}_speed_mps")
    if sigma_m is None:
        return math.nan
    told_m = abs(speed_mps or 0.0) * (result.told_every_s or 0.0) / math.sqrt(12.0)
    return math.sqrt(max(sigma_m ** 2 - told_m ** 2, 0.0))


def _columns(word: str, boundary: Boundary) -> dict[str, Any]:
    static, reaction = boundary.static, boundary.reaction_s
    values = {"static_m": static.value_m, "static_low_m": static.low_m, "static_high_m": static.high_m,
              "static_sigma_m": static.sigma_m, "reaction_s": reaction.value_m, "reaction_low_s": reaction.low_m,
              "reaction_high_s": reaction.high_m, "static_common_sigma_m": boundary.common_m,
              "static_shared_sigma_m": static.shared_m, "static_look_low_m": boundary.look.low_m,
              "static_look_high_m": boundary.look.high_m}
    return {f"{word}_{name}": round(value, _DIGITS) if math.isfinite(value) else None
            for name, value in values.items()}
