"""One robot that is carried away while it drives: recording, replay, and what became of it."""
# SPDX-License-Identifier: Apache-2.0
import shutil
from typing import Any, Dict, List, Tuple

from .drives.record import DriveError, record
from .drives.selection import BenchmarkDrive, repeated
from .drives.truth import read_truth
from .judging.abduction import Fate, fate
from .methods.key_track import run_key_track
from .methods.outcome import THIS_SYSTEM
from .methods.this_system import NoMap, SystemFailure
from .one_drive import RECORDING, DriveResult, DriveTask

MAX_DRIVES = 5


def run_abduction(task: DriveTask) -> DriveResult:
    """A drive that touches something or gives no map proves nothing and is repeated with the next seed, and told.

    Of the recordings only those of robots that were wrong and valid are kept.
    """
    drive = task.drive
    repeats: List[str] = []
    for _ in range(MAX_DRIVES):
        try:
            found, segments = _drive(drive, task)
            return DriveResult(drive, {}, {}, segments, found, repeats)
        except (DriveError, NoMap) as error:
            repeats.append(f"{drive.name}: {error}")
            drive = repeated(drive)
        except SystemFailure as error:
            return DriveResult(drive, {}, {THIS_SYSTEM: str(error)}, [], None, repeats)
    return DriveResult(task.drive, {}, {RECORDING: f"{MAX_DRIVES} drives gave nothing. {repeats[-1]}"}, [], None,
                       repeats)


def _drive(drive: BenchmarkDrive, task: DriveTask) -> Tuple[Fate, List[Dict[str, Any]]]:
    folder = task.folder / drive.name
    is_kept = False
    try:
        segments = record(drive.options, folder)["segments"]
        found = fate(run_key_track(folder, read_truth(folder)), segments)
        is_kept = task.keep and found.first_wrong is not None
        return found, segments
    finally:
        if not is_kept:
            shutil.rmtree(folder, ignore_errors=True)
