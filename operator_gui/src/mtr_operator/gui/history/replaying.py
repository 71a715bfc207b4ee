"""Computes a recorded test anew in a thread: its log may be long."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
import pathlib
from typing import ClassVar

from PyQt5.QtCore import QThread, pyqtSignal

from mtr_operator.domain.errors import OperatorError

FINISH_LIMIT_MS = 20_000


class Replaying(QThread):
    """Signals: replayed(path, ReplayedTest). refused(text): why not."""

    replayed = pyqtSignal(object, object)
    refused = pyqtSignal(str)
    _running: ClassVar[set[Replaying]] = set()

    def __init__(self, path: pathlib.Path):
        super().__init__()
        self._path = path
        self._running.add(self)
        self.finished.connect(lambda: self._running.discard(self))

    @classmethod
    def finish_all(cls) -> None:
        """Wait for what is being computed: a thread that Qt ends with the window is a crash."""
        for replaying in list(cls._running):
            replaying.wait(FINISH_LIMIT_MS)

    def run(self) -> None:
        """See QThread."""
        try:
            # Reads logs and databases of buses, which nothing else of the window needs.
            from mtr_operator.replay.replay_file import replay_file
            self.replayed.emit(self._path, replay_file(self._path)[1])
        except OperatorError as error:
            self.refused.emit(str(error))
        # Qt ends the process when an exception leaves this function.
        except Exception as error:
            logging.exception("The test was not computed anew because of a defect of the application.")
            self.refused.emit(f"The application has a defect: {type(error).__name__}: {error}")
