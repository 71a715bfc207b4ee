"""Whole tests of Cars exactly at their limits: search, further attempts, last estimate and verdict of every line.

The module combines the parts of the application's runner without a robot. The search selects the places, interim
evaluations ("looks") of a line decide when it is measured further, and all lines together give the last estimate. A Car
at its limit must wrongly pass and wrongly fail in at most 2.5 % of the lines each, and the recorded intervals must
contain the truth.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from typing import Any, Callable, List, NamedTuple, Sequence, Tuple, cast

import numpy as np

from mtr_operator.domain.estimation.press.likelihood import Press
from mtr_operator.domain.estimation.press.plan import SearchPlan
from mtr_operator.domain.estimation.press.radial_estimate import estimate
from mtr_operator.domain.estimation.press.radial_search import RadialSearch
from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Concluding
from mtr_operator.domain.results.line_result import LineResult, LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.scenarios.handle_request.handle_request import SCENARIO as HANDLE_REQUEST
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.domain.scenarios.handle_request.result import HANDLE_WORD, HandleRequestResult
from mtr_operator.domain.scenarios.key_press import SCENARIO as KEY_PRESS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import ADAPTIVE, PRESS, KeyPressResult
from mtr_operator.domain.scenarios.line_search.campaign import LineCampaign, with_estimate
from mtr_operator.domain.scenarios.line_search.result import SearchedResult
from mtr_operator.domain.scenarios.line_search.search import further_plan, share_of_most
from mtr_operator.domain.verdict.judgement import judge
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.looking import Looking
from mtr_operator.domain.verdict.requirement import Requirement

from .cars import HALF_WAVELENGTH_M, Radial, Radio

FURTHER_PRESSES = 8
FAIL_BY_HOLE = "fail_by_hole"
_LIGHT_MPS = 299_792_458.0
# Presses from 3 to 20 m; the radials end at 8 to 14 m.
PARAMETERS = KeyPressParameters(
    minimum_distance_m=3.0, maximum_distance_m=20.5, straightening_distance_m=0.5, interval_m=0.3,
    key_frequency_hz=_LIGHT_MPS / (2.0 * HALF_WAVELENGTH_M))
_SIGMA_M = 0.002


class Search(NamedTuple):
    """Scenario with a search. parameters: include the spacing of lines. empty: a line's result before any attempt.
    scale: ratio of its distances to the distances of Radial."""

    scenario: AnyScenario
    parameters: Any
    empty: Callable[[int, float], Any]
    word: str
    scale: float = 1.0


class LimitDraw(NamedTuple):
    """One test: search, radio of the Car, number of its lines, seed, and rounds of further attempts that its time
    allows."""

    search: str
    radio: Radio
    lines: int
    place: int
    rounds: int = 8


class Judged(NamedTuple):
    """Outcome for one line whose limit is its true distance.

    Attributes:
        verdict: pass, fail or inconclusive; FAIL_BY_HOLE for a fail at holes where a press truly works with less than
            50 %. Such a fail is right although the boundary meets the limit.
        looks: number of interim evaluations of the line.
        holds: whether the recorded 95 % interval contains the truth; None without an interval.
        judged_holds: the same for the interval of the last interim evaluation.
        half_m: half width of the 95 % interval in m.
        presses: number of all presses.
    """

    verdict: str
    looks: int
    holds: Any
    judged_holds: Any
    half_m: float
    presses: int


def at_the_limit(draw: LimitDraw) -> List[Judged]:
    """Run all lines of one test, each with its true distance as limit; "at least" and "at most" alternate."""
    search, place = SEARCHES[draw.search], np.random.default_rng([draw.place, 1])
    lines = radials_around(2.0 * math.pi / draw.lines)
    radials = [_Scaled(Radial(draw.radio, place, np.random.default_rng([draw.place, 2, line.number])), search.scale)
               for line in lines]
    limits = at_truth(search.word, [(line.clockwise_deg, radial.d50_m) for line, radial in zip(lines, radials)])
    progress = Progress(search.scenario.name, {})
    for line, radial in zip(lines, radials):
        empty = search.empty(line.number, line.clockwise_deg)
        progress.record(_searched(search, radial, progress.results, empty, search.parameters.search_plan))
    measure_further(progress, Looking(search.scenario, search.parameters, progress, progress.revise, lambda: None),
                    lambda: judge(limits, lines, progress.results), draw.rounds,
                    lambda so_far: _further(search, radials[so_far.number - 1], progress.results, so_far))
    for result in part(search.scenario, Concluding).concluded(search.parameters, progress.results):
        progress.revise(result)
    judgement, results = judge(limits, lines, progress.results), cast(List[SearchedResult], progress.results)
    return [judged(result, radial.d50_m, verdict_of(judgement.of_line(result.number).word, result, radial),
                   len(result.attempts_made)) for result, radial in zip(results, radials)]


def verdict_of(word: str, result: SearchedResult, radial: Any) -> str:
    """Return FAIL_BY_HOLE if the radial truly works with less than 50 % at all holes of a fail, else the word."""
    holes_m = result.holes_nearer_than(radial.d50_m)
    is_by_hole = word == "fail" and holes_m and all(radial.works(hole_m) < 0.5 for hole_m in holes_m)
    return FAIL_BY_HOLE if is_by_hole else word


class _Scaled:
    """Radial with scaled distances."""

    def __init__(self, radial: Radial, scale: float):
        self._radial = radial
        self._scale = scale
        self.d50_m = scale * radial.d50_m

    def works(self, distance_m: float) -> float:
        """Return the probability that a press works at a distance."""
        return self._radial.works(distance_m / self._scale)

    def press(self, distance_m: float) -> bool:
        """Return True if a press works."""
        return self._radial.press(distance_m / self._scale)


def measure_further(progress: Progress, looking: Looking, judgement: Callable[[], Any], rounds: int,
                    further: Callable[[Any], Any]) -> None:
    """Measure undecided lines in turn, as the application's runner does, until all are decided or the time is over."""
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
    """Return the outcome of a line. index: selects one of its distances."""
    distance = result.distances[index]
    ends = (distance.low_m, distance.high_m)
    return Judged(verdict, len(result.looks), _holds(ends, truth_m), _holds(distance.look_m or ends, truth_m),
                  math.nan if None in ends else (ends[1] - ends[0]) / 2.0, attempts)  # type: ignore[operator]


