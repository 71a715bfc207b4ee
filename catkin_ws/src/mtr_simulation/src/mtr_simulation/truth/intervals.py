"""Intervals of results.csv beside the truth that they have to hold: static boundary, distances at 50 and 95 %."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import statistics
from typing import Dict, Iterable, List, NamedTuple, Tuple

from .distance import Comparison
from .results import optional_number, rows_of

# Of each scenario and event: what is told, the beginning of its columns, and its truth in Expected.
_TOLD = {
    "autolock": (("unlock", "static", "unlock_static", "static_m"), ("lock", "static", "lock_static", "static_m")),
    "key_press": (("press", "50 %", "d50", "p50_distance_m"), ("press", "95 %", "d95", "p95_distance_m")),
}
_FIRST_COLUMN = {"autolock": "axis", "key_press": "radial"}


class Told(NamedTuple):
    """A distance of a line with its 95 % interval and its truth, in m; an end is infinite where the line has none."""

    line: str
    event: str
    what: str
    value_m: float
    low_m: float
    high_m: float
    true_m: float

    @property
    def holds(self) -> bool:
        """The truth lies within."""
        return self.low_m <= self.true_m <= self.high_m


def read_intervals(path: pathlib.Path, scenario: str, comparisons: Iterable[Comparison]) -> List[Told]:
    """Intervals of all lines whose truth is known; none of a file that has no such columns."""
    expected = {(each.measured.line, each.measured.event): each.expected for each in comparisons}
    told = []
    for row in rows_of(path):
        line = row[_FIRST_COLUMN[scenario]]
        for event, what, prefix, truth in _TOLD[scenario]:
            value_m, low_m, high_m = (optional_number(row, f"{prefix}{end}_m", path) for end in ("", "_low", "_high"))
            true_m = getattr(expected.get((line, event)), truth, math.nan)
            if math.isfinite(true_m) and (math.isfinite(low_m) or math.isfinite(high_m)):
                told.append(Told(line, event, what, value_m, -math.inf if math.isnan(low_m) else low_m,
                                 math.inf if math.isnan(high_m) else high_m, true_m))
    return told


def interval_table(told: List[Told]) -> List[str]:
    """A line of each interval."""
    if not told:
        return []
    lines = ["line event  what     found m  95 % interval m     true m"]
    for each in told:
        ends = f"{each.low_m:.3f} to {each.high_m:.3f}"
        lines.append(f"{each.line:>4} {each.event:6} {each.what:6} {each.value_m:9.3f}  {ends:18} {each.true_m:7.3f} "
                     f"{'' if each.holds else ' missed'}".rstrip())
    return lines


def coverage(scenario: str, told: List[Told]) -> List[str]:
    """Share of the intervals that hold the truth, by event and what they tell."""
    groups: Dict[Tuple[str, str], List[Told]] = {}
    for each in told:
        groups.setdefault((each.event, each.what), []).append(each)
    return [_sentence(scenario, event, what, group) for (event, what), group in groups.items()]


def _sentence(scenario: str, event: str, what: str, group: List[Told]) -> str:
    held = sum(each.holds for each in group)
    share = f"{held} of {len(group)} intervals hold the truth ({100 * held // len(group)} %)"
    text = f"{scenario}: {event}, {what}: {share}"
    errors = [each.value_m - each.true_m for each in group if math.isfinite(each.value_m)]
    halves = [(each.high_m - each.low_m) / 2.0 for each in group if math.isfinite(each.high_m - each.low_m)]
    if errors:
        text += f"; error rms {math.sqrt(statistics.fmean(error * error for error in errors)):.3f} m"
    if halves:
        text += f", half width median {statistics.median(halves):.3f} m"
    return f"{text}."
