"""The files of a test that runs, written beside its answers: a disk that is slow keeps nobody waiting for the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import concurrent.futures
import logging
import math
from types import TracebackType
from typing import Any, Callable, Mapping, Protocol

from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.results.journal import Journal


class Files(Protocol):
    """Of a test, see Store."""

    @property
    def has_changed(self) -> bool:
        """True when something was kept since it was opened."""

    def add(self, kind: str, values: Mapping[str, Any]) -> None:
        pass

    def content(self) -> bytes:
        """Of a progress file, as the test stands."""

    def save(self, content: bytes | None = None) -> None:
        """Write the progress file."""


class JournalBeside(Journal):
    """Has one thread write entries and progress files in their order; use as a context manager, which waits for all.

    While it is open nobody else writes. What could not be kept is told once, by `check`, in its order.
    """

    def __init__(self, files: Files):
        self._files = files
        self._thread = concurrent.futures.ThreadPoolExecutor(max_workers=1, thread_name_prefix="journal")
        self._newest: concurrent.futures.Future[None] | None = None
        # A deque, for both threads change it.
        self._failures: collections.deque[Exception] = collections.deque()

    def __enter__(self) -> JournalBeside:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self._thread.shutdown(wait=True)
        if error is None or (isinstance(error, Exception) and not isinstance(error, OutputError)):
            # Where a measurement is matters more than that the test was ended, or by what.
            self.check()
        for failure in self._failures:
            logging.error("%s", failure)

    def add(self, kind: str, values: Mapping[str, Any]) -> None:
        """See Journal: the entry is handed over. The values must not be changed afterwards."""
        if self._files.has_changed:
            self._hand_over(lambda: self._files.add(kind, values))
        else:
            # The first one is kept with the whole progress as it is now.
            self._files.add(kind, values)

    def save(self) -> None:
        """Have the progress file written as the test stands; all entries have to be safe."""
        content = self._files.content()
        self._hand_over(lambda: self._files.save(content))

    def wait(self, patience_s: float = math.inf) -> bool:
        if self._newest is None:
            return True
        concurrent.futures.wait([self._newest], None if math.isinf(patience_s) else patience_s)
        return self._newest.done()

    def check(self) -> None:
        if self._failures:
            raise self._failures.popleft()

    def _hand_over(self, write: Callable[[], None]) -> None:
        self._newest = self._thread.submit(self._write, write)

    def _write(self, write: Callable[[], None]) -> None:
        try:
            write()
        # A defect, too, is for the one who measures.
        except Exception as error:
            self._failures.append(error)