def _holds(ends: Any, truth_m: float) -> Any:
    if ends == (None, None):
        return None
    return (ends[0] is None or ends[0] <= truth_m) and (ends[1] is None or truth_m <= ends[1])


def at_truth(word: str, truths: Sequence[Tuple[float, float]]) -> Limits:
    """Return limits exactly at the distances of lines, each with its angle; "at least" and "at most" alternate."""
    return Limits(tuple(
        Requirement(f"line {number}", word, truth_m if number % 2 else None, None if number % 2 else truth_m,
                    angles_deg=(angle_deg, angle_deg)) for number, (angle_deg, truth_m) in enumerate(truths, 1)))


def _further(search: Search, radial: _Scaled, results: Sequence[LineResult], so_far: Any) -> Any:
    count, share = len(so_far.attempts_made), share_of_most(search.parameters, so_far)
    if share is None or share >= 1.0:
        return None
    plan = replace(further_plan(search.parameters.search_plan, so_far),
                   attempts_limit=min(count + FURTHER_PRESSES, round(count / share)))
    return _searched(search, radial, results, replace(so_far, wanted_interval_m=plan.interval_m), plan)


def _searched(wanted: Search, radial: _Scaled, results: Sequence[Any], result: Any, plan: SearchPlan) -> Any:
    campaign = LineCampaign(wanted.parameters.search_plan)
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


def _empty_radial(number: int, angle_deg: float) -> KeyPressResult:
    return KeyPressResult(number, angle_deg, LineStatus.INVALID, None, None, None, 0, None, "", method=ADAPTIVE,
                          place_sigma_m=_SIGMA_M)


def _empty_axis(number: int, _: float) -> HandleRequestResult:
    return HandleRequestResult(number, "left", 1.0, LineStatus.INVALID, 0, 0, 0, place_sigma_m=_SIGMA_M)


# A handle's zone ends at 1.6 to 2.8 m; the half wavelength of its fading is scaled likewise, as the parameters state.
_HANDLE_SCALE = 0.2
_HANDLE = HandleRequestParameters(border_requests=0, half_wavelength_m=_HANDLE_SCALE * HALF_WAVELENGTH_M)
SEARCHES = {"key_press": Search(KEY_PRESS, PARAMETERS, _empty_radial, PRESS),
            "handle_request": Search(HANDLE_REQUEST, _HANDLE, _empty_axis, HANDLE_WORD, _HANDLE_SCALE)}
