"""Summary per side as text."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Sequence

from mtr_operator.domain.verdict.verdict import Verdict

from .figures import TEMPLATES, filled
from .side_summary import SideSummary

HEADINGS = ("side", "lines", "minimum m", "mean m", "maximum m", "worst line", "verdict")
_GAP = "  "
_WORDS = (0, 6)


def side_table(summaries: Sequence[SideSummary], is_judged: bool) -> Iterator[str]:
    """Yield the lines of a table per distance; is_judged: with a column of verdicts."""
    columns = len(HEADINGS) - (not is_judged)
    for word in dict.fromkeys(summary.word for summary in summaries):
        rows = [[f"{word}: side", *HEADINGS[1:]][:columns],
                *(_row(summary)[:columns] for summary in summaries if summary.word == word)]
        widths = [max(len(row[column]) for row in rows) for column in range(columns)]
        for row in rows:
            cells = (cell.ljust(width) if index in _WORDS else cell.rjust(width)
                     for index, (cell, width) in enumerate(zip(row, widths)))
            yield _GAP.join(cells).rstrip()


def _row(summary: SideSummary) -> list[str]:
    figures = [filled(TEMPLATES[figure.kind], figure) for figure in (summary.minimum, summary.mean, summary.maximum)]
    return [summary.side, str(summary.count), *figures, "" if summary.worst_line is None else str(summary.worst_line),
            "" if summary.verdict is Verdict.NOT_SET else summary.verdict.word]
