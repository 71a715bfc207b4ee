"""Labels show each text as it is: what people, robots and files say is never markup."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QEvent, QObject, Qt
from PyQt5.QtWidgets import QApplication, QLabel


class PlainLabels(QObject):
    """Makes every label of the application plain before it is shown; message boxes and tool tips have labels, too."""

    def install(self) -> None:
        """From now on."""
        QApplication.instance().installEventFilter(self)

    def remove(self) -> None:
        """Safe to call twice."""
        QApplication.instance().removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """See QObject; left to itself a label guesses whether a text is HTML."""
        if event.type() == QEvent.Type.Polish and isinstance(watched, QLabel):
            watched.setTextFormat(Qt.TextFormat.PlainText)
        return False
