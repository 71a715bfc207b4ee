"""File of a bundle: a zip whose bytes depend only on its content, so that any changed byte is detected."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import io
import pathlib
import shutil
import zipfile
from typing import BinaryIO, Callable, Iterable, Mapping, Union

from mtr_operator.storage.inside import below

from .manifest import FileEntry, copied_entry

SUFFIX = ".mtr.zip"
# It contains no time of writing and no computer data; nothing is compressed, because logs and pictures already are.
_DATE = (1980, 1, 1, 0, 0, 0)
_UNIX, _MODE = 3, 0o100644 << 16
_VERSION = 20
_BLOCK = 1024 * 1024

Source = Union[bytes, pathlib.Path]


def size_of(source: Source) -> int:
    """Return the size in bytes; OSError if a file is missing."""
    return len(source) if isinstance(source, bytes) else source.stat().st_size


def write_container(file: BinaryIO, sources: Mapping[str, Source], done: Callable[[int], None] = lambda _: None,
                    last: Callable[[Mapping[str, FileEntry]], Mapping[str, bytes]] = lambda _: {}) -> None:
    """Write a zip of these files, by their paths in it; OSError if one cannot be read or written.

    done: receives the size of each file after it was written. last: returns the final files from the size and digest of
    the written ones.
    """
    entries: dict[str, FileEntry] = {}
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as container:
        for name, source in sources.items():
            entries[name] = _add(container, name, source)
            done(entries[name].size)
        for name, content in last(entries).items():
            _add(container, name, content)


def _add(container: zipfile.ZipFile, name: str, source: Source) -> FileEntry:
    """Add a file. The source is read once, so that concurrent writing cannot make digest and content differ."""
    with contextlib.closing(_opened(source)) as read, container.open(_info(name, size_of(source)), "w") as target:
        return copied_entry(read, target.write)


def _opened(source: Source) -> BinaryIO:
    return io.BytesIO(source) if isinstance(source, bytes) else open(source, "rb")


def copy_container(container: zipfile.ZipFile, names: Iterable[str], file: BinaryIO) -> None:
    """Write the same files to a new container."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as copy:
        for name in names:
            info = _info(name, container.getinfo(name).file_size)
            with container.open(name) as source, copy.open(info, "w") as target:
                shutil.copyfileobj(source, target, _BLOCK)


def unpack(container: zipfile.ZipFile, folder: pathlib.Path) -> None:
    """Write all files to a folder; UnsafeName, before any file is written, if one would be outside it. OSError if one
    cannot be written."""
    for name, target in [(name, below(folder, name)) for name in container.namelist()]:
        target.parent.mkdir(parents=True, exist_ok=True)
        with container.open(name) as source, open(target, "xb") as copy:
            shutil.copyfileobj(source, copy, _BLOCK)


def packing_problem(container: zipfile.ZipFile, file: BinaryIO) -> str:
    """Return why the container must not be read: compressed or repeated entries of some kB may exceed a disk. Empty for
    a container as written here. file: of the container."""
    members = container.infolist()
    packed = next((member.filename for member in members
                   if member.compress_type != zipfile.ZIP_STORED or member.compress_size != member.file_size), None)
    if packed is not None:
        return f"{packed} is compressed, as no file of a bundle is: it was packed anew; nothing of it was read."
    if sum(member.file_size for member in members) > file.seek(0, io.SEEK_END):
        return "Its files are larger together than it is: it is no bundle; nothing of it was read."
    return ""


def _info(name: str, size: int) -> zipfile.ZipInfo:
    info = zipfile.ZipInfo(name, _DATE)
    info.create_system, info.create_version, info.extract_version = _UNIX, _VERSION, _VERSION
    info.external_attr, info.file_size = _MODE, size
    return info


def first_difference(first: BinaryIO, second: BinaryIO) -> int | None:
    """Return the position of the first differing byte, from the current positions; None if the files are equal."""
    place = 0
    while True:
        a, b = first.read(_BLOCK), second.read(_BLOCK)
        if a != b:
            return place + next((index for index, pair in enumerate(zip(a, b)) if pair[0] != pair[1]),
                                min(len(a), len(b)))
        if not a:
            return None
        place += len(a)
