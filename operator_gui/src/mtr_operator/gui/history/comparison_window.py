"""Two tests beside each other: picture of both, and the difference of each distance with its interval."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtWidgets import QWidget

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.history.circumstances import circumstances
from mtr_operator.history.comparison import Comparison
from mtr_operator.history.line_pairs import Side
from mtr_operator.report.protocol_rows import date_text

from ..i18n import number
from ..names import scenario_title
from ..pictures.layers.layer import Layer
from ..pictures.layers.points_layer import PointsLayer
from ..theme.appearance import Appearance
from .comparison_model import ComparisonModel, change_text
from .comparison_picture import overlay_layers
from .tests_window import TestsWindow, circumstance_title


class ComparisonWindow(TestsWindow):
    """Attributes: comparison: what is shown. For the others see TestsWindow."""

    def __init__(self, comparison: Comparison, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(comparison.first.scenario.distance_words, appearance, parent)
        self.setWindowTitle(self.tr("Two tests compared"))
        self.comparison = comparison
        self.show_tests(ComparisonModel(comparison, self), self.tr("Difference of each distance"), self._summary())

    def layers(self, word: str) -> tuple[Sequence[Layer], PointsLayer]:
        """See TestsWindow."""
        return overlay_layers(self.comparison, word)

    def marked(self, row: int) -> tuple[str, tuple[Point, ...]]:
        """See TestsWindow."""
        difference = self.comparison.differences[row]
        index = self.comparison.first.scenario.distance_words.index(difference.word)
        pair = difference.pair
        distances = (result.distances[index].distance_m for result in (pair.first, pair.second))
        return difference.word, tuple(pair.ray.point(distance) for distance in distances if distance is not None)

    def _summary(self) -> str:
        comparison = self.comparison
        lines = [self.tr("First: {test}").format(test=_name(comparison.first)),
                 self.tr("Second: {test}").format(test=_name(comparison.second))]
        counts = ", ".join(self.tr("{count} {change}").format(count=count, change=change_text(change))
                           for change, count in comparison.counts().items())
        lines.append(self.tr("{counts}. By chance alone about {expected} would differ.").format(
            counts=counts or "0", expected=number(comparison.expected_by_chance, 1)))
        lines.append(self.tr("A distance is called farther or nearer in the second test only where the whole 95 % "
                             "interval of its difference is on that side of zero."))
        alone = len(comparison.only_first), len(comparison.only_second)
        if any(alone):
            lines.append(self.tr("Lines of one test only: {first} of the first, {second} of the second.").format(
                first=alone[0], second=alone[1]))
        rows = circumstances(comparison.first, comparison.second)
        nothing = "\N{EN DASH}"
        lines += [f"{circumstance_title(row.name)}: {row.first or nothing} / {row.second or nothing}" for row in rows]
        return "\n".join(lines)


def _name(side: Side) -> str:
    return f"{scenario_title(side.scenario)}, {date_text(str(side.progress.session.get(STARTED, '')))}"
