"""The Car's profile and its databases as a bundle keeps them, beside the progress file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

FOLDER = "car"
_SUFFIX = ".yaml"


def kept_profile(path: pathlib.Path, profile: str) -> str:
    """Of the test with this progress file, whose record names the profile by name or path: the file that was kept with
    it, or the profile as it was named where none was."""
    name = pathlib.PurePath(profile).name
    kept = path.parent / FOLDER / (name if name.endswith(_SUFFIX) else f"{name}{_SUFFIX}")
    return str(kept) if kept.is_file() else profile
