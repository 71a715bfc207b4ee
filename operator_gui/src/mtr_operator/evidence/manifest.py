"""Manifest of a bundle: each file with its size and SHA-256, signer and date, and the previous bundle."""
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
# About 100,000 files; a longer file is not a manifest, and is not read into memory.
MAX_MANIFEST_BYTES = 16 * 1024 * 1024
_BLOCK = 1024 * 1024
# Keys and digests: 32 bytes.
_DIGEST = re.compile(r"[0-9a-f]{64}\Z")
# Upper bound of sizes and bundle numbers.
_MOST = 2 ** 63


class BadManifest(Exception):
    """The text is not a manifest of this version."""


@dataclass(frozen=True)
class FileEntry:
    """Entry of a file. sha256: hexadecimal."""

    size: int
    sha256: str


@dataclass(frozen=True)
class Manifest:
    """Manifest. created: ISO 8601. station, key: of the signer. number, before: position in the chain; before is the
    SHA-256 of the previous manifest, empty for the first one. files: by their paths in the bundle."""

    created: str
    station: str
    key: str
    number: int
    before: str
    files: Mapping[str, FileEntry]

    def content(self) -> bytes:
        """Return the signed bytes."""
        files = {name: {"size": entry.size, "sha256": entry.sha256} for name, entry in sorted(self.files.items())}
        document = {"format": FORMAT, "version": VERSION, "created": self.created, "station": self.station,
                    "key": self.key, "number": self.number, "before": self.before, "files": files}
        return (json.dumps(document, indent=1, ensure_ascii=False) + "\n").encode("utf-8")


def manifest_from(content: bytes) -> Manifest:
    """Return the manifest in a file; BadManifest if it is invalid."""
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
        # The station is a foreign text that is printed.
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
    """Return the digest, hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def entry_of(file: BinaryIO) -> FileEntry:
    """Return the entry of a file from its current position to its end."""
    return copied_entry(file, lambda _: None)


def copied_entry(file: BinaryIO, write: Callable[[bytes], object]) -> FileEntry:
    """Pass a file, from its current position to its end, to write; return the entry of the passed bytes."""
    digest, size = hashlib.sha256(), 0
    while block := file.read(_BLOCK):
        write(block)
        digest.update(block)
        size += len(block)
    return FileEntry(size, digest.hexdigest())


def entry_of_path(path: pathlib.Path) -> FileEntry:
    """Return the entry of a file; OSError if it cannot be read."""
    with open(path, "rb") as file:
        return entry_of(file)
