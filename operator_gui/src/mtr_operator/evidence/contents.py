"""What goes into a bundle: every file that is there, and why one is not."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import pathlib
from typing import Any, Callable, Mapping, NamedTuple

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import CAR_PROFILE_FILES, SUBSTITUTE
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.report.assessed import assess
from mtr_operator.report.files import report_files
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.photos import photo_folder
from mtr_operator.storage.recorded.kept_car import FOLDER as CAR_FOLDER
from mtr_operator.storage.recorded.kept_car import car_folder, digest_text
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
# Only where something is left out: why, by the name of what is missing.
LEFT_OUT = "left_out.json"


class Tested(NamedTuple):
    """A test with its progress file. profile: of the Car, by name or path, as the record has it."""

    path: pathlib.Path
    scenario: AnyScenario
    progress: Progress
    assessment: Assessment | None
    profile: str


class Contents:
    """Attributes: sources: of the files by their paths in the bundle. left_out: a sentence for each that is missing."""

    def __init__(self) -> None:
        self.sources: dict[str, Source] = {}
        self.left_out: dict[str, str] = {}

    def add(self, name: str, make: Callable[[], Source]) -> None:
        """A file; when it cannot be made it is left out."""
        try:
            self.sources[name] = make()
        except OperatorError as error:
            self.left_out[name] = str(error)


def contents_of(test: Tested, station: str) -> Contents:
    """All of a test that a bundle holds; station: who signs it."""
    path, scenario, progress, assessment, profile = test
    found, record = Contents(), record_of(scenario, progress, assessment)
    found.sources.update(_of_record(scenario, progress, record))
    _add_report(found, test)
    _add_files(found, path)
    _add_profile(found, test)
    runs = recorded_runs(recording_folder(path))
    for run in runs:
        _add_course(found, run)
    found.add(RESULTS_TABLE, lambda: parquet_of(results_table(scenario, progress, assessment)))
    if runs:
        found.add(POSES_TABLE, lambda: parquet_of(poses_table([run.course for run in runs])))
    found.sources.update(_adapted(record, station))
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
    """Made from the progress that is signed: a report on disk may be an older one, or say anything."""
    scenario, progress = test.scenario, test.progress
    parameters = scenario.parameters_type.from_mapping(progress.parameters)
    assessment = test.assessment or assess(scenario, parameters, progress)
    for name, make in report_files(scenario, parameters, progress, assessment).items():
        found.add(name, make)


def _add_files(found: Contents, path: pathlib.Path) -> None:
    """Findings, recording and photos, as they are on disk."""
    found.sources.update({file.name: file for file in (path, journal_path(path)) if file.is_file()})
    for folder, kept in ((recording_folder(path), "recording"), (photo_folder(path), "photos")):
        found.sources.update({f"{kept}/{file.name}": file for file in sorted(folder.glob("*")) if file.is_file()})


def _add_profile(found: Contents, test: Tested) -> None:
    """The Car's profile and its databases as they were kept when the test began; of an older test, as they are now."""
    from mtr_operator.car_link.profile import profile_files
    kept = [file for file in sorted(car_folder(test.path).glob("*")) if file.is_file()]
    if kept:
        found.sources.update({f"{CAR_FOLDER}/{file.name}": file for file in kept})
        return
    profile, recorded = test.profile, test.progress.session.get(CAR_PROFILE_FILES, "").split(", ")
    try:
        files = () if profile in ("", SUBSTITUTE) else profile_files(profile)
    except OperatorError as error:
        found.left_out[f"{CAR_FOLDER}/{pathlib.Path(profile).name}"] = str(error)
        return
    for file in files:
        name = f"{CAR_FOLDER}/{file.name}"
        if not file.is_file():
            found.left_out[name] = f"The file {file} is not there any more."
        elif recorded != [""] and digest_text({file.name: file.read_bytes()}) not in recorded:
            found.left_out[name] = f"The file {file} has changed since the test was begun."
        else:
            found.sources[name] = file


def _add_course(found: Contents, run: RecordedRun) -> None:
    """As MCAP; what is damaged is bundled as it is, alone."""
    scans = []
    if run.scans is not None:
        try:
            scans = list(read_scans(run.scans))
        except OperatorError as error:
            found.left_out[f"/lidar/points of recording/{run.course.stem}.mcap"] = str(error)
    found.add(f"recording/{run.course.stem}.mcap", lambda: mcap_of(run.course, scans))


def _adapted(record: Mapping[str, Any], station: str) -> dict[str, Source]:
    """The record for other tools."""
    return {"adapters/openhtf.json": as_json(openhtf_of(record, station)),
            "adapters/junit.xml": junit_of(record, station), "adapters/ods.json": as_json(ods_of(record, station))}


def as_json(value: Any) -> bytes:
    """A file of a bundle."""
    return (json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode("utf-8")
