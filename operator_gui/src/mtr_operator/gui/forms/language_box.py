"""Choice of the window's language."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtWidgets import QComboBox, QWidget

from mtr_operator.station.settings import LANGUAGES

# Languages are named in themselves.
_CZECH = "\u010ce\u0161tina"


class LanguageBox(QComboBox):
    """currentData() is one of settings.LANGUAGES; chosen: the one in use."""

    def __init__(self, chosen: str, parent: QWidget | None = None):
        super().__init__(parent)
        names = {"system": self.tr("As the system"), "en": "English", "cs": _CZECH}
        for code in LANGUAGES:
            self.addItem(names[code], code)
        self.setCurrentIndex(LANGUAGES.index(chosen))
        self.setAccessibleName(self.tr("Language"))
