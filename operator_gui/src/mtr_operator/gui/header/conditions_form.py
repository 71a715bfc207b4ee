"""Operating conditions that a person confirms one by one before a test on a real robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QCheckBox, QHBoxLayout, QVBoxLayout, QWidget

from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.supervision.conditions import CONDITIONS

from ..fitting.prose import Prose
from ..sentences import translated
from ..theme.scale import M, S
from .check_texts import condition_text, condition_title


class ConditionsForm(QWidget):
    """Attributes: boxes: one by condition. announcement: what the Car may do in this test; hidden without one.

    Signals: changed: something else is confirmed.
    """

    changed = pyqtSignal()

    def __init__(self, scenario: AnyScenario, parent: QWidget | None = None):
        super().__init__(parent)
        self.announcement = Prose(translated(scenario.announcement))
        self.boxes = {name: QCheckBox() for name in CONDITIONS}
        self._rows = QWidget()
        rows = QVBoxLayout(self._rows)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(S)
        rows.addWidget(Prose(self.tr("Confirm each operating condition:")))
        for name, box in self.boxes.items():
            text = Prose(f"{condition_title(name)}: {condition_text(name)}")
            box.setAccessibleName(text.text())
            box.toggled.connect(lambda _: self.changed.emit())
            row = QHBoxLayout()
            row.setSpacing(S)
            row.addWidget(box)
            row.addWidget(text, 1)
            rows.addLayout(row)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, M, 0)
        layout.setSpacing(S)
        layout.addWidget(self.announcement)
        layout.addWidget(self._rows)
        # A widget without a parent would open as a window of its own, and take the focus.
        self.announcement.setVisible(bool(scenario.announcement))
        self._rows.hide()

    @property
    def confirmed(self) -> tuple[str, ...]:
        """Conditions that are confirmed."""
        return tuple(name for name, box in self.boxes.items() if box.isChecked())

    @property
    def is_complete(self) -> bool:
        """True when all are confirmed."""
        return len(self.confirmed) == len(self.boxes)

    def ask(self, is_real: bool) -> None:
        """Ask for them, or not: a simulated robot needs none."""
        self._rows.setVisible(is_real)

    def clear(self) -> None:
        """Another test is about to begin: nothing is confirmed for it."""
        for box in self.boxes.values():
            box.setChecked(False)
