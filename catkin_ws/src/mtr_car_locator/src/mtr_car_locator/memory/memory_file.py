"""A file with which a process that is started again in the same start of the robot goes on."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
from typing import Any, Dict, Mapping, Optional

from .remembered import MemoryUnusable


class MemoryFile:
    """Plain data of one run; those of another one count as none, for the robot may have been anywhere since."""

    def __init__(self, path: pathlib.Path, run_id: str):
        self._path, self._run_id = path, run_id

    def read(self) -> Optional[Dict[str, Any]]:
        """What was written in this run; None for nothing.

        Raises:
            MemoryUnusable: there is a file that cannot be read.
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
        """Write the file whole, or not at all; None removes it.

        Raises:
            MemoryUnusable: that is not possible.
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
