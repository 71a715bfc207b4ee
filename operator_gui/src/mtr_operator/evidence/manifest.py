"""The manifest of a bundle: each file with its size and SHA-256, who signed when, and the bundle before."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import hashlib
import json
import pathlib
import re
from dataclasses import dataclass
from typing import Any, BinaryIO, Callable, Mapping, TypeVar

from mtr_operator.domain.results.document import shown_text

Kind = TypeVar("Kind")

FORMAT, VERSION = "mtr evidence bundle", 1
MANIFEST, SIGNATURE = "manifest.json", "manifest.sig"
# Some 100,000 files; what is longer is no manifest, and nobody keeps it in memory.
MAX_MANIFEST_BYTES = 16 * 1024 * 1024
_BLOCK = 1024 * 1024
# Keys and digests: 32 bytes.
_DIGEST = re.compile(r"[0-9a-f]{64}\Z")
# Sizes and numbers of bundles stay below.
_MOST = 2 ** 63


class BadManifest(Exception):
    """The text is not a manifest of this version."""


@dataclass(frozen=True)
class FileEntry:
    """sha256: hexadecimal."""

    size: int
    sha256: str


@dataclass(frozen=True)
class Manifest:
    """created: ISO 8601. station, key: who signed. number, before: place in the chain; before is the SHA-256 of the
    manifest before, empty for the first one. files: by their paths in the bundle."""

    created: str
    station: str
    key: str
    number: int
    before: str
    files: Mapping[str, FileEntry]

    def content(self) -> bytes:
        """As it is signed."""
        files = {name: {"size": entry.size, "sha256": entry.sha256} for name, entry in sorted(self.files.items())}
        document = {"format": FORMAT, "version": VERSION, "created": self.created, "station": self.station,
                    "key": self.key, "number": self.number, "before": self.before, "files": files}
        return (json.dumps(document, indent=1, ensure_ascii=False) + "\n").encode("utf-8")


def manifest_from(content: bytes) -> Manifest:
    """Manifest in a file; BadManifest when it is none."""
    try:
        document: Any = json.loads(content)
        if (document["format"], document["version"]) != (FORMAT, VERSION):
            raise BadManifest
        files = {_checked(name, str): FileEntry(_count(entry["size"]), _checked(entry["sha256"], str))
                 for name, entry in document["files"].items()}
        created, key, before = (_checked(document[name], str) for name in ("created", "key", "before"))
        datetime.datetime.fromisoformat(created)
        if not (_DIGEST.match(key) and _DIGEST.match(before or key)):
            raise BadManifest
        # The station is a text of whoever signed, and is printed.
        return Manifest(created, shown_text(_checked(document["station"], str)), key, _count(document["number"]),
                        before, files)
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        raise BadManifest from None


def _checked(value: Any, kind: type[Kind]) -> Kind:
    if type(value) is not kind:
        raise BadManifest
    return value


def _count(value: Any) -> int:
    if not 0 <= _checked(value, int) < _MOST:
        raise BadManifest
    return int(value)


def sha256_of(content: bytes) -> str:
    """Hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def entry_of(file: BinaryIO) -> FileEntry:
    """Of a file from where it stands to its end."""
    return copied_entry(file, lambda _: None)


def copied_entry(file: BinaryIO, write: Callable[[bytes], object]) -> FileEntry:
    """Pass a file, from where it stands to its end, to write; return the entry of the passed bytes."""
    digest, size = hashlib.sha256(), 0
    while block := file.read(_BLOCK):
        write(block)
        digest.update(block)
        size += len(block)
    return FileEntry(size, digest.hexdigest())


def entry_of_path(path: pathlib.Path) -> FileEntry:
    """Of a file; OSError when it cannot be read."""
    with open(path, "rb") as file:
        return entry_of(file)
