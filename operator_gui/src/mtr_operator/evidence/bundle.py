"""Writes the evidence of a test into one signed file, NAME.mtr.zip."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import pathlib
from typing import Callable, Mapping

from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import now, written
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment

from .container import SUFFIX, Source, size_of, write_container
from .contents import Tested, as_json, contents_of
from .manifest import MANIFEST, SIGNATURE, FileEntry, Manifest, entry_of_path, sha256_of
from .station_key import Link, Station


def bundle_path(path: pathlib.Path) -> pathlib.Path:
    """Of the test with this progress file: named as its folder, or as the file where that has a name of its own."""
    name = path.parent.resolve().name if path.stem == "progress" else path.stem
    return path.with_name(f"{name or 'test'}{SUFFIX}")


class BundleWatch:
    """Who is told while a bundle is written; this one keeps nothing."""

    def left_out(self, name: str, reason: str) -> None:
        """A file is missing in the bundle, for the reason of a sentence."""

    def done(self, share: float) -> None:
        """How much of it is done, 0 to 1. What is raised here ends the writing, and nothing of the bundle is left."""


def write_bundle(target: pathlib.Path, path: pathlib.Path, scenario: AnyScenario, progress: Progress,
                 assessment: Assessment | None, *, profile: str = "", station: Station | None = None,
                 watch: BundleWatch | None = None) -> Manifest:
    """Bundle of the test with this progress file; profile: name or path of the Car's. Its report is made anew.

    OutputError when it cannot be written: then nothing of it is left, and the chain is as it was.
    """
    station, watch = station or Station(), watch or BundleWatch()
    contents = contents_of(Tested(path, scenario, progress, assessment, profile), station.name)
    for name, reason in contents.left_out.items():
        watch.left_out(name, reason)
    with station.signing():
        return _signed(target, contents.sources, station, watch)


def _signed(target: pathlib.Path, sources: Mapping[str, Source], station: Station, watch: BundleWatch) -> Manifest:
    newest = station.newest
    try:
        # Each byte is read twice: for its manifest, and for the container.
        half = _Half(watch.done, sum(map(size_of, sources.values())))
        manifest = Manifest(written(now()), station.name, station.key, 1 if newest is None else newest.number + 1,
                            "" if newest is None else newest.manifest,
                            {name: _entry(source, half) for name, source in sources.items()})
        content = manifest.content()
        signature = {"algorithm": "Ed25519", "key": station.key, "signature": station.sign(content)}
        _write(target, {MANIFEST: content, SIGNATURE: as_json(signature), **sources}, half)
    except OSError as error:
        raise OutputError(f"The bundle {target} cannot be written: {error.strerror or error}.") from None
    try:
        station.append(Link(manifest.number, target.name, sha256_of(content)))
    except OutputError:
        # The next bundle would have its number, too.
        target.unlink(missing_ok=True)
        raise
    return manifest


class _Half:
    """Counts the bytes that have been read, each of them twice."""

    def __init__(self, told: Callable[[float], None], size: int):
        self._told = told
        self._whole = max(2 * size, 1)
        self._read = 0

    def read(self, size: int) -> None:
        self._read += size
        self._told(min(self._read / self._whole, 1.0))


def _write(target: pathlib.Path, sources: Mapping[str, Source], half: _Half) -> None:
    temporary = target.with_name(f".{target.name}.part")
    try:
        with open(temporary, "wb") as file:
            write_container(file, sources, half.read)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _entry(source: Source, half: _Half) -> FileEntry:
    entry = FileEntry(len(source), sha256_of(source)) if isinstance(source, bytes) else entry_of_path(source)
    half.read(entry.size)
    return entry
