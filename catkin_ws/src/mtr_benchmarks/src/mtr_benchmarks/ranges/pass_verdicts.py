"""Whole tests of Autolock on Cars whose unlock boundaries are exactly at their limits; see verdicts."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Any, Dict, List, NamedTuple

import numpy as np

from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenarios.autolock import SCENARIO
from mtr_operator.domain.scenarios.autolock_boundary import with_boundaries
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.autolock_result import LOCK, UNLOCK, AutolockResult
from mtr_operator.domain.verdict.judgement import judge
from mtr_operator.domain.verdict.looking import Looking

from .cars import Polling, noticed_at
from .verdicts import Judged, at_truth, judged, measure_further

SPEEDS_MPS = (0.4, 0.13)
PARAMETERS = AutolockParameters(passes=2, measuring_speeds_mps=SPEEDS_MPS)
MAX_PASSES = 16
# Distance of the lock boundary beyond the unlock boundary.
_HYSTERESIS_M = 0.6
_SIGMA_M = 0.002


class AxesLimitDraw(NamedTuple):
    """One test: polling of the Car, number of its axes, seed, and rounds of additional passes that its time allows."""

    polling: Polling
    lines: int
    place: int
    rounds: int = 16


def axes_at_the_limit(draw: AxesLimitDraw) -> List[Judged]:
    """Run all axes of one test, each with its true unlock boundary as limit."""
    noise = np.random.default_rng([draw.place, 2])
    lines = radials_around(2.0 * math.pi / draw.lines)
    truths_m = np.random.default_rng([draw.place, 1]).uniform(1.0, 2.2, len(lines)).tolist()
    limits = at_truth(UNLOCK, [(line.clockwise_deg, truth_m) for line, truth_m in zip(lines, truths_m)])
    results: List[Any] = []
    progress = Progress(SCENARIO.name, {}, results=results)
    for line, truth_m in zip(lines, truths_m):
        result = AutolockResult(
            line.number, "left", 0.0, 0.0, 1.0, 0.0, LineStatus.OK, truth_m, _SIGMA_M, 1.0, LineStatus.OK,
            truth_m + _HYSTERESIS_M, _SIGMA_M, 2.0, "", told_every_s=draw.polling.cycle_s)
        for speed_mps in SPEEDS_MPS:
            result = _with_pass(draw.polling, result, truth_m, speed_mps, noise)
        progress.record(with_boundaries([*results, result], PARAMETERS, [result])[0])

    def further(so_far: Any) -> Any:
        if len(so_far.passes(UNLOCK)) >= MAX_PASSES:
            return None
        result = _with_pass(draw.polling, so_far, truths_m[so_far.number - 1], min(SPEEDS_MPS), noise)
        others = [each for each in results if each.number != so_far.number]
        return with_boundaries([*others, result], PARAMETERS, [result])[0]

    measure_further(progress, Looking(SCENARIO, PARAMETERS, progress, progress.revise, lambda: None),
                    lambda: judge(limits, lines, progress.results), draw.rounds, further)
    for result in SCENARIO.concluded(PARAMETERS, results):
        progress.revise(result)
    judgement = judge(limits, lines, progress.results)
    return [judged(result, truth_m, judgement.of_line(result.number).word, len(result.passes(UNLOCK)))
            for result, truth_m in zip(results, truths_m)]


def _with_pass(polling: Polling, result: AutolockResult, truth_m: float, speed_mps: float,
               noise: np.random.Generator) -> AutolockResult:
    """Return the axis with one additional pass."""
    events_m = {UNLOCK: truth_m - noticed_at(polling, speed_mps, noise),
                LOCK: truth_m + _HYSTERESIS_M + noticed_at(polling, speed_mps, noise)}
    added: Dict[str, Any] = {}
    for word, event_m in events_m.items():
        for name, value in ((f"{word}_pass_distances_m", event_m), (f"{word}_pass_speeds_mps", speed_mps)):
            added[name] = (*getattr(result, name), value)
    return replace(result, **added)
