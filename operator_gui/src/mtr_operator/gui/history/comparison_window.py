"""Two tests beside each other: picture of both, and the difference of each distance with its interval."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtWidgets import QWidget

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.history.line_pairs import Side
from mtr_operator.history.statistics.comparison import MAX_NAMED, Comparison
from mtr_operator.report.protocol_rows import date_text

from ..names import scenario_title
from ..pictures.layers.layer import Layer
from ..pictures.layers.points_layer import PointsLayer
from ..theme.appearance import Appearance
from .comparison_model import ComparisonModel, change_text, row_name, words_text
from .comparison_picture import overlay_layers, points_of, shown_word
from .tests_window import TestsWindow, circumstance_title


class ComparisonWindow(TestsWindow):
    """Attributes: comparison: what is shown. For the others see TestsWindow."""

    def __init__(self, comparison: Comparison, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(comparison.tests.words, appearance, parent)
        self.setWindowTitle(self.tr("Two tests compared"))
        self.comparison = comparison
        self.show_tests(ComparisonModel(comparison, self), self.tr("Differences of distances, sides and areas"),
                        self._summary())

    def layers(self, word: str) -> tuple[Sequence[Layer], PointsLayer]:
        """See TestsWindow."""
        return overlay_layers(self.comparison, word)

    def marked(self, row: int) -> tuple[str, tuple[Point, ...]]:
        """See TestsWindow."""
        found = self.comparison.rows[row]
        return shown_word(self.comparison, found), points_of(self.comparison, found)

    def _summary(self) -> str:
        comparison = self.comparison
        first, second = comparison.tests.sides
        lines = [self.tr("First: {test}").format(test=_name(first)),
                 self.tr("Second: {test}").format(test=_name(second)), self._result()]
        counts = ", ".join(self.tr("{count} {change}").format(count=count, change=change_text(change))
                           for change, count in comparison.counts().items())
        lines.append(self.tr("Distances one by one: {counts}.").format(counts=counts or "0"))
        lines.append(self.tr("Farther or nearer: the whole 95 % interval of the difference is on that side of zero. A "
                             "star marks what also differs among all rows (Holm's correction); without a true "
                             "difference, 95 of 100 comparisons have no star."))
        alone = len(comparison.only_first), len(comparison.only_second)
        if any(alone):
            lines.append(self.tr("Lines of one test only: {first} of the first, {second} of the second.").format(
                first=alone[0], second=alone[1]))
        nothing = "\N{EN DASH}"
        lines += [f"{circumstance_title(row.name)}: {row.first or nothing} / {row.second or nothing}"
                  for row in comparison.differing]
        return "\n".join(lines)

    def _result(self) -> str:
        different = self.comparison.different
        if not different:
            return self.tr("No difference is shown among all rows.")
        names = ", ".join(f"{row_name(self.comparison, row)} {words_text(row)}" for row in different[:MAX_NAMED])
        more = "" if len(different) <= MAX_NAMED else ", \N{HORIZONTAL ELLIPSIS}"
        return self.tr("Different among all rows: {names}.").format(names=names + more)


def _name(side: Side) -> str:
    return f"{scenario_title(side.scenario)}, {date_text(str(side.progress.session.get(STARTED, '')))}"
