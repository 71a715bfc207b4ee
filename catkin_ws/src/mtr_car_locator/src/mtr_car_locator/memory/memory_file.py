"""File of a process that can be restarted within one start of the robot."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
from typing import Any, Dict, Mapping, Optional

from .remembered import MemoryUnusable


class MemoryFile:
    """Plain data of one run; data of another run are ignored, because the robot may have been moved since."""

    def __init__(self, path: pathlib.Path, run_id: str):
        self._path, self._run_id = path, run_id

    def read(self) -> Optional[Dict[str, Any]]:
        """Return the data written in this run, or None.

        Raises:
            MemoryUnusable: the file exists but cannot be read.
        """
        try:
            document = json.loads(self._path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None
        except (OSError, ValueError) as error:
            raise MemoryUnusable(f"File {self._path} cannot be read ({error}).") from None
        if not isinstance(document, dict) or document.get("run_id") != self._run_id:
            return None
        return document

    def write(self, data: Optional[Mapping[str, Any]]) -> None:
        """Write the file atomically; None removes it.

        Raises:
            MemoryUnusable: the file cannot be written.
        """
        beside = self._path.with_name(self._path.name + ".part")
        try:
            if data is None:
                if self._path.exists():
                    self._path.unlink()
                return
            self._path.parent.mkdir(parents=True, exist_ok=True)
            beside.write_text(json.dumps({"run_id": self._run_id, **data}), encoding="utf-8")
            os.replace(str(beside), str(self._path))
        except OSError as error:
            raise MemoryUnusable(f"File {self._path} cannot be written ({error.strerror}); after a restart the Car "
                                 "will have to be mapped again.") from None
