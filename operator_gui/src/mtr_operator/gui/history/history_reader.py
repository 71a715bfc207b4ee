"""Reads the folders of tests, and the store, in a thread: ten thousand files take longer than the window may be
blocked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging

from PyQt5.QtCore import QObject, pyqtSignal

from mtr_operator.history.index import Index
from mtr_operator.history.laboratory import kept_entries
from mtr_operator.history.search import listed

from ..threads.waited_thread import WaitedThread


class HistoryReader(WaitedThread):
    """Brings an index up to date; the index belongs to the thread while it runs.

    Signals: told(entries): what is known so far. done(entries): all of it.
    """

    told = pyqtSignal(list)
    done = pyqtSignal(list)

    def __init__(self, index: Index, parent: QObject | None = None):
        super().__init__(parent)
        self._index = index

    def prepare_to_finish(self) -> None:
        """See WaitedThread: no more than the test that is being read."""
        self.requestInterruption()

    def run(self) -> None:
        """See QThread."""
        try:
            found = self._index.refresh(self.told.emit, self.isInterruptionRequested)
            # A store on a server that is away takes seconds to say so.
            self.told.emit(found)
            self.done.emit(found if self.isInterruptionRequested() else listed([*found, *kept_entries()]))
        # Qt ends the process when an exception leaves this function.
        except Exception:
            logging.exception("The history was not read because of a defect of the application.")
            self.done.emit(self._index.entries)
