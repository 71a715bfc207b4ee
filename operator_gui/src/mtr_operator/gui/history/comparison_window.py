"""Two tests beside each other: picture of both, and the difference of each distance with its interval."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QSize
from PyQt5.QtWidgets import (
    QComboBox,
    QDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.history.circumstances import circumstances
from mtr_operator.history.comparison import Comparison
from mtr_operator.history.line_pairs import Side
from mtr_operator.report.protocol_rows import date_text

from ..fitting.place import open_within
from ..fitting.plain_table import plain_table
from ..fitting.scroller import Scroller
from ..i18n import number
from ..names import domain_word, identity_title, scenario_title
from ..pictures.picture_panel import PicturePanel
from ..theme.appearance import Appearance
from ..theme.scale import L, M, S
from .comparison_model import ComparisonModel, change_text
from .comparison_picture import overlay_layers

_SIZE = QSize(1300, 760)
_TABLE_HEIGHT = 200


class ComparisonWindow(QDialog):
    """Attributes: comparison: what is shown. word: box of the distances. panel: the picture. table: the differences.
    summary: what came out, and what else differs."""

    def __init__(self, comparison: Comparison, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Two tests compared"))
        self.comparison = comparison
        self.word = QComboBox()
        self.word.setAccessibleName(self.tr("Distance"))
        for word in comparison.first.scenario.distance_words:
            self.word.addItem(domain_word(word).capitalize(), word)
        self.word.setVisible(self.word.count() > 1)
        self.panel = PicturePanel(appearance)
        self.table = plain_table(self.tr("Difference of each distance"), _TABLE_HEIGHT)
        self.table.setModel(ComparisonModel(comparison, self))
        self.summary = QLabel(self._summary())
        self.summary.setWordWrap(True)
        self._lay_out()
        self.word.currentIndexChanged.connect(self._show_word)
        self.table.selectionModel().currentRowChanged.connect(lambda index, _: self._mark(index.row()))
        self._show_word()
        self.ensurePolished()
        open_within(self, _SIZE)

    def _lay_out(self) -> None:
        close = QPushButton(self.tr("Close"))
        close.setDefault(True)
        close.clicked.connect(self.accept)
        left, right, row = QVBoxLayout(), QVBoxLayout(), QHBoxLayout()
        left.setSpacing(S)
        left.addWidget(self.word)
        left.addWidget(self.panel, 1)
        right.setSpacing(M)
        right.addWidget(self.table, 1)
        right.addWidget(self.summary)
        right.addStretch(0)
        row.setSpacing(L)
        row.addLayout(left, 2)
        row.addWidget(Scroller(right), 3)
        below = QHBoxLayout()
        below.addStretch(1)
        below.addWidget(close)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(M)
        layout.addLayout(row, 1)
        layout.addLayout(below)

    def _show_word(self) -> None:
        layers, self._points = overlay_layers(self.comparison, self.word.currentData())
        self.panel.legend.show_sets(self._points.sets)
        self.panel.view.show_layers(layers)

    def _mark(self, row: int) -> None:
        """Show which points a row is about."""
        if row < 0:
            return
        difference = self.comparison.differences[row]
        self.word.setCurrentIndex(self.word.findData(difference.word))
        distances = (result.distances[self.word.currentIndex()] for result in (difference.pair.first,
                                                                               difference.pair.second))
        self._points.chosen = tuple(difference.pair.ray.point(distance.distance_m) for distance in distances
                                    if distance.distance_m is not None)
        self.panel.view.refresh()

    def _summary(self) -> str:
        comparison = self.comparison
        lines = [self.tr("First: {test}").format(test=_name(comparison.first)),
                 self.tr("Second: {test}").format(test=_name(comparison.second))]
        counts = ", ".join(f"{count} {change_text(change)}" for change, count in comparison.counts().items())
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
        lines += [f"{_circumstance(row.name)}: {row.first or nothing} / {row.second or nothing}" for row in rows]
        return "\n".join(lines)


def _circumstance(name: str) -> str:
    title = identity_title(name)
    return domain_word(name) if title == name else title


def _name(side: Side) -> str:
    return f"{scenario_title(side.scenario)}, {date_text(str(side.progress.session.get(STARTED, '')))}"
