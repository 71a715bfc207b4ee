"""Comparison of two documents of one test. A later version of the program writes more fields and other defaults."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import json
import pathlib
import zlib
from typing import Any, Mapping

from mtr_operator.domain.results.progress import Progress
from mtr_operator.storage.recovery import progress_path


def own_document(path: pathlib.Path, progress: Progress) -> Mapping[str, Any] | None:
    """Return the contents of the progress file at a path, or None if the test reaches farther than the file.

    Fields that the program fills with its defaults are not included.
    """
    with contextlib.suppress(OSError, ValueError, LookupError, TypeError, AttributeError):
        document: Any = json.loads(progress_path(path).read_bytes())
        entries = document["journal"]["entries"] if "journal" in document else None
        if isinstance(document, dict) and entries == (None if progress.kept is None else progress.kept.entries):
            return document
    return None


def states_the_same(own: Mapping[str, Any], stored: bytes) -> bool:
    """Return True if a document and the compressed one of the store agree in every field that both have.

    A field that only one document has is a default of the version that wrote it. Lists must have the same length. The
    record of the session has no defaults.
    """
    there = json.loads(zlib.decompress(stored))
    return own.get("session") == there.get("session") and _agree(own, there)


def _agree(one: Any, other: Any) -> bool:
    if isinstance(one, dict) and isinstance(other, dict):
        return all(_agree(value, other[name]) for name, value in one.items() if name in other)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_agree, one, other))
    return bool(one == other)
