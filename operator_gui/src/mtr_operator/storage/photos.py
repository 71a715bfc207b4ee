"""Photos of a test: copied beside its record, each with a check sum in it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import hashlib
import pathlib
import shutil
from typing import Sequence

from mtr_operator.domain.errors import InvalidIdentity, OutputError
from mtr_operator.domain.identity.identity import MAX_PHOTOS, MAX_TEXT, Photo

from .atomic import write_bytes

# A photo of a good camera has 20 MB.
MAX_BYTES = 40 * 1024 * 1024
SUFFIXES = (".jpg", ".jpeg", ".png", ".heic", ".webp", ".tif", ".tiff", ".bmp")
_FOLDER = "photos"
_RECORD = "progress"


def photo_folder(path: pathlib.Path) -> pathlib.Path:
    """Folder of the photos of the test with this progress file."""
    return path.with_name(_FOLDER if path.stem == _RECORD else f"{path.stem}.{_FOLDER}")


def check_photos(paths: Sequence[pathlib.Path], kept_count: int = 0) -> None:
    """Raise InvalidIdentity for the first file that is no photo that can be kept. kept_count: how many are already."""
    if kept_count + len(paths) > MAX_PHOTOS:
        raise InvalidIdentity(f"There are {kept_count + len(paths)} photos; at most {MAX_PHOTOS} are kept with a test.")
    for path in paths:
        if path.suffix.lower() not in SUFFIXES:
            raise InvalidIdentity(f"The file {path} is no photo; kept are {', '.join(SUFFIXES)}.")
        try:
            size = path.stat().st_size
        except OSError as error:
            raise InvalidIdentity(f"The photo {path} cannot be read: {error.strerror or error}.") from None
        if not path.is_file() or size > MAX_BYTES:
            raise InvalidIdentity(f"The photo {path} is no file of at most {MAX_BYTES // 1024 ** 2} MiB.")


def keep_photos(paths: Sequence[pathlib.Path], folder: pathlib.Path,
                former: Sequence[Photo] = ()) -> tuple[Photo, ...]:
    """Copy photos into a folder, under their names or with a number behind them; OutputError when that fails.

    former: those that are kept there already; they come first in what is returned.
    """
    check_photos(paths, len(former))
    kept = list(former)
    for path in paths:
        try:
            content = path.read_bytes()
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"The photo {path} cannot be copied: {error.strerror or error}.") from None
        name = _free_name(path, {photo.name for photo in kept})
        write_bytes(folder / name, content)
        kept.append(Photo(name, hashlib.sha256(content).hexdigest()))
    return tuple(kept)


def copy_photos(photos: Sequence[Photo], source: pathlib.Path, target: pathlib.Path) -> None:
    """Copy kept photos to another folder; one that is not there any more is left out. OutputError when it fails."""
    for photo in photos if source != target else ():
        with contextlib.suppress(FileNotFoundError):
            try:
                content = (source / photo.name).read_bytes()
                target.mkdir(parents=True, exist_ok=True)
            except FileNotFoundError:
                raise
            except OSError as error:
                raise OutputError(f"The photo {source / photo.name} cannot be copied: "
                                  f"{error.strerror or error}.") from None
            write_bytes(target / photo.name, content)


def discard_photos(folder: pathlib.Path) -> None:
    """Of a test that has measured nothing."""
    shutil.rmtree(folder, ignore_errors=True)


def _free_name(path: pathlib.Path, taken: set[str]) -> str:
    stem = "".join(letter for letter in path.stem if letter.isprintable())[:MAX_TEXT - 20] or "photo"
    # File systems that know no capitals would take two names for one.
    lower = {name.lower() for name in taken}
    tails = ("", *(f"_{number}" for number in range(2, MAX_PHOTOS + 2)))
    names = (f"{stem}{tail}{path.suffix.lower()}" for tail in tails)
    return next(name for name in names if name.lower() not in lower)
