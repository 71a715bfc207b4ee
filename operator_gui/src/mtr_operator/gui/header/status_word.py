"""One word with a colour: can a test be started? A click lists the reasons."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtWidgets import QPushButton, QWidget

from mtr_operator.station.readiness import Verdict, Word

from .popup import Popup
from .reasons import advice_text, reason_text, word_text

# Told apart without colours too.
_SIGNS = {Word.READY: "\N{CHECK MARK}", Word.WARNINGS: "!", Word.NOT_READY: "\N{MULTIPLICATION X}",
          Word.MEASURING: "\N{BLACK RIGHT-POINTING TRIANGLE}", Word.PAUSED: "\N{DOUBLE VERTICAL LINE}",
          Word.LOST: "\N{MULTIPLICATION X}"}


class StatusWord(QPushButton):
    """Attributes: popup: the list of reasons."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.popup = Popup(self)
        self._verdict: Verdict | None = None
        self.clicked.connect(self._open)

    def show_verdict(self, verdict: Verdict) -> None:
        """Show another verdict."""
        if verdict == self._verdict:
            return
        word_changed = self._verdict is None or verdict.word is not self._verdict.word
        self._verdict = verdict
        word = word_text(verdict.word)
        if word_changed:
            self.setText(f"{_SIGNS[verdict.word]}  {word}")
            self.setProperty("word", verdict.word.value)
            self.style().unpolish(self)
            self.style().polish(self)
        sentences = [reason_text(reason) for reason in verdict.reasons]
        self.setAccessibleName(self.tr("Status: {word}").format(word=word))
        self.setAccessibleDescription(" ".join(sentences))
        self.setToolTip("\n".join(sentences) or self.tr("Everything is ready for a test."))
        if self.popup.isVisible():
            self._fill()

    def _open(self) -> None:
        self._fill()
        self.popup.open_below(self)

    def _fill(self) -> None:
        verdict = self._verdict
        entries = [(reason_text(reason), advice_text(reason)) for reason in verdict.reasons]
        self.popup.fill(word_text(verdict.word), entries or [(self.tr("Nothing stands against it."), "")])
