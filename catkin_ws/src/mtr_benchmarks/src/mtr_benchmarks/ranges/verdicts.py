"""Whole tests of Cars exactly at their limits: search, further attempts, last estimate and verdict of every line.

What the application's runner does is done here with its own parts, without robot: the search chooses the places, the
looks at a line decide when it is measured further, and all lines together give the last estimate. A Car at its limit
passes and fails wrongly in at most 2.5 % of the lines each, and the recorded intervals hold the truth.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Any, Callable, List, NamedTuple, Sequence

import numpy as np

from mtr_operator.domain.estimation.press.likelihood import Press
from mtr_operator.domain.estimation.press.plan import SearchPlan
from mtr_operator.domain.estimation.press.radial_estimate import estimate
from mtr_operator.domain.estimation.press.radial_search import RadialSearch
from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.results.line_result import LineResult, LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenarios.key_press import SCENARIO as KEY_PRESS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import ADAPTIVE, PRESS, KeyPressResult
from mtr_operator.domain.scenarios.line_search.campaign import LineCampaign, with_estimate
from mtr_operator.domain.scenarios.line_search.search import further_plan, share_of_most
from mtr_operator.domain.verdict.judgement import judge
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.looking import Looking
from mtr_operator.domain.verdict.requirement import Requirement

from .cars import HALF_WAVELENGTH_M, Radial, Radio

FURTHER_PRESSES = 8
_LIGHT_MPS = 299_792_458.0
# Presses from 3 to 20 m, where the radials' ends lie at 8 to 14 m.
PARAMETERS = KeyPressParameters(
    minimum_distance_m=3.0, maximum_distance_m=20.5, straightening_distance_m=0.5, interval_m=0.3,
    key_frequency_hz=_LIGHT_MPS / (2.0 * HALF_WAVELENGTH_M))
_SIGMA_M = 0.002


class LimitDraw(NamedTuple):
    """One test: radio of the Car, number of its lines, seed, and rounds of further attempts that its time allows."""

    radio: Radio
    lines: int
    seed: int
    rounds: int = 8


class Judged(NamedTuple):
    """Of one line at its limit.

    Attributes:
        verdict: its word. looks: at the line. holds: the recorded 95 % interval holds the truth; None without one.
        judged_holds: the interval by which the last look judges does. half_m: of the 95 % interval. presses: in all.
    """

    verdict: str
    looks: int
    holds: Any
    judged_holds: Any
    half_m: float
    presses: int


def at_the_limit(draw: LimitDraw) -> List[Judged]:
    """All lines of one test of Key press, each with its true distance as limit, "at least" and "at most" by turns."""
    place = np.random.default_rng([draw.seed, 1])
    radials = [Radial(draw.radio, place, np.random.default_rng([draw.seed, 2, number]))
               for number in range(draw.lines)]
    lines = radials_around(2.0 * math.pi / draw.lines)
    limits = Limits(tuple(_limit(number, line.clockwise_deg, radial.d50_m)
                          for number, (line, radial) in enumerate(zip(lines, radials))))
    parameters = replace(PARAMETERS, angle_between_radials_rad=2.0 * math.pi / draw.lines)
    progress = Progress(KEY_PRESS.name, parameters.to_mapping())
    for line, radial in zip(lines, radials):
        progress.record(_measured(parameters, radial, progress.results, _empty(line.number, line.clockwise_deg)))
    measure_further(progress, Looking(KEY_PRESS, parameters, progress, progress.revise, lambda: None),
                    lambda: judge(limits, lines, progress.results), draw.rounds,
                    lambda so_far: _further(parameters, radials[so_far.number - 1], progress.results, so_far))
    for result in KEY_PRESS.concluded(parameters, progress.results):
        progress.revise(result)
    judgement = judge(limits, lines, progress.results)
    return [judged(result, radial.d50_m, judgement.of_line(result.number).word,
                   len(result.worked_at_m) + len(result.failed_at_m))
            for result, radial in zip(progress.results, radials)]


def measure_further(progress: Progress, looking: Looking, judgement: Callable[[], Any], rounds: int,
                    further: Callable[[Any], Any]) -> None:
    """As the application's runner: each undecided line has its turn, until they are decided or the time is over."""
    looking.look_first(judgement().decided())
    waiting = progress.measured()
    for _ in range(rounds * len(waiting)):
        undecided = judgement().undecided()
        number = next((number for number in waiting if number in undecided), None)
        if number is None:
            break
        waiting.remove(number)
        so_far = next(result for result in progress.results if result.number == number)
        result = further(so_far)
        if result is not None:
            progress.record(looking.next(so_far, result))
            waiting.append(number)
    looking.look_last()


def judged(result: LineResult, truth_m: float, verdict: str, attempts: int, index: int = 0) -> Judged:
    """What became of a line; index: of its distances."""
    distance = result.distances[index]
    ends = (distance.low_m, distance.high_m)
    return Judged(verdict, len(result.looks), _holds(ends, truth_m), _holds(distance.look_m or ends, truth_m),
                  math.nan if None in ends else (ends[1] - ends[0]) / 2.0, attempts)  # type: ignore[operator]


def _holds(ends: Any, truth_m: float) -> Any:
    if ends == (None, None):
        return None
    return (ends[0] is None or ends[0] <= truth_m) and (ends[1] is None or truth_m <= ends[1])


def _limit(number: int, angle_deg: float, truth_m: float) -> Requirement:
    is_at_least = number % 2 == 0
    return Requirement(f"line {number + 1}", PRESS, truth_m if is_at_least else None, None if is_at_least else truth_m,
                       angles_deg=(angle_deg, angle_deg))


def _empty(number: int, angle_deg: float) -> KeyPressResult:
    return KeyPressResult(number, angle_deg, LineStatus.INVALID, None, None, None, 0, None, "", method=ADAPTIVE,
                          place_sigma_m=_SIGMA_M)


def _measured(parameters: KeyPressParameters, radial: Radial, results: Sequence[LineResult],
              result: KeyPressResult) -> KeyPressResult:
    return _searched(parameters, radial, results, result, parameters.search_plan)


def _further(parameters: KeyPressParameters, radial: Radial, results: Sequence[LineResult],
             so_far: KeyPressResult) -> Any:
    count, share = len(so_far.attempts_made), share_of_most(parameters, so_far)
    if share is None or share >= 1.0:
        return None
    most = round(count / share)
    plan = replace(further_plan(parameters.search_plan, so_far), attempts_limit=min(count + FURTHER_PRESSES, most))
    return _searched(parameters, radial, results, replace(so_far, wanted_interval_m=plan.interval_m), plan)


def _searched(parameters: KeyPressParameters, radial: Radial, results: Sequence[Any], result: KeyPressResult,
              plan: SearchPlan) -> KeyPressResult:
    campaign = LineCampaign(parameters.search_plan)
    for _ in campaign.recall([other for other in results if other.number != result.number]):
        pass
    search: RadialSearch = campaign.search(result.number, plan)
    search.recall(result.attempts_made)
    while not search.is_finished():
        place_m = search.next_place_m()
        search.add(Press(place_m, radial.press(place_m)))
    found = replace(result, worked_at_m=tuple(press.distance_m for press in search.presses if press.worked),
                    failed_at_m=tuple(press.distance_m for press in search.presses if not press.worked))
    return with_estimate(plan, found, estimate(plan, search))
