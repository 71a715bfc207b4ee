"""Points of all attempts, from the journal or from the results of the lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Iterator, Sequence

from mtr_operator.domain.results.journal import BEGUN, FURTHER, LINE, LINE_BEGUN, LINE_RESUMED, POINT, REVISED
from mtr_operator.domain.results.line_result import LineResult, LineStatus, result_from_document
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.domain.scenarios.line_search.result import SearchedResult
from mtr_operator.domain.scenarios.zone_map.result import ZoneMapResult
from mtr_operator.storage.journal.journal_file import Entry

Row = dict[str, Any]
NOTHING: Row = {"attempt": 1, "distance_m": None, "sigma_m": None, "x_m": None, "y_m": None, "height_m": None,
                "speed_mps": None, "robot_time_s": None, "cause": ""}
WORKED, FAILED = LineStatus.OK.value, LineStatus.NOT_REACHED.value
# Field in the journal -> column.
_FIELDS = {"distance_m": "distance_m", "uncertainty_m": "sigma_m", "key_height_m": "height_m",
           "speed_mps": "speed_mps", "robot_time_s": "robot_time_s"}


def trials_of(entries: Sequence[Entry], results: Sequence[LineResult]) -> list[Row]:
    """Return the trials of all lines, numbered per line; a line without points in the journal uses its result."""
    found = _journalled(entries, results)
    for result in results:
        if result.number not in found:
            found[result.number] = [{**NOTHING, **row} for row in recorded(result)]
    return [{"line": line, "number": number, **row} for line, rows in found.items()
            for number, row in enumerate(rows, start=1)]


def revisions_of(entries: Sequence[Entry]) -> Iterator[Any]:
    """Yield the documents of all line results in order, including the initial ones of the journal or of a part."""
    told: list[Any] = []
    for entry in entries:
        if entry.kind in (LINE, REVISED):
            told.append(entry.values["result"])
            yield told[-1]
        elif entry.kind == BEGUN:
            before = [document for document in entry.values["progress"]["results"] if document not in told]
            told += before
            yield from before


def _journalled(entries: Sequence[Entry], results: Sequence[LineResult]) -> dict[int, list[Row]]:
    found: dict[int, list[Row]] = {}
    begun: dict[int, int] = {}
    line = None
    for entry in entries:
        if entry.kind == BEGUN:
            for result in _begun_with(entry, results):
                # Results from before the journal count as one attempt, with the points that they contain.
                if result.number not in found:
                    found[result.number] = [{**NOTHING, **row} for row in recorded(result)]
                    begun[result.number] = 1
        elif entry.kind in (LINE_BEGUN, LINE_RESUMED, FURTHER):
            line = int(entry.values["line"])
            # Resumed and additional measurements belong to the attempt that they continue.
            begun[line] = begun.get(line, 0) + 1 if entry.kind == LINE_BEGUN else begun.get(line, 1)
        elif entry.kind == POINT and line is not None:
            found.setdefault(line, []).append({**_point(entry), "attempt": begun[line]})
    return found


def _begun_with(entry: Entry, results: Sequence[LineResult]) -> Iterator[LineResult]:
    documents = entry.values["progress"]["results"]
    yield from (result_from_document(type(results[0]), document) for document in documents if results)


def _point(entry: Entry) -> Row:
    distance = entry.values["distance"] or {}
    return {**NOTHING, "word": str(entry.values["word"]), "status": str(entry.values["status"]),
            **{column: distance.get(name) for name, column in _FIELDS.items()}, "cause": distance.get("source") or ""}


def recorded(result: LineResult) -> Iterator[Row]:
    """Yield the points that a result contains; points with a reaction come first."""
    word = result.distances[0].word
    if isinstance(result, ZoneMapResult):
        for status, places in ((WORKED, result.worked), (FAILED, result.failed)):
            yield from ({"word": word, "status": status, "x_m": x, "y_m": y} for x, y in places)
    elif isinstance(result, AutolockResult):
        yield from _passes(result)
    elif isinstance(result, SearchedResult) and result.was_searched:
        for status, places_m in ((WORKED, result.worked_at_m), (FAILED, result.failed_at_m)):
            yield from ({"word": word, "status": status, "distance_m": place_m} for place_m in places_m)
    else:
        distance = result.distances[0]
        yield from ({"word": word, "status": status, "distance_m": place_m}
                    for status, place_m in ((WORKED, distance.distance_m), (FAILED, distance.failed_m))
                    if place_m is not None)


def _passes(result: AutolockResult) -> Iterator[Row]:
    for distance in result.distances:
        passes = result.passes(distance.word)
        yield from ({"word": distance.word, "status": WORKED, "distance_m": distance_m, "speed_mps": speed_mps}
                    for distance_m, speed_mps in passes)
        if not passes and distance.distance_m is not None:
            yield {"word": distance.word, "status": WORKED, "distance_m": distance.distance_m}
