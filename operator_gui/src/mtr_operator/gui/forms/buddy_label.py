"""A label whose field gets the focus when the label is clicked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtGui import QMouseEvent
from PyQt5.QtWidgets import QLabel, QWidget


class BuddyLabel(QLabel):
    """Label of a field."""

    def __init__(self, title: str, field: QWidget):
        super().__init__(title)
        self.setWordWrap(True)
        self.setBuddy(field)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """See QWidget."""
        self.buddy().setFocus()
