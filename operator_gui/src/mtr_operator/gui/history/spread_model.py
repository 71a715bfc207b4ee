"""Mean and spread of repeated tests as a table."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

from PyQt5.QtCore import QModelIndex, QObject, Qt

from ..figure_text import ends_text, estimate_text, sigma_text
from ..i18n import translate
from ..names import domain_word
from ..sentences import translated
from .table_model import TableModel

if TYPE_CHECKING:
    from mtr_operator.history.spread import DistanceSpread, TestSpread

# Columns of words; after them come figures.
_WORDS = 2


class SpreadModel(TableModel):
    """Line, distance, tests with a value, mean with its 95 % interval, standard deviation with its own, and the
    smallest and largest value; why something is not known as a tip."""

    def __init__(self, found: TestSpread, parent: QObject | None = None):
        super().__init__(parent)
        self._found = found

    def _rows(self) -> Sequence[DistanceSpread]:
        return self._found.distances

    def data(self, index: QModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """See QAbstractItemModel."""
        distance = self._found.distances[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return self._texts(distance)[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return translated(distance.mean.reason or distance.spread.reason) or None
        if role == Qt.ItemDataRole.TextAlignmentRole and index.column() >= _WORDS:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        return None

    def _headings(self) -> tuple[str, ...]:
        return (domain_word(self._found.tests.first.scenario.line_word).capitalize(), "", self.tr("Tests"),
                self.tr("Mean [m]"), self.tr("95 % of the mean [m]"), self.tr("Std. deviation [m]"),
                self.tr("95 % of it [m]"), self.tr("Smallest to largest [m]"))

    @staticmethod
    def _texts(distance: DistanceSpread) -> tuple[str, ...]:
        values, ends = distance.values_m, distance.sigma_ends_m
        counted = str(distance.tests) if not distance.without else \
            translate("Spread", "{count} of {all}").format(count=len(values), all=distance.tests)
        return (f"{distance.line.number} ({domain_word(distance.line.place)})", domain_word(distance.word), counted,
                estimate_text(distance.mean), "" if distance.mean.value is None else ends_text(distance.mean.low,
                                                                                      distance.mean.high),
                sigma_text(distance.sigma_m), "" if ends is None else ends_text(*ends, digits=3),
                ends_text(min(values), max(values)) if values else "")
