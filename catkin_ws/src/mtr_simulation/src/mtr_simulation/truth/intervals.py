"""Intervals of results.csv compared with the truth: static boundary, distances at 50 and 95 %."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import statistics
from typing import Dict, Iterable, List, NamedTuple, Tuple

from .distance import Comparison
from .results import FIRST_COLUMN, optional_number, rows_of

_METRES, _PART = "m", ""


def _distance(name: str) -> Tuple[str, str, str]:
    return f"{name}_m", f"{name}_low_m", f"{name}_high_m"


# By scenario and event: name of the figure, its columns (value, low and high end), its truth in Expected, and unit.
_TOLD = {
    "autolock": (("unlock", "static", _distance("unlock_static"), "static_m", _METRES),
                 ("lock", "static", _distance("lock_static"), "static_m", _METRES)),
    "key_press": (("press", "50 %", _distance("d50"), "p50_distance_m", _METRES),
                  ("press", "95 %", _distance("d95"), "p95_distance_m", _METRES)),
    "handle_request": (("handle", "50 %", _distance("d50"), "p50_distance_m", _METRES),
                       ("handle", "95 %", _distance("d95"), "p95_distance_m", _METRES)),
    "zone_map": (("reach", "50 %", ("distance_m", "low_m", "high_m"), "p50_distance_m", _METRES),
                 ("reach", "area", ("coverage", "coverage_low", "coverage_high"), "coverage", _PART)),
}


class Told(NamedTuple):
    """Figure of a line with its 95 % interval and its truth; a missing end is infinite.

    unit: m for a distance, empty for a part of an area.
    """

    line: str
    event: str
    what: str
    value: float
    low: float
    high: float
    true: float
    unit: str = _METRES

    @property
    def holds(self) -> bool:
        """True if the interval contains the truth."""
        return self.low <= self.true <= self.high


def read_intervals(path: pathlib.Path, scenario: str, comparisons: Iterable[Comparison]) -> List[Told]:
    """Return the intervals of all lines with a known truth; empty if the file has no such columns."""
    expected = {(each.measured.line, each.measured.event): each.expected for each in comparisons}
    told = []
    for row in rows_of(path):
        line = row[FIRST_COLUMN[scenario]]
        for event, what, columns, name, unit in _TOLD[scenario]:
            value, low, high = (optional_number(row, column, path) for column in columns)
            true = getattr(expected.get((line, event)), name, math.nan)
            if math.isfinite(true) and (math.isfinite(low) or math.isfinite(high)):
                told.append(Told(line, event, what, value, -math.inf if math.isnan(low) else low,
                                 math.inf if math.isnan(high) else high, true, unit))
    return told


def interval_table(told: List[Told]) -> List[str]:
    """Return a line for each interval, distances first."""
    return [line for unit in (_METRES, _PART) for line in _table([each for each in told if each.unit == unit], unit)]


def _table(told: List[Told], unit: str) -> List[str]:
    if not told:
        return []
    lines = ["line event  what     found m  95 % interval m     true m" if unit else
             "line event  what       found  95 % interval         true"]
    for each in told:
        ends = f"{each.low:.3f} to {each.high:.3f}"
        lines.append(f"{each.line:>4} {each.event:6} {each.what:6} {each.value:9.3f}  {ends:18} {each.true:7.3f} "
                     f"{'' if each.holds else ' missed'}".rstrip())
    return lines


def coverage(scenario: str, told: List[Told]) -> List[str]:
    """Return the share of the intervals that contain the truth, by event and figure."""
    groups: Dict[Tuple[str, str], List[Told]] = {}
    for each in told:
        groups.setdefault((each.event, each.what), []).append(each)
    return [_sentence(scenario, event, what, group) for (event, what), group in groups.items()]


def _sentence(scenario: str, event: str, what: str, group: List[Told]) -> str:
    held = sum(each.holds for each in group)
    share = f"{held} of {len(group)} intervals hold the truth ({100 * held // len(group)} %)"
    text = f"{scenario}: {event}, {what}: {share}"
    errors = [each.value - each.true for each in group if math.isfinite(each.value)]
    halves = [(each.high - each.low) / 2.0 for each in group if math.isfinite(each.high - each.low)]
    unit = f" {group[0].unit}".rstrip()
    if errors:
        text += f"; error rms {math.sqrt(statistics.fmean(error * error for error in errors)):.3f}{unit}"
    if halves:
        text += f", half width median {statistics.median(halves):.3f}{unit}"
    return f"{text}."
