"""Reads tests and computes their spread in a thread: there may be hundreds of them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
import pathlib
from typing import Sequence

from PyQt5.QtCore import pyqtSignal

from mtr_operator.domain.errors import OperatorError
from mtr_operator.history.line_pairs import open_side

from ..waited_thread import WaitedThread


class Spreading(WaitedThread):
    """Signals: computed(TestSpread). refused(text): why not."""

    computed = pyqtSignal(object)
    refused = pyqtSignal(str)

    def __init__(self, paths: Sequence[pathlib.Path]):
        """paths: of the tests, oldest first."""
        super().__init__()
        self._paths = tuple(paths)

    def prepare_to_finish(self) -> None:
        """See WaitedThread: no more than the test that is being read."""
        self.requestInterruption()

    def run(self) -> None:
        """See QThread."""
        try:
            # Its solvers are needed for nothing else of the window.
            from mtr_operator.history.spread import spread_of
            sides = [open_side(path) for path in self._paths if not self.isInterruptionRequested()]
            if not self.isInterruptionRequested():
                self.computed.emit(spread_of(sides))
        except OperatorError as error:
            self.refused.emit(str(error))
        # Qt ends the process when an exception leaves this function.
        except Exception as error:
            logging.exception("The spread was not computed because of a defect of the application.")
            self.refused.emit(f"The application has a defect: {type(error).__name__}: {error}")
