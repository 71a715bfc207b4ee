"""Temporary folder with the files of a bundle."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
import tempfile
import zipfile
from typing import Iterator

from mtr_operator.domain.errors import OperatorError

from .container import SUFFIX, unpack
from .verification import verify_bundle


class NotIntact(OperatorError):
    """The bundle differs from its signed state; the text names the changes."""


@contextlib.contextmanager
def unpacked(path: pathlib.Path) -> Iterator[pathlib.Path]:
    """Folder of an intact bundle's files; any other path is returned unchanged."""
    if not path.name.endswith(SUFFIX) or not path.is_file():
        yield path
        return
    problems = verify_bundle(path).problems
    if problems:
        raise NotIntact(f"{path} is not as it was signed, and nothing is computed from it: {problems[0]}")
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(path) as container:
            unpack(container, pathlib.Path(folder))
        yield pathlib.Path(folder)
