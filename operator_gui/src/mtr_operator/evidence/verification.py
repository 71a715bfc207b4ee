"""Verifies a bundle against its signature; truncated and changed files are named."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import json
import pathlib
import tempfile
import zipfile
import zlib
from dataclasses import dataclass, field
from typing import Any, BinaryIO, Callable, Sequence

from mtr_operator.domain.identity.file_name import SEPARATED, name_problem, shown

from .container import copy_container, first_difference, packing_problem
from .manifest import (
    FORMAT,
    MANIFEST,
    MAX_MANIFEST_BYTES,
    SIGNATURE,
    VERSION,
    BadManifest,
    FileEntry,
    Manifest,
    entry_of,
    entry_of_path,
    manifest_from,
    sha256_of,
)
from .station_key import is_signed_by


@dataclass(frozen=True)
class Verification:
    """Result of a verification.

    Attributes:
        manifest: of the bundle, None if it cannot be read. digest: its SHA-256.
        problems: a sentence for each difference from the signed state; empty for an intact bundle.
    """

    manifest: Manifest | None = None
    digest: str = ""
    problems: Sequence[str] = field(default_factory=tuple)

    @property
    def is_intact(self) -> bool:
        """True if all content is as it was signed."""
        return self.manifest is not None and not self.problems


def verify_bundle(path: pathlib.Path) -> Verification:
    """Verify a bundle, or the folder with its unpacked files."""
    if path.is_dir():
        names = [file.relative_to(path).as_posix() for file in sorted(path.rglob("*")) if file.is_file()]
        return _verified(names, lambda name: (path / name).read_bytes(), lambda name: entry_of_path(path / name))
    try:
        with open(path, "rb") as file, zipfile.ZipFile(file) as container:
            problem = packing_problem(container, file)
            if problem:
                return Verification(problems=(problem,))
            found = _verified(container.namelist(), lambda name: _start_of(container, name),
                              lambda name: _member(container, name))
            return found if found.problems else _of_container(found, file, container)
    except OSError as error:
        return Verification(problems=(f"{path} cannot be read: {error.strerror or error}.",))
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, ValueError, RuntimeError, EOFError):
        return Verification(problems=(f"{path} is torn, or no bundle: its list of files cannot be read.",))


def content_problems(path: pathlib.Path, done: Callable[[int], None]) -> Sequence[str]:
    """Return the differences in the files of a bundle that was just written; OSError if it cannot be read.

    done: receives the size of each file after it was read, in bytes.
    """
    with zipfile.ZipFile(path) as container:
        return _verified(container.namelist(), lambda name: _start_of(container, name),
                         lambda name: _member(container, name), done).problems


def is_newer(path: pathlib.Path) -> bool:
    """True for a bundle of a later version of this format, whose manifest cannot be read here."""
    try:
        with zipfile.ZipFile(path) as container:
            return _is_later(_start_of(container, MANIFEST))
    except (OSError, LookupError, zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError):
        return False


def _is_later(content: bytes) -> bool:
    """True for a manifest of a later version of this format."""
    with contextlib.suppress(ValueError, LookupError, TypeError, RecursionError):
        document = json.loads(content)
        return bool(document["format"] == FORMAT and document["version"] > VERSION)
    return False


def chain_problems(found: Sequence[Verification]) -> list[str]:
    """Return problems of the chain among these bundles: gaps, and several bundles of one number."""
    by_key: dict[str, dict[int, dict[str, Manifest]]] = {}
    for each in found:
        if each.manifest is not None:
            numbers = by_key.setdefault(each.manifest.key, {})
            numbers.setdefault(each.manifest.number, {})[each.digest] = each.manifest
    problems = []
    for numbers in by_key.values():
        for number, there in sorted(numbers.items()):
            if len(there) > 1:
                problems.append(f"There are {len(there)} different bundles {number} of the station: one of them was "
                                "made anew.")
            former = numbers.get(number - 1, {})
            if former and any(manifest.before not in former for manifest in there.values()):
                problems.append(f"Bundle {number} of the station does not follow its bundle {number - 1}: one of them "
                                "was made anew.")
    return problems


def _verified(names: Sequence[str], read: Callable[[str], bytes],
              entry: Callable[[str], FileEntry], done: Callable[[int], None] = lambda _: None) -> Verification:
    content = b""
    try:
        content, signature = read(MANIFEST), json.loads(read(SIGNATURE))
        manifest = manifest_from(content)
    except (KeyError, FileNotFoundError):
        return Verification(problems=(f"There is no {MANIFEST} or {SIGNATURE} in it: it is no bundle.",))
    except (BadManifest, ValueError, zipfile.BadZipFile, zlib.error, RecursionError, OSError):
        return Verification(problems=(
            "It was written by a later version of the application." if _is_later(content) else
            f"{MANIFEST} or {SIGNATURE} is changed: it cannot be read any more.",))
    problems = [] if _is_signed(manifest, content, signature) else \
        [f"{MANIFEST} or {SIGNATURE} is changed: the signature is not that of the station's key over it."]
    for name, wanted in manifest.files.items():
        if name not in names:
            problems.append(f"{name} is missing.")
            continue
        # An exception from done ends the verification; it does not belong to the file.
        found = _entry_or_none(entry, name)
        done(wanted.size)
        if found != wanted:
            problems.append(f"{name} is changed.")
    known = {MANIFEST, SIGNATURE, *manifest.files}
    problems += [f"{name} was added." for name in names if name not in known]
    problems += [f"The file name {shown(name)} is refused. {problem}." for name in manifest.files
                 if (problem := _name_problem(name))]
    if len(set(names)) != len(names):
        problems.append("A file is in it twice.")
    return Verification(manifest, sha256_of(content), tuple(problems))


def _name_problem(name: str) -> str:
    """Return the reason why a file must not be unpacked under its name; empty if it may."""
    parts = name.split("/")
    return SEPARATED if "" in parts and name else next(filter(None, map(name_problem, parts)), "")


def _is_signed(manifest: Manifest, content: bytes, signature: Any) -> bool:
    return (isinstance(signature, dict) and signature.get("algorithm") == "Ed25519"
            and signature.get("key") == manifest.key
            and is_signed_by(manifest.key, content, str(signature.get("signature"))))


def _entry_or_none(entry: Callable[[str], FileEntry], name: str) -> FileEntry | None:
    """Return the entry; None for unreadable bytes."""
    try:
        return entry(name)
    except (zipfile.BadZipFile, zlib.error, OSError, NotImplementedError, RuntimeError, EOFError, ValueError):
        return None


def _start_of(container: zipfile.ZipFile, name: str) -> bytes:
    """Return the whole manifest or signature; an overlong one is truncated, and therefore invalid JSON."""
    with container.open(name) as file:
        return file.read(MAX_MANIFEST_BYTES)


def _member(container: zipfile.ZipFile, name: str) -> FileEntry:
    with container.open(name) as file:
        return entry_of(file)  # type: ignore[arg-type]  # typeshed's IO[bytes] is a BinaryIO here


def _of_container(found: Verification, file: BinaryIO, container: zipfile.ZipFile) -> Verification:
    """Compare the bytes between the files with a new container, after the files were verified."""
    with tempfile.TemporaryFile() as copy:
        copy_container(container, container.namelist(), copy)
        copy.seek(0)
        file.seek(0)
        place = first_difference(file, copy)
    if place is None:
        return found
    return Verification(found.manifest, found.digest, (
        f"The files are as they were signed, but the zip around them is not as it was written, from byte {place} on: "
        "it was packed anew, or a byte between the files is changed.",))
