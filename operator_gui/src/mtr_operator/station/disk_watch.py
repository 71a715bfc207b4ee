"""Room on the disk of the results, asked in a thread of its own: a folder of a network may answer late, or never."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import shutil
import threading
from typing import Callable

PERIOD_S = 5.0


def free_bytes(folder: pathlib.Path) -> int | None:
    """Room where a folder is, or will be made; None when the system does not say."""
    for place in (folder, *folder.parents):
        try:
            return shutil.disk_usage(place).free
        except FileNotFoundError:
            continue
        except OSError:
            return None
    return None


class DiskWatch:
    """folder: gives the one of now.

    Attributes: free: room in bytes as of the last look, None when it is not known.
    """

    def __init__(self, folder: Callable[[], pathlib.Path]):
        self._folder = folder
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name="disk", daemon=True)
        self.free: int | None = None

    def start(self) -> None:
        """Look now, and every few seconds until stop(); safe to call twice."""
        if self._thread.ident is None:
            self._thread.start()

    def stop(self) -> None:
        """Look no more; does not wait for a look under way."""
        self._ending.set()

    def _run(self) -> None:
        while not self._ending.is_set():
            self.free = free_bytes(self._folder())
            self._ending.wait(PERIOD_S)
