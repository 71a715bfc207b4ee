"""Repeated tests: picture of all, and mean and standard deviation of each distance with their intervals."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

from PyQt5.QtWidgets import QWidget

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.report.protocol_rows import date_text

from ..names import scenario_title
from ..pictures.layers.layer import Layer
from ..pictures.layers.points_layer import PointsLayer
from ..theme.appearance import Appearance
from .spread_model import SpreadModel
from .spread_picture import spread_layers
from .tests_window import TestsWindow, circumstance_title

if TYPE_CHECKING:
    from mtr_operator.history.spread import TestSpread


class SpreadWindow(TestsWindow):
    """Attributes: found: what is shown. For the others see TestsWindow."""

    def __init__(self, found: TestSpread, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(found.tests.words, appearance, parent)
        self.setWindowTitle(self.tr("Spread of repeated tests"))
        self.found = found
        self.show_tests(SpreadModel(found, self), self.tr("Mean and standard deviation of each distance"),
                        self._summary())

    def layers(self, word: str) -> tuple[Sequence[Layer], PointsLayer]:
        """See TestsWindow."""
        return spread_layers(self.found, word)

    def marked(self, row: int) -> tuple[str, tuple[Point, ...]]:
        """See TestsWindow."""
        distance = self.found.distances[row]
        return distance.word, tuple(distance.ray.point(value) for value in distance.values_m)

    def _summary(self) -> str:
        sides = self.found.tests.sides
        first, last = (date_text(str(side.progress.session.get(STARTED, ""))) for side in (sides[0], sides[-1]))
        lines = [self.tr("{scenario}, {count} tests from {first} to {last}").format(
            scenario=scenario_title(self.found.tests.first.scenario), count=len(sides), first=first, last=last)]
        if self.found.differing:
            names = ", ".join(map(circumstance_title, self.found.differing))
            lines.append(self.tr("The tests differ in: {names}. What that does to the distances is in the spread.")
                         .format(names=names))
        alone = sum(map(len, self.found.tests.alone))
        if alone:
            lines.append(self.tr("Lines that the first test has not: {count}. They are left out.").format(count=alone))
        lines.append(self.tr("The mean's interval is that of the tests' spread, wider by what no repetition shows: the "
                             "Car's outline, mast, floor and lever of the key."))
        lines.append(self.tr("The standard deviation is that of one test of the same car and key; it has an interval "
                             "from three tests on. Tests that know only an end have no value and are not in it."))
        return "\n".join(lines)
