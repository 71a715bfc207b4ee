"""What the uncertainty of a line's distances is made of, as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

from PyQt5.QtCore import QAbstractTableModel, QModelIndex, QObject, Qt

from mtr_operator.domain.estimation.budget.distance_budget import DistanceBudget
from mtr_operator.domain.verdict.assessment import Assessment

from ..i18n import number
from ..names import domain_word
from ..sentences import translated

_DIGITS = 4
# Column with a number.
_SIGMA = 2


class BudgetModel(QAbstractTableModel):
    """Term by term of each distance of a line: 1 sigma in m, whether other lines have the same error, and the source;
    then the expanded uncertainty. None shows nothing. What a distance is called is told where a line has several."""

    def __init__(self, assessment: Assessment, line: int | None, parent: QObject | None = None):
        super().__init__(parent)
        self._headings = (self.tr("Distance"), self.tr("Part of its uncertainty"), "\N{GREEK SMALL LETTER SIGMA} [m]",
                          self.tr("In common"), self.tr("From"))
        self._first = 0 if len({budget.word for budget in assessment.budgets}) > 1 else 1
        self._rows = [row for budget in assessment.budgets if budget.line == line for row in self._rows_of(budget)]

    def _rows_of(self, budget: DistanceBudget) -> list[tuple[str, ...]]:
        word = domain_word(budget.word)
        rows = [(word, domain_word(term.name), number(term.contribution_m, _DIGITS),
                 self.tr("yes") if term.is_common else self.tr("no"), translated(domain_word(term.source)))
                for term in sorted(budget.terms, key=lambda term: -term.contribution_m)]
        return [*rows, (word, self.tr("expanded uncertainty, 95 %"), number(budget.expanded_m, _DIGITS), "", "")]

    def rowCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: QModelIndex = QModelIndex()) -> int:  # noqa: B008
        """See QAbstractItemModel."""
        return 0 if parent.isValid() else len(self._headings) - self._first

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        is_heading = role == Qt.ItemDataRole.DisplayRole and orientation == Qt.Orientation.Horizontal
        return self._headings[self._first + section] if is_heading else None

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
            return self._rows[index.row()][self._first + index.column()]
        if role == Qt.ItemDataRole.TextAlignmentRole and self._first + index.column() == _SIGMA:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None
