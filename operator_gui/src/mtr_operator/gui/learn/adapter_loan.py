"""Takes the CAN adapter from the link to the Car for a while: two programs in one cannot open it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QObject, pyqtSignal

from mtr_operator.station.connection import CanChoice

from ..flow import Flow


class AdapterLoan(QObject):
    """Signals: taken: the adapter is free."""

    taken = pyqtSignal()

    def __init__(self, flow: Flow, parent: QObject | None = None):
        super().__init__(parent)
        self._flow = flow
        self._former: CanChoice | None = None
        flow.connecting.can_opened.connect(self._learn)

    def take(self, choice: CanChoice) -> None:
        """Free this adapter; taken follows, at once when nobody has it."""
        used = self._flow.connecting.can_in_use
        if used is None or (choice.interface, choice.channel) not in used.places:
            self.taken.emit()
            return
        self._former = used
        self._flow.connecting.use_can(None)

    def give_back(self) -> None:
        """The link to the Car has it again; safe to call twice."""
        former, self._former = self._former, None
        if former is not None:
            self._flow.connecting.use_can(former)

    def _learn(self) -> None:
        if self._former is not None and self._flow.connecting.can_in_use is None:
            self.taken.emit()
