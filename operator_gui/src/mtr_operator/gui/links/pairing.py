"""Pairs this laptop with a robot beside the window: the robot may take its time."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import logging
import threading

from PyQt5.QtCore import QObject, pyqtSignal

from mtr_operator.domain.errors import OperatorError
from mtr_operator.station.connection import LinkOpener


class Pairing(QObject):
    """Signals: done(role): paired. refused(text): why not. They come in the thread of the window."""

    done = pyqtSignal(str)
    refused = pyqtSignal(str)

    def __init__(self, opener: LinkOpener, parent: QObject | None = None):
        super().__init__(parent)
        self._opener = opener

    def begin(self, host: str, code: str) -> None:
        """Try it; done or refused follows."""
        threading.Thread(target=self._run, args=(host, code), name="pairing", daemon=True).start()

    def _run(self, host: str, code: str) -> None:
        signal, said = self.done, ""
        try:
            said = self._opener.pair(host, code)
        except OperatorError as error:
            signal, said = self.refused, str(error)
        except Exception as error:
            logging.exception("Pairing ended by a defect of the application.")
            signal, said = self.refused, f"The application has a defect: {type(error).__name__}: {error}"
        # The window may have been closed meanwhile.
        with contextlib.suppress(RuntimeError):
            signal.emit(said)
