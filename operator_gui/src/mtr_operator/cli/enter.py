"""Enter on the command line as the answer to a question, without stopping the runner."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import sys
import threading
from typing import Callable, TextIO


class Enter:
    """One reader for all questions: a line answers the one that was asked first, and one without a question nothing.

    It reads from its making on, so that no line of before answers the first question.
    """

    def __init__(self, stream: TextIO | None = None):
        # A program without a terminal may have none.
        self._stream: TextIO | None = stream or sys.stdin
        self._lock = threading.Lock()
        self._questions: collections.deque[Callable[[], None]] = collections.deque()
        threading.Thread(target=self._read, name="enter", daemon=True).start()

    def ask(self, answered: Callable[[], None]) -> None:
        """Call this, in the reader's thread, when Enter was pressed."""
        with self._lock:
            self._questions.append(answered)

    def withdraw(self, answered: Callable[[], None]) -> None:
        """Nobody need answer this question any more; safe when it was answered."""
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
        """True as soon as there is a line; False at the end of the input, where nobody can answer any more."""
        try:
            return self._stream is not None and bool(self._stream.readline())
        except (OSError, ValueError):
            # It was closed, or cannot be read, or what it has is no text.
            return False
