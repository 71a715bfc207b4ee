"""One word with a colour: can a test be started? A click lists the reasons."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtWidgets import QPushButton, QWidget

from mtr_operator.station.readiness import Readiness, ReadinessWord

from ..stopping import Stopping
from .popup import Popup
from .reasons import advice_text, reason_text, word_text

# Told apart without colours too.
_SIGNS = {
    ReadinessWord.READY: "\N{CHECK MARK}",
    ReadinessWord.WARNINGS: "!",
    ReadinessWord.NOT_READY: "\N{MULTIPLICATION X}",
    ReadinessWord.MEASURING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.PAUSED: "\N{DOUBLE VERTICAL LINE}",
    ReadinessWord.LOST: "\N{MULTIPLICATION X}",
    ReadinessWord.DRIVING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.MAPPING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.CHECKING: "\N{BLACK RIGHT-POINTING TRIANGLE}",
    ReadinessWord.BLOCKED: "\N{MULTIPLICATION X}",
}


class StatusWord(QPushButton):
    """Attributes: popup: the list of reasons."""

    def __init__(self, stopping: Stopping, parent: QWidget | None = None):
        super().__init__(parent)
        self.popup = Popup(self, stopping)
        self._readiness: Readiness | None = None
        self.clicked.connect(self._open)

    def show_readiness(self, readiness: Readiness) -> None:
        """Show another readiness."""
        if readiness == self._readiness:
            return
        word_changed = self._readiness is None or readiness.word is not self._readiness.word
        self._readiness = readiness
        word = word_text(readiness.word)
        if word_changed:
            self.setText(f"{_SIGNS[readiness.word]}  {word}")
            self.setProperty("word", readiness.word.value)
            self.style().unpolish(self)
            self.style().polish(self)
        sentences = [reason_text(reason) for reason in readiness.reasons]
        self.setAccessibleName(self.tr("Status: {word}").format(word=word))
        self.setAccessibleDescription(" ".join(sentences))
        self.setToolTip("\n".join(sentences) or self.tr("Everything is ready for a test."))
        if self.popup.isVisible():
            self._fill()

    def _open(self) -> None:
        self._fill()
        self.popup.open_below(self)

    def _fill(self) -> None:
        readiness = self._readiness
        if readiness is None:
            return
        entries = [(reason_text(reason), advice_text(reason)) for reason in readiness.reasons]
        self.popup.fill(word_text(readiness.word), entries or [(self.tr("Nothing stands against it."), "")])
