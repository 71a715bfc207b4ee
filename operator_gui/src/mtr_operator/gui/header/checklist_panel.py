"""The checklist as rows: a sign, what is looked at, what was found, and what to do."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import Qt
from PyQt5.QtWidgets import QGridLayout, QLabel, QWidget

from mtr_operator.station.checks.finding import Item, State

from ..fitting.prose import Prose
from ..i18n import translate
from ..theme.scale import XS, M
from ..theme.state import show_state
from .check_texts import check_advice, check_text, check_title

# Told apart without colours too.
_SIGNS = {State.GOOD: "\N{CHECK MARK}", State.NOTE: "!", State.UNKNOWN: "?", State.BAD: "\N{MULTIPLICATION X}"}
_COLUMNS = 3


class ChecklistPanel(QWidget):
    """Rows are made once for so many items, and their texts change with the items."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._shown: tuple[Item, ...] = ()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(M)
        self._grid.setVerticalSpacing(XS)
        self._grid.setColumnStretch(_COLUMNS - 1, 1)
        self._rows: list[tuple[QLabel, QLabel, Prose]] = []

    def show_items(self, items: Sequence[Item]) -> None:
        """Show these."""
        if tuple(items) == self._shown:
            return
        self._shown = tuple(items)
        while len(self._rows) < len(items):
            self._add_row()
        for index, row in enumerate(self._rows):
            for label in row:
                label.setVisible(index < len(items))
        for row, item in zip(self._rows, items):
            self._fill(row, item)

    def texts(self) -> list[str]:
        """Sign, name, sentence and advice of each row."""
        return [" ".join(label.text() for label in row if label.text()) for row in self._rows[:len(self._shown)]]

    def _add_row(self) -> None:
        row = (QLabel(), QLabel(), Prose())
        for column, label in enumerate(row):
            label.setAlignment(Qt.AlignmentFlag.AlignTop)
            label.setTextFormat(Qt.TextFormat.PlainText)
            self._grid.addWidget(label, len(self._rows), column)
        self._rows.append(row)

    @staticmethod
    def _fill(row: tuple[QLabel, QLabel, Prose], item: Item) -> None:
        sign, name, sentence = row
        sign.setText(sign_of(item.state))
        sign.setAccessibleName(state_word(item.state))
        show_state(sign, "check", item.state.value)
        name.setText(check_title(item.check))
        sentence.setText(" ".join(filter(None, (check_text(item), check_advice(item)))))


def sign_of(state: State) -> str:
    """The state as a character."""
    return _SIGNS[state]


def state_word(state: State) -> str:
    """The sign in a word, for who does not see it."""
    return {State.GOOD: translate("Check", "good"), State.NOTE: translate("Check", "note"),
            State.UNKNOWN: translate("Check", "not known"), State.BAD: translate("Check", "hinders a test")}[state]
