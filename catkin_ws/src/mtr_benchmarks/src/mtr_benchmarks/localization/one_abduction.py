"""Runs one drive in which the moving robot is carried away: recording, replay and evaluation."""
# SPDX-License-Identifier: Apache-2.0
import shutil

from .drives.record import DriveError, record
from .drives.selection import BenchmarkDrive
from .drives.truth import read_truth
from .judging.abduction import fate
from .methods.key_track import run_key_track
from .methods.this_system import NoMap
from .one_drive import DriveResult, DriveTask
from .repeats import run_until_it_proves


def run_abduction(task: DriveTask) -> DriveResult:
    """Repeat a drive that touches something or gives no map, with the next seed; the repetition is reported.

    Only recordings of robots that reported a wrong pose as valid are kept.
    """
    return run_until_it_proves(task.drive, lambda drive: _drive(drive, task), (DriveError, NoMap))


def _drive(drive: BenchmarkDrive, task: DriveTask) -> DriveResult:
    folder = task.folder / drive.name
    is_kept = False
    try:
        segments = record(drive.options, folder)["segments"]
        found = fate(run_key_track(folder, read_truth(folder)), segments)
        is_kept = task.keep and found.first_wrong is not None
        return DriveResult(drive, {}, {}, segments, found)
    finally:
        if not is_kept:
            shutil.rmtree(folder, ignore_errors=True)
