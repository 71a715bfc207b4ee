"""Computes a recorded test anew in a thread: its log may be long."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
import pathlib

from PyQt5.QtCore import pyqtSignal

from mtr_operator.domain.errors import OperatorError

from ..waited_thread import WaitedThread


class Replaying(WaitedThread):
    """Signals: replayed(path, ReplayedTest). refused(text): why not."""

    replayed = pyqtSignal(object, object)
    refused = pyqtSignal(str)

    def __init__(self, path: pathlib.Path):
        super().__init__()
        self._path = path

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
