"""A thread whose work is waited for before the window ends."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import ClassVar

from PyQt5.QtCore import QObject, QThread

# A large protocol in all its forms takes some seconds.
FINISH_LIMIT_MS = 20_000


class WaitedThread(QThread):
    """Lives until it is finished, also when nobody else knows of it any more."""

    _running: ClassVar[set[WaitedThread]] = set()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._running.add(self)
        self.finished.connect(lambda: self._running.discard(self))

    @classmethod
    def finish_all(cls) -> None:
        """Wait for what is being done: a thread that Qt ends with the window leaves half a file, or a crash."""
        running = list(cls._running)
        for thread in running:
            thread.prepare_to_finish()
        for thread in running:
            if not thread.wait(FINISH_LIMIT_MS):
                # Such as a bundle of a long recording: nothing of it is left.
                thread.requestInterruption()
                thread.wait(FINISH_LIMIT_MS)

    def prepare_to_finish(self) -> None:
        """The application ends; for what need not come to its own end."""
