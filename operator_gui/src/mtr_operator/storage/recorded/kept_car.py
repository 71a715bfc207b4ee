"""The Car's profile and its databases as they were when a test began, beside its progress file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import hashlib
import pathlib
from typing import Mapping

from mtr_operator.domain.errors import OperatorError, OutputError, UnsafeName
from mtr_operator.domain.results.session_record import SUBSTITUTE

from ..atomic import output_folder, write_bytes
from ..inside import inside
from .folders import CAR, car_folder, is_own

_SUFFIX = ".yaml"


def kept_profile(path: pathlib.Path, profile: str) -> str:
    """Of the test with this progress file, whose record names the profile by name or path: the file that was kept with
    it, or the profile as it was named where none was."""
    name = pathlib.PurePath(profile).name
    for folder in (path.parent / CAR, car_folder(path)):
        with contextlib.suppress(UnsafeName, OSError):
            kept = inside(folder, name if name.endswith(_SUFFIX) else f"{name}{_SUFFIX}")
            if kept.is_file() and is_own(path, folder):
                return str(kept)
    return profile


def profile_content(profile: str) -> dict[str, bytes]:
    """Content of a profile and its databases by the names of the files, as they are now.

    Empty without a profile, and for one that is not there or wrong: whoever loads it raises the error.
    """
    from mtr_operator.car_link.profile import profile_files
    if profile in ("", SUBSTITUTE):
        return {}
    try:
        return {file.name: file.read_bytes() for file in profile_files(profile)}
    except (OperatorError, OSError):
        return {}


def digest_text(content: Mapping[str, bytes]) -> str:
    """Each file with its SHA-256, as it stands in a test's record."""
    return ", ".join(f"{name} {hashlib.sha256(each).hexdigest()}" for name, each in content.items())


def keep_car(path: pathlib.Path, profile: str) -> list[pathlib.Path]:
    """Copy profile and databases to the test with this progress file; return the files that were made.

    A file that is there stays: the test was begun with it. OutputError when that fails.
    """
    folder, made = car_folder(path), []
    if not is_own(path, folder):
        raise OutputError(f"The folder {folder} is a link that leads elsewhere; remove it.")
    for name, content in profile_content(profile).items():
        if not (folder / name).exists():
            with output_folder(folder):
                write_bytes(folder / name, content)
            made.append(folder / name)
    return made
