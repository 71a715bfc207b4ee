"""Files that are there completely or not at all, also after a loss of power."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import os
import pathlib
import stat
import tempfile
import time
from typing import Iterator

from mtr_operator.domain.errors import OutputError

# What a test of some hundred lines writes; a disk that has no more room is found before the robot moves.
ROOM_BYTES = 2 * 1024 * 1024
# A second in all.
_REPLACE_ATTEMPTS = 11
_REPLACE_PAUSE_S = 0.1

@contextlib.contextmanager
def output_folder(folder: pathlib.Path) -> Iterator[None]:
    """Context with a folder that can be written in; OutputError when it cannot.

    Folders that were made for it go again when the body fails and has left nothing in them.
    """
    made: list[pathlib.Path] = []
    try:
        try:
            made += [place for place in (folder, *folder.parents) if not place.exists()]
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder) as trial:
                trial.write(bytes(ROOM_BYTES))
                trial.flush()
                os.fsync(trial.fileno())
        except OSError as error:
            raise OutputError(f"Results cannot be written to the folder {folder}: {_reason(error)}.") from None
        yield
    except BaseException:
        for place in made:
            with contextlib.suppress(OSError):
                place.rmdir()
        raise


def write_bytes(path: pathlib.Path, content: bytes) -> None:
    """Replace the file by one with this content; returns when it is safe. OutputError when it fails."""
    # Always the same name: what a killed application has left is overwritten by the next one.
    temporary = path.with_name(f".{path.name}.part")
    try:
        # Never follow a link that somebody has put there under this name.
        temporary.unlink(missing_ok=True)
        with open(temporary, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        _replace(temporary, path)
        sync_folder(path.parent)
    except OSError as error:
        _remove(temporary)
        raise OutputError(f"The file {path} cannot be written: {_reason(error)}.") from None
    except BaseException:
        _remove(temporary)
        raise


def _replace(source: pathlib.Path, target: pathlib.Path) -> None:
    """On Windows a scanner may hold the target open for a moment."""
    for _ in range(_REPLACE_ATTEMPTS - 1):
        with contextlib.suppress(PermissionError):
            os.replace(source, target)
            return
        time.sleep(_REPLACE_PAUSE_S)
    os.replace(source, target)


def _remove(path: pathlib.Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()


def sync_folder(folder: pathlib.Path) -> None:
    """Make the names in a folder safe."""
    # Windows has no such thing: there the file system's journal keeps the new name.
    if os.name == "posix":
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _reason(error: OSError) -> str:
    return error.strerror or str(error)


def checked_size(path: pathlib.Path) -> int:
    """Size in bytes of what is to be read; OSError for a pipe or device, from which reading may never end."""
    found = path.stat()
    if not stat.S_ISREG(found.st_mode) and not stat.S_ISDIR(found.st_mode):
        raise OSError(0, "it is a pipe or a device, and no file")
    return found.st_size
