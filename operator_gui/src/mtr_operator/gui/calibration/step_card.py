"""What the steps of the guided calibration have alike: what to do, what came out, and a button that keeps it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QWidget

from mtr_operator.station.calibration.record_keeper import Change
from mtr_operator.station.number_text import parse_numbers

from ..forms.field import Field
from ..i18n import number, translate
from ..theme.scale import S
from ..windows.card import Card

_CM_PER_M, _MM_PER_M = 100.0, 1000.0


class StepCard(Card):
    """Attributes: result: what came out, or what is missing. keep: button.

    Signals: kept(change): put this into the record, see RecordKeeper.
    """

    kept = pyqtSignal(object)

    def __init__(self, heading: str, instruction: str, parent: QWidget | None = None):
        super().__init__(heading, parent)
        self._change: Change | None = None
        what = QLabel(instruction)
        what.setWordWrap(True)
        what.setProperty("role", "soft")
        self.column.addWidget(what)
        self.result = QLabel()
        self.result.setWordWrap(True)
        self.keep = QPushButton(translate("Guide", "Keep in the record"))
        self.keep.setAccessibleName(translate("Guide", "Keep in the record: {what}").format(what=heading))
        self.keep.setEnabled(False)
        self.keep.clicked.connect(self._keep)

    def close_with(self, *buttons: QPushButton) -> None:
        """Lay out the end of the card: what came out, these buttons, and the one that keeps it."""
        row = QHBoxLayout()
        row.setSpacing(S)
        for button in (*buttons, self.keep):
            row.addWidget(button)
        row.addStretch(1)
        self.column.addWidget(self.result)
        self.column.addLayout(row)

    def show_result(self, text: str, change: Change | None) -> None:
        """Show what came out; change: None while there is nothing to keep."""
        self.result.setText(text)
        self._change = change
        self.keep.setEnabled(change is not None)

    def _keep(self) -> None:
        if self._change is not None:
            self.kept.emit(self._change)


def readings_m(field: Field, fault: str) -> list[float] | None:
    """Lengths that are typed in cm; None when one is no number, and the field says so."""
    numbers = parse_numbers(field.text)
    field.show_fault(fault if numbers is None else "")
    return None if numbers is None else [length_cm / _CM_PER_M for length_cm in numbers]


def plus_minus_mm(sigma_m: float) -> str:
    """A standard uncertainty in mm, without its unit."""
    return f"\N{PLUS-MINUS SIGN}{number(sigma_m * _MM_PER_M, 1)}"
