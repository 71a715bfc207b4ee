"""Recomputes the results of all lines from their recomputed measurements."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import itertools
from typing import Any, Iterator, Sequence, TypeVar

from mtr_operator.domain.actions.distance import recorded_values
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Concluding
from mtr_operator.domain.results.carried import UNKNOWN_CAUSE, carried_values
from mtr_operator.domain.results.line_result import LineResult, LineStatus, result_from_document
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.scenarios.autolock_result import LOCK, UNLOCK, AutolockResult
from mtr_operator.domain.scenarios.key_press_result import CONFIRMING, KeyPressResult
from mtr_operator.domain.scenarios.line_search.result import SearchedResult
from mtr_operator.domain.scenarios.relay_resistance.result import RelayResistanceResult
from mtr_operator.domain.scenarios.sleep_time.result import SleepTimeResult, rest_columns
from mtr_operator.domain.scenarios.sleep_time.still_trial import trials_of
from mtr_operator.domain.scenarios.sleep_time.waits import Rests

from .points import Attempt, Point
from .relayed import relayed

Result = TypeVar("Result", bound=LineResult)
# Positions are recorded in whole micrometres.
_DIGITS = 6
_SAME_M = 2e-6


def results_anew(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress,
                 attempts: Sequence[Attempt]) -> tuple[list[LineResult], list[LineResult]]:
    """Return the recorded and the recomputed results; both with the values that all lines have in common."""
    counted = counted_attempts(scenario, attempts)
    new = [anew(result, counted[result.number]) if result.number in counted else result
           for result in progress.results]
    return _concluded(scenario, parameters, progress.results), _concluded(scenario, parameters, new)


def counted_attempts(scenario: AnyScenario, attempts: Sequence[Attempt]) -> dict[int, Attempt]:
    """Return the attempt of each line whose result is in the record: a later one, unless it was worse."""
    counted: dict[int, tuple[Attempt, int]] = {}
    for attempt in attempts:
        if not attempt.values:
            continue
        invalid = result_from_document(scenario.result_type, attempt.values).invalid_count
        former = counted.get(attempt.number)
        if former is None or former[1] >= invalid:
            counted[attempt.number] = attempt, invalid
    return {number: attempt for number, (attempt, _) in counted.items()}


def anew(result: LineResult, attempt: Attempt) -> LineResult:
    """Recompute one line. An invalid line stays invalid, for a recorded reason. An exception is a place where only the
    phone's distance was wrong, because that comes from the bus, too."""
    if attempt.place is not None or result.invalid_count or not attempt.points:
        return attempt.place or result
    if isinstance(result, AutolockResult):
        return dataclasses.replace(result, **_autolock(result, attempt.points))
    if isinstance(result, KeyPressResult) and not result.was_searched:
        return dataclasses.replace(result, **_scan(attempt.points))
    if isinstance(result, SearchedResult):
        # The derived classes are dataclasses.
        return dataclasses.replace(result, **_searched(result, attempt.points))  # type: ignore[type-var]
    if isinstance(result, (SleepTimeResult, RelayResistanceResult)):
        columns = _slept if isinstance(result, SleepTimeResult) else relayed
        return dataclasses.replace(result, **columns(attempt.points))
    return result


def _concluded(scenario: AnyScenario, parameters: ScenarioParameters,
               results: Sequence[LineResult]) -> list[LineResult]:
    revised = {result.number: result for result in part(scenario, Concluding).concluded(parameters, results)}
    return [revised.get(result.number, result) for result in results]


def _autolock(result: AutolockResult, points: Sequence[Point]) -> dict[str, Any]:
    columns: dict[str, Any] = {}
    for word in (UNLOCK, LOCK):
        first = next((point for point in reversed(points) if point.word == word), None)
        if first is None:
            continue
        columns[f"{word}_status"] = first.new_status
        columns.update(_distance(f"{word}_", first))
        passes = list(_passes(result, word, points))
        columns[f"{word}_pass_distances_m"] = tuple(distance_m for distance_m, _ in passes)
        columns[f"{word}_pass_speeds_mps"] = tuple(speed_mps for _, speed_mps in passes)
    doubts = [point.doubt for point in points if point.doubt]
    return {**columns, "reason": doubts[0] if _is_invalid(columns.values()) and doubts else result.reason}


