"""A framed part of a window, with a heading."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtWidgets import QFrame, QLabel, QVBoxLayout, QWidget

from ..theme.scale import L, M


class Card(QFrame):
    """Attributes: column: its layout."""

    def __init__(self, heading: str = "", parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("card")
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(L, M, L, M)
        self.column.setSpacing(M)
        if heading:
            self.add_heading(heading)

    def add_heading(self, text: str) -> None:
        """Write a heading below what is there."""
        label = QLabel(text)
        label.setProperty("role", "large")
        self.column.addWidget(label)
