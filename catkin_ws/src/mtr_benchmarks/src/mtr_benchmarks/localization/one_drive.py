"""Runs one drive of the benchmark from its recording to its errors, and deletes the recording."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import shutil
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

from .drives.record import DriveError, record
from .drives.selection import PLAIN, BenchmarkDrive
from .drives.truth import DriveTruth, read_truth
from .judging.abduction import Fate
from .judging.any_car import CarVerdict
from .methods.compared import compare
from .methods.mrpt import MrptError
from .methods.outcome import MRPT_ICP, THIS_SYSTEM, MethodOutcome
from .methods.this_system import SystemFailure, run_this_system

RECORDING = "recording"


class DriveResult(NamedTuple):
    """Results of the methods for one drive.

    Attributes:
        outcomes: results by method.
        failures: one sentence for each method that failed, or for the recording.
        segments: pieces of the drive, as in its meta.json.
        fate: result for a robot that was carried away while it drove.
        repeats: one sentence for each earlier drive that proved nothing.
        car: result for a random Car.
    """

    drive: BenchmarkDrive
    outcomes: Dict[str, MethodOutcome]
    failures: Dict[str, str]
    segments: List[Dict[str, Any]]
    fate: Optional[Fate] = None
    repeats: Sequence[str] = ()
    car: Optional[CarVerdict] = None


class DriveTask(NamedTuple):
    """One drive and its folder. keep: do not delete the recording."""

    drive: BenchmarkDrive
    folder: pathlib.Path
    mrpt_program: pathlib.Path
    keep: bool = False


def run_drive(task: DriveTask) -> DriveResult:
    """Record the drive, run the methods on it, and compare them with the truth."""
    folder = task.folder / task.drive.name
    try:
        meta = record(task.drive.options, folder)
        outcomes, failures = _methods(task, folder, read_truth(folder))
        return DriveResult(task.drive, outcomes, failures, meta["segments"])
    except DriveError as error:
        return DriveResult(task.drive, {}, {RECORDING: str(error)}, [])
    finally:
        if not task.keep:
            shutil.rmtree(folder, ignore_errors=True)


def _methods(task: DriveTask, folder: pathlib.Path,
             truth: DriveTruth) -> Tuple[Dict[str, MethodOutcome], Dict[str, str]]:
    outcomes: Dict[str, MethodOutcome] = {}
    failures: Dict[str, str] = {}
    try:
        outcomes[THIS_SYSTEM] = run_this_system(folder, truth)
    except SystemFailure as error:
        failures[THIS_SYSTEM] = str(error)
    if task.drive.variant == PLAIN:
        try:
            outcomes.update(compare(folder, truth, task.mrpt_program))
        except MrptError as error:
            failures[MRPT_ICP] = str(error)
    return outcomes, failures
