"""Photos of a test: copied beside its record, each with a check sum in it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import hashlib
import logging
import pathlib
import shutil
from typing import Sequence

from mtr_operator.domain.errors import InvalidIdentity, OutputError, UnsafeName
from mtr_operator.domain.identity.file_name import to_file_name
from mtr_operator.domain.identity.identity import MAX_PHOTOS, MAX_TEXT, Photo

from .atomic import checked_size, write_bytes
from .inside import inside, stays_inside

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
        write_bytes(_photo_path(folder, name), content)
        kept.append(Photo(name, hashlib.sha256(content).hexdigest()))
    return tuple(kept)


def copy_photos(photos: Sequence[Photo], source: pathlib.Path, target: pathlib.Path) -> None:
    """Copy archived photos to another folder. OutputError when it fails.

    A photo that is missing, or whose content is not the recorded one, is left out and logged.
    """
    for photo in photos if source != target else ():
        try:
            content = recorded_content(photo, source)
        except (UnsafeName, OutputError) as error:
            logging.warning("Photo not copied: %s", error)
            continue
        try:
            target.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"The photo {photo.name} cannot be copied to {target}: "
                              f"{error.strerror or error}.") from None
        write_bytes(_photo_path(target, photo.name), content)


def recorded_content(photo: Photo, folder: pathlib.Path) -> bytes:
    """Content of an archived photo. OutputError when it cannot be read or differs from the recorded check sum,
    UnsafeName when it would be read from outside the folder."""
    path = _photo_path(folder, photo.name)
    try:
        if checked_size(path) > MAX_BYTES:
            raise OutputError(f"The photo {path} is larger than {MAX_BYTES // 1024 ** 2} MiB.")
        content = path.read_bytes()
    except OSError as error:
        raise OutputError(f"The photo {path} cannot be read: {error.strerror or error}.") from None
    if hashlib.sha256(content).hexdigest() != photo.sha256:
        raise OutputError(f"The photo {path} was changed: its check sum is not the recorded one.")
    return content


def _photo_path(folder: pathlib.Path, name: str) -> pathlib.Path:
    """UnsafeName when it would lie outside the folder of the test."""
    if not stays_inside(folder.parent, folder):
        raise UnsafeName(f"The folder {folder} is refused. It is a link that leads out of {folder.parent}.")
    return inside(folder, name)


def discard_photos(folder: pathlib.Path) -> None:
    """Of a test that has measured nothing."""
    shutil.rmtree(folder, ignore_errors=True)


def _free_name(path: pathlib.Path, taken: set[str]) -> str:
    stem = to_file_name(path.stem, "photo")[:MAX_TEXT - 20]
    # File systems that know no capitals would take two names for one.
    lower = {name.lower() for name in taken}
    tails = ("", *(f"_{number}" for number in range(2, MAX_PHOTOS + 2)))
    names = (f"{stem}{tail}{path.suffix.lower()}" for tail in tails)
    return next(name for name in names if name.lower() not in lower)
