"""A labelled choice of a few words."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QComboBox, QVBoxLayout, QWidget

from mtr_operator.domain.choice import Choice

from ..names import choice_title, choice_word, parameter_doc
from ..theme.scale import XS
from .buddy_label import BuddyLabel


class ChoiceField(QWidget):
    """Attributes: box: the words to choose from. Signals: changed: another one is chosen."""

    changed = pyqtSignal()

    def __init__(self, name: str, declared: Choice, parent: QWidget | None = None):
        super().__init__(parent)
        self.box = QComboBox()
        for word in declared.words:
            self.box.addItem(choice_word(word), word)
        title = choice_title(name)
        self.box.setAccessibleName(title)
        self.setToolTip(parameter_doc(declared))
        self.box.setAccessibleDescription(self.toolTip())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(XS)
        layout.addWidget(BuddyLabel(title, self.box))
        layout.addWidget(self.box)
        self.box.currentIndexChanged.connect(self.changed)

    @property
    def word(self) -> str:
        """As it stands in files."""
        return str(self.box.currentData())

    def show_word(self, word: str) -> None:
        """Choose it."""
        self.box.setCurrentIndex(self.box.findData(word))
