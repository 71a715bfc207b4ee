"""Reports intervals that became wider in the last estimate, which uses all lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Sequence

from ..results.line_result import LineResult, MeasuredDistance

# Ratio to the previous interval: data of other lines changes each interval slightly, in both directions.
_WIDER = 1.25


def widened_text(line_word: str, before: Sequence[LineResult], after: Sequence[LineResult]) -> str:
    """Return a sentence on lines whose 95 % interval became clearly wider; empty without any."""
    former = {result.number: result for result in before}
    found = [text for result in after if result.number in former for text in _widened(former[result.number], result)]
    if not found:
        return ""
    return f"The last estimate, with all lines, has wider 95 % intervals: {line_word} {', '.join(found)}."


def _widened(before: LineResult, after: LineResult) -> Iterator[str]:
    for old, new in zip(before.distances, after.distances):
        half_m, new_m = _half_width(old), _half_width(new)
        if half_m is None:
            continue
        where = f"{after.number} {new.word}" if len(after.distances) > 1 else f"{after.number}"
        if new_m is None:
            yield f"{where} from \N{PLUS-MINUS SIGN}{half_m:.2f} m to an open one"
        elif new_m > _WIDER * half_m:
            yield f"{where} from \N{PLUS-MINUS SIGN}{half_m:.2f} to \N{PLUS-MINUS SIGN}{new_m:.2f} m"


def _half_width(distance: MeasuredDistance) -> float | None:
    return None if distance.low_m is None or distance.high_m is None else (distance.high_m - distance.low_m) / 2.0
