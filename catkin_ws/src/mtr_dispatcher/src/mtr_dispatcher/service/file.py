"""The file in which the robot stores that it is in service mode."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_proto.keys import LinkKeyError, private_folder, write_private

from .. import problems

FOLDER_NAME = "mtr_service"
FILE_NAME = "service_mode.json"
_KEY = "service_mode"
# The robot's own file has some 25 bytes.
_MAX_BYTES = 1000


class ServiceFile:
    """Outlives the robot's software; a file that cannot be read counts as service mode."""

    def __init__(self, folder: pathlib.Path):
        self._path = folder / FILE_NAME

    def recall(self) -> Problem:
        """Why the robot starts in service mode; no problem when it does not."""
        try:
            with open(self._path, encoding="utf-8") as file:
                return recalled(json.loads(file.read(_MAX_BYTES)))
        except FileNotFoundError:
            return NO_PROBLEM
        except (OSError, ValueError, RecursionError) as error:
            return problems.SERVICE_UNREADABLE(why=f"{self._path}: {error}".rstrip("."))

    def remember(self, is_active: bool) -> None:
        """Replace the file; returns when it is safe. Raises OSError."""
        try:
            private_folder(self._path.parent)
        except LinkKeyError as error:
            raise OSError(str(error)) from None
        write_private(self._path, json.dumps({_KEY: is_active}) + "\n")


def recalled(stored: object) -> Problem:
    """The same of what was stored; anything but a clear no counts as service mode."""
    is_active = stored.get(_KEY) if isinstance(stored, dict) else None
    if is_active is False:
        return NO_PROBLEM
    return problems.SERVICE_RESTORED() if is_active is True else problems.SERVICE_UNREADABLE(why=f"{stored!r:.60}")
