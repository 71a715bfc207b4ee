"""Runs one random Car: recording of the path around it, map, and evaluation of the Car locator."""
# SPDX-License-Identifier: Apache-2.0
import shutil
from dataclasses import asdict

from mtr_car_locator.conversions import scans_in
from mtr_description.shipped import shipped_geometry

from .drives.random_car import random_car
from .drives.record import DriveError, record
from .drives.recording import BAG
from .drives.selection import BenchmarkDrive
from .drives.truth import read_truth
from .judging.any_car import ASKED, WRONG, CarVerdict, verdict
from .methods.this_system import NoMap, NotLocated, car_errors, data_sheet, key_frames, locate, mapped
from .one_drive import DriveResult, DriveTask
from .repeats import run_until_it_proves


def run_any_car(task: DriveTask) -> DriveResult:
    """Repeat a drive that touches something, with the next seed; the repetition is reported.

    A refusal by the system counts as a result. Only recordings of wrongly located Cars are kept.
    """
    return run_until_it_proves(task.drive, lambda drive: _drive(drive, task), (DriveError,))


def _drive(drive: BenchmarkDrive, task: DriveTask) -> DriveResult:
    folder = task.folder / drive.name
    drawn = random_car(drive.options.seed)
    about = {**asdict(drawn.shape), "lidar_height_m": drawn.lidar_height_m, "rear_lidar": drawn.rear_lidar,
             "knows_sheet": drawn.knows_sheet, "neighbour": drawn.neighbour}
    is_kept = False
    try:
        segments = record(drive.options, folder)["segments"]
        truth, out = read_truth(folder), folder / "replay"
        try:
            mapped(folder / BAG, out)
            car = locate(out, truth.meta, scans_in(folder / BAG, shipped_geometry().lidars()),
                         data_sheet(truth.meta) if drawn.knows_sheet else None)
        except (NoMap, NotLocated) as error:
            return DriveResult(drive, {}, {}, segments, car=CarVerdict(ASKED, str(error), about))
        found = verdict(car_errors(car, key_frames(out), truth), about)
        is_kept = task.keep and found.verdict == WRONG
        return DriveResult(drive, {}, {}, segments, car=found)
    finally:
        if not is_kept:
            shutil.rmtree(folder, ignore_errors=True)
