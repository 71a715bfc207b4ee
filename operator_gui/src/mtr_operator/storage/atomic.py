"""Files that are there completely or not at all, also after a loss of power."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import os
import pathlib
import tempfile

from mtr_operator.domain.errors import OutputError


def prepare_folder(folder: pathlib.Path) -> None:
    """Make the folder and try to write in it, before anything that could be lost exists; OutputError when it fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise OutputError(f"Results cannot be written to the folder {folder}: {_reason(error)}.") from None


def write_bytes(path: pathlib.Path, content: bytes) -> None:
    """Replace the file by one with this content; returns when it is safe. OutputError when it fails."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with open(temporary, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
        _sync_folder(path.parent)
    except OSError as error:
        with contextlib.suppress(OSError):
            temporary.unlink()
        raise OutputError(f"The file {path} cannot be written: {_reason(error)}.") from None


def _sync_folder(folder: pathlib.Path) -> None:
    # Windows has no such thing: there the file system's journal keeps the new name.
    if os.name == "posix":
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _reason(error: OSError) -> str:
    return error.strerror or str(error)
