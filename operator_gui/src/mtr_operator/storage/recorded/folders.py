"""Folders beside the progress file of a test: its recording, and the Car's profile as it was when the test began."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

CAR = "car"
_FOLDER = "recording"
_RECORD = "progress"


def recording_folder(path: pathlib.Path) -> pathlib.Path:
    """Folder of the recording of the test with this progress file."""
    return path.with_name(_FOLDER if path.stem == _RECORD else f"{path.stem}.{_FOLDER}")


def car_folder(path: pathlib.Path) -> pathlib.Path:
    """Folder in which the test with this progress file keeps profile and databases; a bundle has it beside the file."""
    return recording_folder(path) / CAR
