"""Reads the folders of tests in a thread: ten thousand files take longer than the window may be blocked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
from typing import ClassVar

from PyQt5.QtCore import QObject, QThread, pyqtSignal

from mtr_operator.history.index import Index

# One test that is being read.
FINISH_LIMIT_MS = 5000


class HistoryReader(QThread):
    """Brings an index up to date; the index belongs to the thread while it runs.

    Signals: told(entries): what is known so far. done(entries): all of it.
    """

    told = pyqtSignal(list)
    done = pyqtSignal(list)
    _running: ClassVar[set[HistoryReader]] = set()

    def __init__(self, index: Index, parent: QObject | None = None):
        super().__init__(parent)
        self._index = index
        self._running.add(self)
        self.finished.connect(lambda: self._running.discard(self))

    @classmethod
    def finish_all(cls) -> None:
        """End what is being read: a thread that Qt ends with the window is a crash."""
        for reader in list(cls._running):
            reader.requestInterruption()
        for reader in list(cls._running):
            reader.wait(FINISH_LIMIT_MS)

    def run(self) -> None:
        """See QThread."""
        try:
            self.done.emit(self._index.refresh(self.told.emit, self.isInterruptionRequested))
        # Qt ends the process when an exception leaves this function.
        except Exception:
            logging.exception("The history was not read because of a defect of the application.")
            self.done.emit(self._index.entries)
