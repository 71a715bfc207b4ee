"""Enter on the command line as the answer to a question, without blocking the runner."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import sys
import threading
from typing import Callable, TextIO


class Enter:
    """One reader for all questions: a line answers the oldest question, and is ignored without one.

    It reads from its construction on, so that no earlier line answers the first question.
    """

    def __init__(self, stream: TextIO | None = None):
        # A program without a terminal may have none.
        self._stream: TextIO | None = stream or sys.stdin
        self._lock = threading.Lock()
        self._questions: collections.deque[Callable[[], None]] = collections.deque()
        threading.Thread(target=self._read, name="enter", daemon=True).start()

    def ask(self, answered: Callable[[], None]) -> None:
        """Call this function, in the reader's thread, after Enter was pressed."""
        with self._lock:
            self._questions.append(answered)

    def withdraw(self, answered: Callable[[], None]) -> None:
        """Cancel this question; safe if it was answered."""
        with self._lock:
            if answered in self._questions:
                self._questions.remove(answered)

    def _read(self) -> None:
        while self._has_line():
            with self._lock:
                answered = self._questions.popleft() if self._questions else None
            if answered is not None:
                answered()

    def _has_line(self) -> bool:
        """Wait for a line; return False at the end of the input, after which no answer is possible."""
        try:
            return self._stream is not None and bool(self._stream.readline())
        except (OSError, ValueError):
            # The input was closed, is unreadable, or is not text.
            return False
