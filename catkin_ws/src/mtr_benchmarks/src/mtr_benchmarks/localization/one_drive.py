"""One drive of the benchmark from its recording to its errors; the recording is deleted."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import shutil
from typing import Dict, NamedTuple

from .drive_truth import DriveTruth, read_truth
from .drives import PLAIN, Drive
from .methods import THIS_SYSTEM, Outcome, compare
from .mrpt import MrptError
from .record import DriveError, record
from .system import SystemFailure, run_this_system

RECORDING = "recording"


class DriveResult(NamedTuple):
    """What the methods made of one drive, and one sentence for each that failed."""

    drive: Drive
    outcomes: Dict[str, Outcome]
    failures: Dict[str, str]
    segments: list


class Work(NamedTuple):
    """One drive and where to do it; keep: the recording stays, for a look at it."""

    drive: Drive
    folder: pathlib.Path
    mrpt_program: pathlib.Path
    keep: bool = False


def run_drive(work: Work) -> DriveResult:
    """Record the drive, let the methods work on it, compare with the truth."""
    folder = work.folder / work.drive.name
    try:
        meta = record(work.drive.options, folder)
        outcomes, failures = _methods(work, folder, read_truth(folder))
        return DriveResult(work.drive, outcomes, failures, meta["segments"])
    except DriveError as error:
        return DriveResult(work.drive, {}, {RECORDING: str(error)}, [])
    finally:
        if not work.keep:
            shutil.rmtree(folder, ignore_errors=True)


def _methods(work: Work, folder: pathlib.Path, truth: DriveTruth) -> tuple:
    outcomes: Dict[str, Outcome] = {}
    failures: Dict[str, str] = {}
    try:
        outcomes[THIS_SYSTEM] = run_this_system(folder, truth)
    except SystemFailure as error:
        failures[THIS_SYSTEM] = str(error)
    if work.drive.variant == PLAIN:
        try:
            outcomes.update(compare(folder, truth, work.mrpt_program))
        except MrptError as error:
            failures["mrpt_icp"] = str(error)
    return outcomes, failures
