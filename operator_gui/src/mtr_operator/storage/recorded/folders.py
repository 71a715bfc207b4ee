"""Folders beside the progress file of a test: its recording, and the Car's profile as it was when the test began."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from ..inside import stays_inside

CAR = "car"
_FOLDER = "recording"
_RECORD = "progress"


def recording_folder(path: pathlib.Path) -> pathlib.Path:
    """Folder of the recording of the test with this progress file."""
    return path.with_name(_FOLDER if path.stem == _RECORD else f"{path.stem}.{_FOLDER}")


def car_folder(path: pathlib.Path) -> pathlib.Path:
    """Folder in which the test with this progress file keeps profile and databases; a bundle has it beside the file."""
    return recording_folder(path) / CAR


def is_own(path: pathlib.Path, folder: pathlib.Path) -> bool:
    """True when a folder below that of this progress file is reached by no link; also of one that is not there."""
    steps = folder.relative_to(path.parent).parts
    places = [path.parent.joinpath(*steps[:count]) for count in range(1, len(steps) + 1)]
    return all(stays_inside(place.parent, place) for place in places)