def _is_invalid(values: Any) -> bool:
    return any(value is LineStatus.INVALID for value in values)


def _distance(prefix: str, point: Point) -> dict[str, Any]:
    is_known = point.new_status is LineStatus.OK
    known = point.new_distance if is_known else None
    distance_m, uncertainty_m, robot_time_s = recorded_values(known)
    emptied: dict[str, Any] = {f"{prefix}{name}": None for name in (
        "lateral_offset_m", "heading_offset_deg", "key_height_m", "speed_mps")}
    emptied.update({f"{prefix}cause": "", f"{prefix}key_number": None, f"{prefix}doors": ""})
    return {**emptied, f"{prefix}distance_m": distance_m, f"{prefix}uncertainty_m": uncertainty_m,
            f"{prefix}robot_time_s": robot_time_s, **carried_values(prefix, known)}


def _passes(result: AutolockResult, word: str, points: Sequence[Point]) -> Iterator[tuple[float, float]]:
    """Yield the passes; a pass in steps keeps its speed of 0."""
    for distance_m, speed_mps in result.passes(word):
        point = _kept_at(distance_m, [each for each in points if each.word.partition(" ")[0] == word])
        if point is None or point.new_distance is None or point.new_status is not LineStatus.OK:
            continue
        yield round(point.new_distance.distance_m, _DIGITS), speed_mps


def _kept_at(distance_m: float, points: Sequence[Point]) -> Point | None:
    return next((point for point in points if point.distance is not None
                 and abs(point.distance.distance_m - distance_m) <= _SAME_M), None)


def _scan(points: Sequence[Point]) -> dict[str, Any]:
    """Return the columns of a scan, which ends at the first successful press whose repetition, if any, succeeds as
    well."""
    worked = next((point for index, point in enumerate(points) if _works(points, index)), None)
    doubts = [point.doubt for point in points if point.doubt]
    if worked is None:
        return {"status": LineStatus.INVALID if doubts else LineStatus.NOT_REACHED,
                "reason": doubts[0] if doubts else "", **_distance("", points[-1])}
    cause = "" if worked.distance is None else worked.distance.source
    return {"status": LineStatus.OK, **_distance("", worked), "cause": cause or UNKNOWN_CAUSE}


def _slept(points: Sequence[Point]) -> dict[str, Any]:
    """Return the columns of a sleep test: the rest times are as recorded, the key's answers are from the bus."""
    return rest_columns(Rests(trials_of({point.word: (point.new_status is LineStatus.OK, point.distance.rest_s)
                                         for point in points if point.distance is not None})))


def _works(points: Sequence[Point], index: int) -> bool:
    if points[index].word == CONFIRMING or points[index].new_status is not LineStatus.OK:
        return False
    repeated = list(itertools.takewhile(lambda point: point.word == CONFIRMING, points[index + 1:]))
    return not repeated or any(point.new_status is LineStatus.OK for point in repeated)


def _searched(result: SearchedResult, points: Sequence[Point]) -> dict[str, Any]:
    """Sort each counted position by its recomputed outcome."""
    worked: list[float] = []
    failed: list[float] = []
    left = list(points)
    kept = [*((place_m, worked) for place_m in result.worked_at_m),
            *((place_m, failed) for place_m in result.failed_at_m)]
    for place_m, places in kept:
        point = _kept_at(place_m, left)
        if point is None:
            places.append(place_m)
            continue
        left.remove(point)
        now_m = place_m if point.new_distance is None else round(point.new_distance.distance_m, _DIGITS)
        (worked if point.new_status is LineStatus.OK else failed).append(now_m)
    return {"worked_at_m": tuple(worked), "failed_at_m": tuple(failed)}
