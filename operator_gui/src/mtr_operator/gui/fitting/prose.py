"""Sentences in rows: a figure stays in one row with its unit."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

from PyQt5.QtWidgets import QLabel, QWidget

_NO_BREAK = "\N{NO-BREAK SPACE}"
_UNITS = "%", "\N{DEGREE SIGN}", "km/h", "m/s", "bit/s", "[cmk]?m", "ms", "min", "[shV]", "[kMG]?Hz", "[kMG]?B"
_BEFORE_UNIT = re.compile(rf"(?<=\d) (?=(?:{'|'.join(_UNITS)})(?!\w))")


def together(text: str) -> str:
    """The text, with no row ending between a figure and its unit."""
    return _BEFORE_UNIT.sub(_NO_BREAK, text)


class Prose(QLabel):
    """A label of several rows."""

    def __init__(self, text: str = "", parent: QWidget | None = None):
        super().__init__(together(text), parent)
        self.setWordWrap(True)

    def setText(self, text: str) -> None:
        """See QLabel."""
        super().setText(together(text))

    def text(self) -> str:
        """As it was given."""
        return super().text().replace(_NO_BREAK, " ")
