"""Collects the content of a bundle: all available files, and the reasons for missing ones."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import logging
import pathlib
from typing import Any, Callable, Mapping, NamedTuple

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.identity.file_name import name_problem, shown, to_file_name
from mtr_operator.domain.identity.identity import NOBODY
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import CAR_PROFILE_FILES, SUBSTITUTE
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.report.assessed import assess
from mtr_operator.report.files import report_files
from mtr_operator.storage.inside import stays_inside
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.photos import photo_folder, recorded_content
from mtr_operator.storage.recorded.folders import CAR as CAR_FOLDER
from mtr_operator.storage.recorded.folders import car_folder, is_own
from mtr_operator.storage.recorded.kept_car import digest_text
from mtr_operator.storage.recorded.recording import RecordedRun, recorded_runs, recording_folder
from mtr_operator.storage.recorded.scan_file import read_scans

from .adapters.junit import junit_of
from .adapters.mcap_file import mcap_of
from .adapters.ods import ods_of
from .adapters.openhtf import openhtf_of
from .adapters.parquet import parquet_of
from .adapters.tables import poses_table, results_table
from .container import Source
from .record import SCHEMA, record_of, versions

RECORD = "record.json"
RESULTS_TABLE, POSES_TABLE = "results.parquet", "poses.parquet"
# Written only if files are missing: the reasons by name of the missing file.
LEFT_OUT = "left_out.json"
# Maximum characters of an error text.
_MAX_SAID = 300


class Tested(NamedTuple):
    """Test with its progress file. profile: of the Car, by name or path, as in the record."""

    path: pathlib.Path
    scenario: AnyScenario
    progress: Progress
    assessment: Assessment | None
    profile: str


class Contents:
    """Content of a bundle. Attributes: sources: of the files by their paths in the bundle. left_out: a sentence for
    each missing file."""

    def __init__(self) -> None:
        self.sources: dict[str, Source] = {}
        self.left_out: dict[str, str] = {}

    def add(self, name: str, make: Callable[[], Source]) -> None:
        """Add a file; if it cannot be created, record the reason, and continue with the others."""
        try:
            self.sources[name] = make()
        except OperatorError as error:
            self.left_out[name] = str(error)
        # A faulty picture must not lose the evidence of the whole test.
        except Exception as error:
            logging.exception("Part %s of a bundle was not made because of a defect of the application.", name)
            self.left_out[name] = f"It cannot be made: {type(error).__name__}: {str(error)[:_MAX_SAID]}"


def contents_of(test: Tested, station: str) -> Contents:
    """Return all content of a test's bundle; station: signer."""
    path, scenario, progress, assessment, _ = test
    found, record = Contents(), record_of(scenario, progress, assessment)
    found.sources.update(_of_record(scenario, progress, record))
    _add_report(found, test)
    _add_files(found, path)
    _check_photos(found, test)
    _add_profile(found, test)
    runs = recorded_runs(recording_folder(path))
    for run in runs:
        _add_course(found, run)
    found.add(RESULTS_TABLE, lambda: parquet_of(results_table(scenario, progress, assessment)))
    if runs:
        found.add(POSES_TABLE, lambda: parquet_of(poses_table([run.course for run in runs])))
    for name, adapt in _adapters(record, station).items():
        found.add(name, adapt)
    if found.left_out:
        found.sources[LEFT_OUT] = as_json(found.left_out)
    return found


def _of_record(scenario: AnyScenario, progress: Progress, record: Mapping[str, Any]) -> dict[str, Source]:
    parts = {name: record[name] for name in ("parameters", "limits", "calibration", "identity")
             if record[name] is not None}
    parameters = scenario.parameters_type.from_mapping(progress.parameters)
    plan = [{"number": line.number, "origin_m": [line.ray.origin_x, line.ray.origin_y],
             "direction": [line.ray.direction_x, line.ray.direction_y]}
            for line in scenario.lines(parameters, progress.measured_car)]
    return {RECORD: as_json(record), SCHEMA.name: SCHEMA.read_bytes(), "plan.json": as_json(plan),
            "versions.json": as_json(versions()),
            **{f"{name}.json": as_json(part) for name, part in parts.items()}}


