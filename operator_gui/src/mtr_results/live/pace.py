"""Progress and remaining time of a test, from its journal."""
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
    """Progress of a test.

    Attributes:
        action: last decision for the robot; empty before. line: number of the current line, None between lines.
        heard_s: robot time of that decision, NaN before. line_s: median robot time per line, without breaks between
        runs;
            NaN before the first line ends.
        since_s: robot time of the end of the last line, or of the start of the run.
    """

    action: str = ""
    line: int | None = None
    heard_s: float = math.nan
    line_s: float = math.nan
    since_s: float = math.nan

    def left_s(self, lines: int, now_s: float) -> float | None:
        """Return the remaining time for a number of lines at the median pace; None if unknown. now_s: robot time."""
        if not lines or math.isnan(self.line_s):
            return None
        # An overlong current line does not shorten the estimate of the following lines.
        gone_s = max(0.0, now_s - self.since_s) if now_s >= self.since_s else 0.0
        return max(0.0, self.line_s - gone_s) + (lines - 1) * self.line_s


def course_of(entries: Sequence[Entry]) -> CourseOfTest:
    """Evaluate the journal up to its last entry."""
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
                # The robot was restarted: earlier times belong to another clock.
                took_s, since_s, has_ended = [], at_s, False
            if math.isnan(since_s):
                since_s = at_s
            elif has_ended:
                took_s.append(at_s - since_s)
                since_s, has_ended = at_s, False
            heard_s = at_s
    return CourseOfTest(action, line, heard_s, statistics.median(took_s) if took_s else math.nan, since_s)
