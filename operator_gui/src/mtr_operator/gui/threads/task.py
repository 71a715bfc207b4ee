"""Works on chosen tests in a thread: a log may be long, a bundle is verified first, and a store may be far away."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
from typing import Any, Callable

from PyQt5.QtCore import pyqtSignal

from mtr_operator.domain.errors import OperatorError

from .waited_thread import WaitedThread

# Is told by a function whether the application ends meanwhile.
Work = Callable[[Callable[[], bool]], Any]


class Task(WaitedThread):
    """Signals, each with this task: done(task, result): of the work. refused(task, text): why it could not be done."""

    done = pyqtSignal(object, object)
    refused = pyqtSignal(object, str)

    def __init__(self, work: Work):
        super().__init__()
        self._work = work

    def prepare_to_finish(self) -> None:
        """See WaitedThread: no more than the test that is being read."""
        self.requestInterruption()

    def run(self) -> None:
        """See QThread."""
        try:
            result = self._work(self.isInterruptionRequested)
            if not self.isInterruptionRequested():
                self.done.emit(self, result)
        except OperatorError as error:
            self.refused.emit(self, str(error))
        # Qt ends the process when an exception leaves this function.
        except Exception as error:
            logging.exception("Something was not done with a test because of a defect of the application.")
            self.refused.emit(self, f"The application has a defect: {type(error).__name__}: {error}")
