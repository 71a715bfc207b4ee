"""Which tests of before are looked for: words, car, key and verdict."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QComboBox, QHBoxLayout, QLineEdit, QVBoxLayout, QWidget

from mtr_operator.history.entry import TestEntry
from mtr_operator.history.search import matching, unreadable, values_of

from ..names import domain_word
from ..theme.scale import S

_BOX_LETTERS = 10


class HistoryFilters(QWidget):
    """Attributes: search: text field. car, key, verdict: boxes with what there is.

    Signals: changed.
    """

    changed = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.search = QLineEdit()
        self.search.setPlaceholderText(self.tr("Search: VIN, key, day, operator, note"))
        self.search.setAccessibleName(self.tr("Search"))
        self.search.textChanged.connect(lambda _: self.changed.emit())
        self.car = self._box(self.tr("Car"))
        self.key = self._box(self.tr("Key"))
        self.verdict = self._box(self.tr("Verdict"))
        boxes, column = QHBoxLayout(), QVBoxLayout(self)
        boxes.setSpacing(S)
        for box in (self.car, self.key, self.verdict):
            boxes.addWidget(box, 1)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(S)
        # Its hint is longer than what three boxes leave of a laptop's width.
        column.addWidget(self.search)
        column.addLayout(boxes)

    def _box(self, title: str) -> QComboBox:
        box = QComboBox()
        box.setAccessibleName(title)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        box.setMinimumContentsLength(_BOX_LETTERS)
        box.addItem(title, "")
        box.currentIndexChanged.connect(lambda _: self.changed.emit())
        return box

    def offer(self, entries: Sequence[TestEntry]) -> None:
        """Offer the cars, keys and verdicts of these; what is chosen stays where it still is there."""
        for box, name in ((self.car, "car"), (self.key, "key"), (self.verdict, "verdict")):
            chosen = box.currentData()
            box.blockSignals(True)
            while box.count() > 1:
                box.removeItem(1)
            for value in values_of(entries, name):
                box.addItem(domain_word(value) if name == "verdict" else value, value)
            box.setCurrentIndex(max(box.findData(chosen), 0))
            box.blockSignals(False)

    def sifted(self, entries: Sequence[TestEntry]) -> list[TestEntry]:
        """Those that are looked for, then what cannot be read."""
        text, car, key, verdict = (self.search.text(), *(box.currentData() or "" for box in
                                                         (self.car, self.key, self.verdict)))
        # Whoever looks for a car does not look for what nobody can read.
        broken = [] if car or key or verdict else unreadable(entries, text)
        return [*matching(entries, text, car=car, key=key, verdict=verdict), *broken]
