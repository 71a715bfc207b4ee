"""Content-addressed files: each content is stored once, under its check sum."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import hashlib
import os
import pathlib
import re
import tempfile
from typing import Mapping

from mtr_operator.domain.identity.file_name import shown

from ..errors import StoreAway, StoreError

# A photo of a good camera has 20 MB; larger files, such as recordings, do not belong in the store.
MAX_BYTES = 64 * 1024 * 1024
MAX_FILES = 200
_SHA256 = re.compile("[0-9a-f]{64}")


class KeptFiles:
    """Folder with contents. Concurrent writers are safe, because equal contents have equal names."""

    def __init__(self, folder: pathlib.Path):
        self.folder = folder

    def keep(self, files: Mapping[str, pathlib.Path]) -> list[dict[str, object]]:
        """Store the contents of files and return their rows; StoreAway if that fails."""
        if len(files) > MAX_FILES:
            raise StoreError(f"There are {len(files)} files with the test; at most {MAX_FILES} are kept.")
        return [{"name": name, **self._keep(path)} for name, path in files.items()]

    def path_of(self, sha256: str) -> pathlib.Path:
        """Return the path of a content, whether or not it exists; StoreError for an invalid check sum."""
        if not _SHA256.fullmatch(sha256):
            raise StoreError(f"The store names the content {shown(sha256)}, which is no SHA-256 check sum.")
        return self.folder / sha256[:2] / sha256

    def read(self, sha256: str) -> bytes:
        """Return a content; StoreError if it is missing or modified."""
        try:
            content = self.path_of(sha256).read_bytes()
        except OSError:
            raise StoreError(f"The content {sha256[:12]}... is not in {self.folder}; restore that folder's "
                             "copy.") from None
        if hashlib.sha256(content).hexdigest() != sha256:
            raise StoreError(f"The content {sha256[:12]}... in {self.folder} was changed; restore that folder's copy.")
        return content

    def _keep(self, path: pathlib.Path) -> dict[str, object]:
        try:
            size = path.stat().st_size
            if size > MAX_BYTES:
                raise StoreError(f"The file {path} has {size // 1024 ** 2} MiB; at most {MAX_BYTES // 1024 ** 2} MiB "
                                 "are kept.")
            content = path.read_bytes()
        except OSError as error:
            raise StoreError(f"The file {path} cannot be read: {error.strerror or error}.") from None
        sha256 = hashlib.sha256(content).hexdigest()
        target = self.path_of(sha256)
        if not target.exists():
            self._write(target, content)
        return {"sha256": sha256, "size": len(content)}

    def _write(self, target: pathlib.Path, content: bytes) -> None:
        temporary = ""
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            # Write to a unique temporary name, because another program may be writing the same content.
            with tempfile.NamedTemporaryFile(dir=target.parent, prefix=".", delete=False) as file:
                temporary = file.name
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            os.replace(temporary, target)
        except OSError as error:
            with contextlib.suppress(OSError):
                os.unlink(temporary)
            raise StoreAway(f"The folder {self.folder} of the store's files is away: "
                            f"{error.strerror or error}.") from None
