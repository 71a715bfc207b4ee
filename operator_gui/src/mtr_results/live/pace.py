"""How far a test has come and how long it may still take, from what its journal says."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.results.journal import DECISION, FURTHER, LINE, LINE_BEGUN, LINE_RESUMED
from mtr_operator.storage.journal.journal_file import Entry


@dataclass(frozen=True)
class CourseOfTest:
    """Attributes:
        action: what the robot was told to do last; empty before. line: number of the line at hand, None between lines.
        heard_s: robot time of that, NaN before. line_s: robot time that a line took, median: a break between two runs
            is none. NaN before one.
        since_s: robot time at which the last line ended, or the run began.
    """

    action: str = ""
    line: int | None = None
    heard_s: float = math.nan
    line_s: float = math.nan
    since_s: float = math.nan

    def left_s(self, lines: int, now_s: float) -> float | None:
        """For so many lines more, at the pace so far; None when nothing is known. now_s: robot time."""
        if not lines or math.isnan(self.line_s):
            return None
        # A line that takes longer than the others shortens nothing of what comes after it.
        gone_s = max(0.0, now_s - self.since_s) if now_s >= self.since_s else 0.0
        return max(0.0, self.line_s - gone_s) + (lines - 1) * self.line_s


def course_of(entries: Sequence[Entry]) -> CourseOfTest:
    """As far as the journal reaches."""
    action, line, heard_s, since_s = "", None, math.nan, math.nan
    took_s: list[float] = []
    has_ended = False
    for entry in entries:
        if entry.kind in (LINE_BEGUN, LINE_RESUMED, FURTHER):
            line = int(entry.values["line"])
        elif entry.kind == LINE:
            line, has_ended = None, True
        elif entry.kind == DECISION:
            action, at_s = str(entry.values["action"]), float(entry.values["robot_time_s"])
            if at_s < heard_s:
                # Another start of the robot: its clock tells nothing of the times before.
                took_s, since_s, has_ended = [], at_s, False
            if math.isnan(since_s):
                since_s = at_s
            elif has_ended:
                took_s.append(at_s - since_s)
                since_s, has_ended = at_s, False
            heard_s = at_s
    return CourseOfTest(action, line, heard_s, statistics.median(took_s) if took_s else math.nan, since_s)
