"""Writes the evidence of a test into one signed file, NAME.mtr.zip."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import os
import pathlib
from typing import Any, Iterator

from mtr_operator.domain.errors import OperatorError, OutputError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import now, written
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.report.files import FILE_NAMES
from mtr_operator.storage.journal_file import journal_path
from mtr_operator.storage.photos import photo_folder
from mtr_operator.storage.recorded.recording import recording_folder

from .container import SUFFIX, Source, write_container
from .manifest import MANIFEST, SIGNATURE, FileEntry, Manifest, entry_of_path, sha256_of
from .record import SCHEMA, record_of, versions
from .station_key import Link, Station

RECORD = "record.json"
_CAR = "car"


def bundle_path(path: pathlib.Path) -> pathlib.Path:
    """Of the test with this progress file: named as its folder, or as the file where that has a name of its own."""
    name = path.parent.resolve().name if path.stem == "progress" else path.stem
    return path.with_name(f"{name or 'test'}{SUFFIX}")


def write_bundle(target: pathlib.Path, path: pathlib.Path, scenario: AnyScenario, progress: Progress,
                 assessment: Assessment | None, *, profile: str = "", station: Station | None = None) -> Manifest:
    """Bundle of the test with this progress file, whose report is beside it; profile: name or path of the Car's.

    OutputError when it cannot be written: then nothing of it is left, and the chain is as it was.
    """
    station = station or Station()
    sources = _sources(path, scenario, progress, assessment, profile)
    newest = station.newest
    try:
        manifest = Manifest(written(now()), station.name, station.key, 1 if newest is None else newest.number + 1,
                            "" if newest is None else newest.manifest,
                            {name: _entry(source) for name, source in sources.items()})
        content = manifest.content()
        signature = {"algorithm": "Ed25519", "key": station.key, "signature": station.sign(content)}
        _write(target, {MANIFEST: content, SIGNATURE: _json(signature), **sources})
    except OSError as error:
        raise OutputError(f"The bundle {target} cannot be written: {error.strerror or error}.") from None
    station.append(Link(manifest.number, target.name, sha256_of(content)))
    return manifest


def _write(target: pathlib.Path, sources: dict[str, Source]) -> None:
    temporary = target.with_name(f".{target.name}.part")
    try:
        with open(temporary, "wb") as file:
            write_container(file, sources)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _sources(path: pathlib.Path, scenario: AnyScenario, progress: Progress, assessment: Assessment | None,
             profile: str) -> dict[str, Source]:
    record = record_of(scenario, progress, assessment)
    parts = {name: record[name] for name in ("parameters", "limits", "calibration", "identity")
             if record[name] is not None}
    parameters = scenario.parameters_type.from_mapping(progress.parameters)
    plan = [{"number": line.number, "origin_m": [line.ray.origin_x, line.ray.origin_y],
             "direction": [line.ray.direction_x, line.ray.direction_y]}
            for line in scenario.lines(parameters, progress.measured_car)]
    found: dict[str, Source] = {RECORD: _json(record), SCHEMA.name: SCHEMA.read_bytes(), "plan.json": _json(plan),
                                "versions.json": _json(versions())}
    found.update({f"{name}.json": _json(part) for name, part in parts.items()})
    names = (path.name, journal_path(path).name, *FILE_NAMES)
    found.update({name: path.with_name(name) for name in names if path.with_name(name).is_file()})
    for folder, kept in ((recording_folder(path), "recording"), (photo_folder(path), "photos")):
        found.update({f"{kept}/{file.name}": file for file in sorted(folder.glob("*")) if file.is_file()})
    found.update(_profile_files(profile))
    return found


def _profile_files(profile: str) -> Iterator[tuple[str, Source]]:
    """The Car's profile and its database; none of a substitute."""
    from mtr_operator.car_link.profile import profile_files
    try:
        files = profile_files(profile) if profile else ()
    except OperatorError:
        return
    for file in files:
        yield f"{_CAR}/{file.name}", file


def _entry(source: Source) -> FileEntry:
    return FileEntry(len(source), sha256_of(source)) if isinstance(source, bytes) else entry_of_path(source)


def _json(value: Any) -> bytes:
    return (json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode("utf-8")
