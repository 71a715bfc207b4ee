"""Writes the evidence of a test into one signed file, NAME.mtr.zip."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import pathlib
from typing import BinaryIO, Callable, Mapping

from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import now, written
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.storage.lock import at_rest
from mtr_operator.storage.store import check_newest

from .container import SUFFIX, Source, size_of, write_container
from .contents import Tested, as_json, contents_of
from .manifest import MANIFEST, SIGNATURE, FileEntry, Manifest, sha256_of
from .station_key import Link, Station
from .verification import content_problems


def bundle_path(path: pathlib.Path) -> pathlib.Path:
    """Return the path of a test's bundle: named like its folder, or like its progress file if that has its own name."""
    name = path.parent.resolve().name if path.stem == "progress" else path.stem
    return path.with_name(f"{name or 'test'}{SUFFIX}")


class BundleWatch:
    """Observer of a bundle being written; this one ignores the calls."""

    def left_out(self, name: str, reason: str) -> None:
        """Report a file that is missing in the bundle, with the reason as a sentence."""

    def done(self, share: float) -> None:
        """Report the progress, 0 to 1. An exception raised here ends the writing, and the incomplete bundle is
        removed."""


def write_bundle(target: pathlib.Path, path: pathlib.Path, scenario: AnyScenario, progress: Progress,
                 assessment: Assessment | None, *, profile: str = "", station: Station | None = None,
                 watch: BundleWatch | None = None) -> Manifest:
    """Write the bundle of the test with this progress file, with a new report. profile: name or path of the Car's.

    InUse if an application is measuring the test, or has measured more of it than this progress contains. OutputError
    if the bundle cannot be written: it is then removed, and the chain is unchanged.
    """
    station, watch = station or Station(), watch or BundleWatch()
    with at_rest(path):
        check_newest(path, progress)
        contents = contents_of(Tested(path, scenario, progress, assessment, profile), station.name)
        for name, reason in contents.left_out.items():
            watch.left_out(name, reason)
        with station.signing():
            return _signed(target, contents.sources, station, watch)


def _signed(target: pathlib.Path, sources: Mapping[str, Source], station: Station, watch: BundleWatch) -> Manifest:
    try:
        # Each byte is read twice: for writing and for verification.
        half = _Half(watch.done, sum(map(size_of, sources.values())))
        manifest = _written(target, sources, station, half)
    except OSError as error:
        raise OutputError(f"The bundle {target} cannot be written: {error.strerror or error}.") from None
    try:
        station.append(Link(manifest.number, target.name, sha256_of(manifest.content())))
    except OutputError:
        # Otherwise the next bundle would have the same number.
        target.unlink(missing_ok=True)
        raise
    return manifest


class _Half:
    """Counter of read bytes, which counts each of them twice."""

    def __init__(self, told: Callable[[float], None], size: int):
        self._told = told
        self._whole = max(2 * size, 1)
        self._read = 0

    def read(self, size: int) -> None:
        self._read += size
        self._told(min(self._read / self._whole, 1.0))


def _written(target: pathlib.Path, sources: Mapping[str, Source], station: Station, half: _Half) -> Manifest:
    """Write the bundle, and move it to its place after all of it was verified against the signature."""
    temporary = target.with_name(f".{target.name}.part")
    try:
        with open(temporary, "wb") as file:
            manifest = _write(file, sources, station, half)
            file.flush()
            os.fsync(file.fileno())
        problems = content_problems(temporary, half.read)
        if problems:
            raise OutputError(f"The bundle {target} was not written as it was signed: {problems[0]} Check the disk, "
                              "and write it again.")
        os.replace(temporary, target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    return manifest


def _write(file: BinaryIO, sources: Mapping[str, Source], station: Station, half: _Half) -> Manifest:
    """Write the files; the manifest is last, because it contains the digests of the written files."""
    newest = station.newest
    number, before = (1, "") if newest is None else (newest.number + 1, newest.manifest)
    manifests: list[Manifest] = []

    def signed(entries: Mapping[str, FileEntry]) -> dict[str, bytes]:
        manifests.append(Manifest(written(now()), station.name, station.key, number, before, entries))
        content = manifests[0].content()
        signature = {"algorithm": "Ed25519", "key": station.key, "signature": station.sign(content)}
        return {MANIFEST: content, SIGNATURE: as_json(signature)}

    write_container(file, sources, half.read, signed)
    return manifests[0]