def _add_report(found: Contents, test: Tested) -> None:
    """Add the report, created from the signed progress: a report on disk may be outdated or modified."""
    scenario, progress = test.scenario, test.progress
    parameters = scenario.parameters_type.from_mapping(progress.parameters)
    assessment = test.assessment or assess(scenario, parameters, progress)
    for name, make in report_files(scenario, parameters, progress, assessment).items():
        found.add(name, make)


def _add_files(found: Contents, path: pathlib.Path) -> None:
    """Add findings, recording, photos and archived profile from the disk. Links to other folders are not followed."""
    found.sources.update({file.name: file for file in (path,) if file.is_file()})
    _add_own(found, journal_path(path), "")
    for folder, kept in ((recording_folder(path), "recording"), (photo_folder(path), "photos"),
                         (car_folder(path), CAR_FOLDER)):
        if not is_own(path, folder):
            found.left_out[kept] = f"The folder {folder} is a link that leads elsewhere."
            continue
        for file in sorted(folder.glob("*")):
            _add_own(found, file, f"{kept}/")


def _add_own(found: Contents, file: pathlib.Path, prefix: str) -> None:
    """Add a file of the test's own folder, if it exists."""
    problem = name_problem(file.name)
    if problem:
        found.left_out[f"{prefix}{shown(file.name)}"] = f"The file name {shown(file.name)} is refused. {problem}."
    elif not stays_inside(file.parent, file):
        found.left_out[f"{prefix}{file.name}"] = f"The file {file} is a link that leads elsewhere."
    elif file.is_file():
        found.sources[f"{prefix}{file.name}"] = file


def _check_photos(found: Contents, test: Tested) -> None:
    """Omit photos whose content differs from the recorded digest."""
    identity = test.progress.identity or NOBODY
    for photo in identity.photos:
        name = f"photos/{photo.name}"
        if name in found.sources:
            try:
                recorded_content(photo, photo_folder(test.path))
            except OperatorError as error:
                del found.sources[name]
                found.left_out[name] = str(error)


def _add_profile(found: Contents, test: Tested) -> None:
    """Add the Car's profile and its databases as archived at the start of the test; for older tests, the current ones.

    The record may come from a third party: only profiles and CAN databases are added.
    """
    from mtr_operator.car_link.profile import bundled_files
    profile, recorded = test.profile, test.progress.session.get(CAR_PROFILE_FILES, "").split(", ")
    if profile in ("", SUBSTITUTE) or any(name.startswith(f"{CAR_FOLDER}/") for name in found.sources):
        return
    try:
        files, left_out = bundled_files(profile)
    except OperatorError as error:
        files, left_out = {}, {to_file_name(pathlib.PurePath(profile).name, "profile"): str(error)}
    for name, file in files.items():
        if recorded != [""] and digest_text({file.name: file.read_bytes()}) not in recorded:
            left_out[name] = f"The file {file} has changed since the test was begun."
        else:
            found.sources[f"{CAR_FOLDER}/{name}"] = file
    found.left_out.update({f"{CAR_FOLDER}/{name}": reason for name, reason in left_out.items()})


def _add_course(found: Contents, run: RecordedRun) -> None:
    """Add the course as MCAP; a damaged course is bundled only in its original form."""
    scans = []
    if run.scans is not None:
        try:
            scans = list(read_scans(run.scans))
        except OperatorError as error:
            found.left_out[f"/lidar/points of recording/{run.course.stem}.mcap"] = str(error)
    found.add(f"recording/{run.course.stem}.mcap", lambda: mcap_of(run.course, scans))


def _adapters(record: Mapping[str, Any], station: str) -> dict[str, Callable[[], Source]]:
    """Return functions that create the record for other tools."""
    return {"adapters/openhtf.json": lambda: as_json(openhtf_of(record, station)),
            "adapters/junit.xml": lambda: junit_of(record, station),
            "adapters/ods.json": lambda: as_json(ods_of(record, station))}


def as_json(value: Any) -> bytes:
    """Return a file of a bundle."""
    return (json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode("utf-8")
