"""Free space on the disk of the results, queried in a separate thread: a network folder may answer late, or never."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import shutil
import threading
from typing import Callable

PERIOD_S = 5.0


def free_bytes(folder: pathlib.Path) -> int | None:
    """Return the free space at a folder, which may not exist yet; None if the system does not report it."""
    for place in (folder, *folder.parents):
        try:
            return shutil.disk_usage(place).free
        except FileNotFoundError:
            continue
        except OSError:
            return None
    return None


class DiskWatch:
    """Periodic query. folder: returns the current folder.

    Attributes: free: bytes at the last query, None if unknown.
    """

    def __init__(self, folder: Callable[[], pathlib.Path]):
        self._folder = folder
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name="disk", daemon=True)
        self.free: int | None = None

    def start(self) -> None:
        """Query now, and every few seconds until stop(); safe to call twice."""
        if self._thread.ident is None:
            self._thread.start()

    def stop(self) -> None:
        """Stop the queries, without waiting for a running one."""
        self._ending.set()

    def _run(self) -> None:
        while not self._ending.is_set():
            self.free = free_bytes(self._folder())
            self._ending.wait(PERIOD_S)
