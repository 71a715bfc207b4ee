"""Asks whether a robot that is held may go on, and waits for Enter without stopping the runner."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
import threading
from typing import Callable, TextIO

QUESTION = ("The robot stands until you have it go on: see that nobody is near it, then press Enter. Ctrl-C ends the "
            "test.")


class Release:
    """Called at each step with the hold in force; gives the newest one that was released."""

    def __init__(self, say: Callable[[str], None], stream: TextIO | None = None):
        self._say = say
        self._stream = stream or sys.stdin
        self._asked = self._released = 0
        self._waiting = False

    def __call__(self, hold_id: int) -> int:
        if hold_id and hold_id != self._asked:
            self._asked = hold_id
            self._say(QUESTION)
        if hold_id and not self._waiting and self._released != hold_id:
            self._waiting = True
            threading.Thread(target=self._wait, args=(hold_id,), name="release", daemon=True).start()
        return self._released

    def _wait(self, hold_id: int) -> None:
        # At the end of the input nobody can answer any more.
        if self._stream.readline():
            # Whoever answers has read the question asked last, when that was this one.
            self._released = hold_id if hold_id == self._asked else self._released
            self._waiting = False
